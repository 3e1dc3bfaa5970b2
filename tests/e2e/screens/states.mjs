// SPDX-License-Identifier: MIT
// Every panel, dialog, menu and state of the page: its name, and how to come there. Of a group the
// states come in a row on one page; `alone` has a page and a copy of the scene for itself.
import path from 'node:path';
import { ALGEBRA } from './algebra.mjs';
import { CHANGES, CODE } from './changes.mjs';
import { DIALOGS } from './dialogs.mjs';
import { CODED_FORMS, FORMS } from './forms.mjs';
import { HANDS } from './hands.mjs';
import { CODED, EMPTY, STUDIO } from './scene.mjs';
import { START } from './start.mjs';
import { TEXT } from './text.mjs';
import { graph, openCode, tab } from './ways.mjs';

const examples = new URL('../../../protocol/examples/', import.meta.url).pathname;

/** Takes hold of what a locator finds first, and keeps it. */
async function hold(page, found, dx, dy) {
    const box = await found.first().boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + dx, box.y + dy, { steps: 4 });
    await page.locator('.graph-say').waitFor();
}

const GRAPH = [
    ['graph', graph],
    ['graph, a node', async (page) => {
        await graph(page);
        await page.keyboard.press('F6');
        await page.locator('[data-card]').first().locator('header').click();
    }],
    ['graph, a wire held', async (page) => {
        await graph(page);
        await hold(page, page.locator('[data-grab="output"]'), -40, 60);
    }],
    ['graph, all of it', async (page) => {
        await graph(page);
        await page.getByRole('button', { name: 'Show the whole graph' }).click();
    }],
    ['graph and code', async (page) => {
        await openCode(page);
        await graph(page);
    }, { scene: CODED }],
];

const example = (name) => path.join(examples, `${name}.json`);

const OTHERS = [
    ['empty scene', async (page) => page.locator('.view-empty').waitFor(), { scene: EMPTY }],
    ['empty scene, Looks', async (page) => {
        await page.locator('.view-empty').waitFor();
        await tab(page, 'Looks');
    }, { scene: EMPTY }],
    ['hints', async (page) => page.locator('.view-hint').first().waitFor(), { scene: STUDIO, hints: true }],
    ['sheet, tall', (page) => page.locator('.sheet-grip').press('Enter'), { scene: STUDIO, narrow: true }],
    ['sheet, low', async (page) => {
        await page.locator('.sheet-grip').press('Enter');
        await page.locator('.sheet-grip').press('Enter');
    }, { scene: STUDIO, narrow: true }],
    ['no such scene', async (page) => {
        page.expected = /404|WebSocket/;
        await page.getByRole('heading', { name: /^There is no such scene/ }).waitFor();
    }, { scene: null, path: '/s/nowhere' }],
    ['example, still life', async () => {}, { scene: example('still-life') }],
    ['example, duck', async () => {}, { scene: example('duck') }],
    ['old picture in another shape', async (page) => {
        page.hold = (message) => typeof message !== 'string';
        await graph(page);
    }, { scene: STUDIO, tampered: true }],
];

const rows = (group, list, more = {}) =>
    list.map(([name, go, options = {}]) => ({ group, name, go, ...more, ...options }));

/** `narrow`: of narrow windows only; `alone`: a page for itself; `tampered`: what the server says can be held back and added to. */
export const STATES = [
    ...rows('start', START, { scene: null }),
    ...rows('forms', FORMS, { scene: STUDIO }),
    ...rows('forms with code', CODED_FORMS, { scene: CODED }),
    ...rows('dialogs', DIALOGS, { scene: STUDIO }),
    ...rows('changes', CHANGES, { scene: STUDIO, alone: true, tampered: true }),
    ...rows('code', CODE, { scene: CODED, alone: true, tampered: true }),
    ...rows('hands', HANDS, { scene: STUDIO, alone: true }),
    ...rows('algebra', ALGEBRA, { scene: STUDIO, alone: true }),
    ...rows('graph', GRAPH, { scene: STUDIO, alone: true }),
    ...rows('text', TEXT, { scene: STUDIO, alone: true }),
    ...rows('others', OTHERS, { alone: true }),
];
