// SPDX-License-Identifier: MIT
// Choices of who points and presses: a trackpad whose two fingers orbit, single keys that do nothing,
// keys like those of another tool, and keys of one's own.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { picture, row, settled, useStage } from './stage.mjs';

const stage = useStage({ coarse: true });

/** Where the end of an axis is drawn, in whole pixels. */
const axisOf = (page) =>
    page.locator('.axes-ball [data-view="right"]').evaluate((one) => {
        const { x, y } = one.getBoundingClientRect();
        return `${Math.round(x)} ${Math.round(y)}`;
    });
const askedFor = (page) => page.getByRole('button', { name: 'Orbit', exact: true });

/** Whether the view turns when the wheel does, told by the axes. */
async function turnsBy(page, dx, dy) {
    await settled(page);
    const before = await axisOf(page);
    const { x, y, width, height } = await picture(page).boundingBox();
    await page.mouse.move(x + 0.3 * width, y + 0.3 * height);
    await page.mouse.wheel(dx, dy);
    await settled(page);
    return (await axisOf(page)) !== before;
}

test('a trackpad is asked about once; then two fingers orbit, also after a reload', async () => {
    const page = await stage.page({ scene: await stage.scene() });
    assert.equal(await turnsBy(page, 0, 60), false);
    assert.equal(await askedFor(page).count(), 0);
    assert.equal(await turnsBy(page, 90, 60), false);
    await askedFor(page).click();
    assert.equal(await turnsBy(page, 90, 60), true);
    await page.reload();
    assert.equal(await turnsBy(page, 90, 60), true);
    await page.keyboard.press('?');
    await page.getByRole('switch', { name: 'Two fingers on a trackpad orbit' }).click();
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
    assert.equal(await turnsBy(page, 90, 60), false);
    assert.equal(await askedFor(page).count(), 0, 'asked once');
});

test('single keys act, or do not; other keys always do', async () => {
    const page = await stage.page({ scene: await stage.scene() });
    await settled(page);
    await row(page, 'ball').click();
    await page.keyboard.press('?');
    await page.getByRole('switch', { name: 'Single keys act as commands' }).click();
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
    await picture(page).focus();
    await page.keyboard.press('k');
    await page.keyboard.press('?');
    await page.keyboard.press('Control+k');
    await page.getByRole('dialog').waitFor();
    assert.equal(await page.getByTestId('section').count(), 0);
    await page.keyboard.type('single keys');
    await page.keyboard.press('Enter');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
    await picture(page).focus();
    await page.keyboard.press('k');
    await until(async () => (await page.getByTestId('section').count()) === 1, 'the plane of K');
});

test('keys like those of another tool, and chosen ones, also after a reload', async () => {
    const page = await stage.page({ scene: await stage.scene() });
    const dialog = page.getByRole('dialog');
    const leave = async () => {
        await page.keyboard.press('Escape');
        await dialog.waitFor({ state: 'detached' });
    };
    const isRotating = () => page.getByRole('button', { name: 'Rotate', exact: true }).getAttribute('aria-pressed');
    await settled(page);
    await row(page, 'ball').click();
    await page.keyboard.press('e');
    assert.equal(await isRotating(), 'false');
    await page.keyboard.press('?');
    await dialog.getByRole('combobox', { name: 'Keys like those of' }).click();
    await page.getByRole('option', { name: 'three.js, Unity' }).click();
    await dialog.getByRole('switch', { name: 'Change keys' }).click();
    const hide = dialog.getByRole('button', { name: /^Hide or show:/ });
    await hide.click();
    await page.keyboard.press('Escape'); // of the button, not of the dialog
    await hide.getByText('Press a key').waitFor({ state: 'detached' });
    await hide.click();
    await page.keyboard.press('Shift+W');
    await hide.getByText('Wrap in').waitFor();
    await page.keyboard.press('q');
    await hide.getByText('Q', { exact: true }).waitFor();
    await leave();
    for (const round of ['at once', 'after a reload']) {
        await row(page, 'ball').click();
        await page.keyboard.press('w');
        assert.equal(await isRotating(), 'false', round);
        await page.keyboard.press('e');
        assert.equal(await isRotating(), 'true', round);
        await page.keyboard.press('q');
        await page.locator('[data-node=ball][data-hidden]').waitFor();
        await page.keyboard.press('q');
        await page.locator('[data-node=ball]:not([data-hidden])').waitFor();
        await page.reload();
        await settled(page);
    }
    await page.keyboard.press('?');
    await dialog.getByRole('button', { name: 'All keys as they were' }).click();
    await leave();
    await row(page, 'ball').click();
    await page.keyboard.press('h');
    await page.locator('[data-node=ball][data-hidden]').waitFor();
});

test('a key of one\'s own stays in another keymap, and the sheet says whose it was', async () => {
    const page = await stage.page({ scene: await stage.scene() });
    const dialog = page.getByRole('dialog');
    await settled(page);
    await row(page, 'ball').click();
    await page.keyboard.press('?');
    await dialog.getByRole('switch', { name: 'Change keys' }).click();
    const hide = dialog.getByRole('button', { name: /^Hide or show:/ });
    await hide.click();
    await page.keyboard.press('e');
    await hide.getByText('E', { exact: true }).waitFor();
    assert.equal(await dialog.getByText('is your own key for').count(), 0);
    await dialog.getByRole('combobox', { name: 'Keys like those of' }).click();
    await page.getByRole('option', { name: 'three.js, Unity' }).click();
    await dialog.getByText(/^E is your own key for “Hide or show”, not “Rotate/).waitFor();
    await page.keyboard.press('Escape');
    await dialog.waitFor({ state: 'detached' });
    await row(page, 'ball').click();
    await page.keyboard.press('e');
    await page.locator('[data-node=ball][data-hidden]').waitFor();
});
