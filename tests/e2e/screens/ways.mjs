// SPDX-License-Identifier: MIT
// Ways to what the states of the page need: a tab, a node, a resource, a form, a palette, the code.
import { field, picture, row } from '../stage.mjs';

export const tab = async (page, name) => {
    const found = page.getByRole('tab', { name, exact: true });
    if ((await found.count()) > 0) {
        await found.click();
    }
};
export const inspector = (page) => tab(page, 'Edit');

export async function select(page, ...ids) {
    await tab(page, 'Nodes');
    for (const [i, id] of ids.entries()) {
        await row(page, id).click(i > 0 ? { modifiers: ['Control'] } : {});
    }
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

export async function resource(page, name) {
    await tab(page, 'Looks');
    await page.locator(`[data-resource="${name}"] .resource-pick`).click();
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

export async function setup(page, name) {
    await tab(page, 'Looks');
    await page.getByRole('button', { name, exact: true }).click();
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

export const bottom = (page) =>
    page.getByTestId('inspector').evaluate((one) => one.scrollTo(0, one.scrollHeight));
export const key = (keys) => (page) => page.keyboard.press(keys);
export const popup = (page, role = 'menu') => page.getByRole(role).first().waitFor();

export async function search(page, keys, text) {
    await page.keyboard.press(keys);
    await page.getByRole('combobox').fill(text);
}

export async function openCode(page) {
    await resource(page, 'egg');
    await page.getByRole('button', { name: 'Edit code' }).click();
    await page.locator('.cm-content').waitFor();
}

export async function write(page, text) {
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(text);
}

export async function middle(page, x = 0.5, y = 0.5) {
    const box = await picture(page).boundingBox();
    return [box.x + x * box.width, box.y + y * box.height];
}

export async function setRadius(page, text) {
    await select(page, 'ball');
    await field(page, 'radius').fill(text);
    await field(page, 'radius').press('Enter');
}

export async function graph(page) {
    await page.keyboard.press('Alt+1');
    await page.locator('[data-card]').first().waitFor();
}
