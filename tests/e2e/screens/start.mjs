// SPDX-License-Identifier: MIT
// States of the page with the scenes: rows of states.mjs.
import { popup } from './ways.mjs';

const file = (name, text) => ({ name, mimeType: 'application/json', buffer: Buffer.from(text) });

async function choose(page, button, files) {
    const asked = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: button }).click();
    await (await asked).setFiles(files);
}

/* Pictures are asked for when they come into sight. It lies so far below the bar that no button above it
 * is covered in part. */
async function bring(page, found) {
    await found.evaluate((one) => {
        const bar = document.querySelector('header').getBoundingClientRect().bottom;
        one.style.scrollMarginTop = `${bar + 8}px`;
        one.scrollIntoView();
    });
    await page.waitForFunction(() =>
        [...document.querySelectorAll('[data-example] img')].every((one) => {
            const { top, bottom } = one.closest('.card-picture').getBoundingClientRect();
            return top >= innerHeight || bottom <= 0 || !one.hidden;
        }),
    );
}

const SPHERES = '{"scene": [{"type": "Primitives/Sphere"}]}';
const BROKEN = '{\n  "model": {"type": "Primitives/Sphere" 5}\n}\n';

export const START = [
    ['start', (page) => page.locator('[data-example] img:not([hidden])').nth(3).waitFor()],
    ['start, examples', (page) => bring(page, page.getByTestId('examples'))],
    ['start, lessons', (page) => bring(page, page.getByText('Lessons', { exact: true }))],
    ['start, surfaces', (page) => bring(page, page.getByText('Surfaces by formulas'))],
    ['start, search', (page) => page.getByPlaceholder('Search scenes and examples').fill('glass')],
    ['start, nothing found', (page) => page.getByPlaceholder('Search scenes and examples').fill('xyzzy')],
    ['start, menu of a scene', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await popup(page);
    }],
    ['start, rename', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await page.getByRole('menuitem', { name: 'Rename' }).click();
        await page.getByLabel(/^New name of/).waitFor();
    }],
    ['start, deleted', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await page.getByRole('menuitem', { name: 'Delete' }).click();
        await page.getByRole('button', { name: 'Undo' }).waitFor();
    }, { clean: (page) => page.getByRole('button', { name: 'Undo' }).click() }],
    ['start, keys', async (page) => {
        await page.locator('[data-example]').first().waitFor();
        await page.keyboard.press('?');
        await popup(page, 'dialog');
    }],
    ['start, drop', async (page) => {
        await page.locator('.scenes').waitFor();
        await page.evaluate(() => {
            const data = new DataTransfer();
            data.items.add(new File(['{}'], 'scene.json', { type: 'application/json' }));
            for (const type of ['dragenter', 'dragover']) {
                document.querySelector('.scenes').dispatchEvent(
                    new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }),
                );
            }
        });
        await page.locator('.drop-cover').waitFor();
    }, { alone: true }],
    ['start, files refused', async (page) => {
        page.expected = /status of 4/;
        await choose(page, 'Upload', [file('main.json', SPHERES), file('broken.json', BROKEN)]);
        await page.getByTestId('import-fault').getByText(/^line 2/).waitFor();
    }, { alone: true }],
    ['start, which scene', async (page) => {
        page.expected = /status of 4/;
        await choose(page, 'Upload', [file('one.json', SPHERES), file('two.json', SPHERES)]);
        await page.getByRole('dialog', { name: 'Which scene?' }).waitFor();
    }, { alone: true }],
    ['start, no scenes yet', async (page) => {
        await page.route('**/v1/scenes', (route) => route.fulfill({ json: { scenes: [] } }));
        await page.reload();
        await page.locator('[data-example]').first().waitFor();
    }, { alone: true }],
    ['start, no answer', async (page) => {
        page.expected = /Failed to load|ERR_FAILED/;
        await page.route('**/v1/scenes', (route) => route.abort());
        await page.reload();
        await page.locator('.page-note').waitFor();
    }, { alone: true }],
];
