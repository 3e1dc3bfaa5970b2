// SPDX-License-Identifier: MIT
// States of the scene as text, and of files that come into it: rows of states.mjs.
import { picture } from '../stage.mjs';
import { graph, select, tab } from './ways.mjs';

const textLine = (page, text) => page.getByTestId('text').locator('.cm-line').filter({ hasText: text }).first();

async function text(page) {
    await page.keyboard.press('Alt+2');
    await textLine(page, '"format"').waitFor();
}

/** Types behind the first line that holds a text; what is typed is wrong there. */
async function mistype(page, line, typed) {
    await text(page);
    await textLine(page, line).click();
    await page.keyboard.press('End');
    await page.keyboard.insertText(typed);
    await page.locator('.text-faults').waitFor();
}

export const TEXT = [
    ['text', text],
    ['text, a node', async (page) => {
        await text(page);
        await select(page, 'ball');
        await tab(page, 'Text');
        await page.locator('.text-marked').first().waitFor();
    }],
    ['text, faults', async (page) => mistype(page, '"format"', ' "nmae": "x", "kamera": 3,')],
    ['text, changed by others', async (page) => {
        await mistype(page, '"format"', ' "nmae": "x",');
        await page.evaluate(async () => {
            const body = JSON.stringify([{ op: 'set', at: '/camera/fov', value: 50 }]);
            const headers = { 'Content-Type': 'application/json' };
            await fetch(`/v1/scenes/${location.pathname.split('/').at(-1)}`, { method: 'PATCH', body, headers });
        });
        await page.getByTestId('text-others').waitFor();
    }],
    ['text and graph', async (page) => {
        await graph(page);
        await text(page);
    }],
    ['files over the picture', async (page) => {
        const dataTransfer = await page.evaluateHandle(() => {
            const data = new DataTransfer();
            data.items.add(new File(['{"format": "fieldcast/1", "root": {"type": "sphere"}}'], 'ball.json'));
            return data;
        });
        const zone = page.getByTestId('drop-zone');
        while ((await zone.count()) === 0) {
            await picture(page).dispatchEvent('dragover', { dataTransfer });
        }
    }],
    ['a scene file, what for', async (page) => {
        const chooser = page.waitForEvent('filechooser');
        await page.keyboard.press('Control+k');
        await page.keyboard.insertText('insert files');
        await page.getByRole('option', { name: /Open or insert files/ }).click();
        const buffer = Buffer.from('{"format": "fieldcast/1", "root": {"type": "sphere"}}');
        await (await chooser).setFiles([{ name: 'a-ball.json', mimeType: 'application/json', buffer }]);
        await page.getByTestId('offer').waitFor();
    }],
];
