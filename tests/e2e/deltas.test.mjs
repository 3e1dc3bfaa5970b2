// SPDX-License-Identifier: MIT
// After an edit the page gets what differs from its last pictures, and shows the whole one.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { readFrameHeader } from '../support/live.mjs';
import { openScreen } from './screens/screen.mjs';
import { drawnPixels, field, row, SCENE, settled, useStage } from './stage.mjs';

const WINDOW = { theme: 'dark', width: 1100, height: 700 };
const DOCUMENT = { ...SCENE, render: { samples: 2 } };

const stage = useStage();

const headerOf = (message) =>
    typeof message !== 'string' && message.subarray(0, 4).toString() === 'FCF1' ? readFrameHeader(message) : null;

/** A page with the headers of its frames, in `page.frames`; `page.loses` says which it does not get. */
async function open() {
    const page = await openScreen(stage, { scene: DOCUMENT, tampered: true }, WINDOW);
    page.frames = [];
    page.hold = (message) => {
        const header = headerOf(message);
        const lost = header !== null && page.loses?.(header);
        if (header && !lost) {
            page.frames.push(header);
        }
        return lost;
    };
    await settled(page);
    await row(page, 'ball').click();
    await field(page, 'radius').focus();
    return page;
}

const idOf = (page) => new URL(page.url()).pathname.split('/').at(-1);

async function change(page, key, times) {
    for (let i = 0; i < times; i += 1) {
        await page.keyboard.press(key);
    }
    await settled(page);
}

const lossless = (page) => page.frames.filter((frame) => frame.lossless);

test('what is put together after edits is image.png, pixel for pixel', async () => {
    const page = await open();
    for (const key of ['ArrowUp', 'ArrowDown', 'ArrowUp']) {
        await change(page, key, 6);
        await drawnPixels(page, stage, idOf(page));
    }
    await until(() => lossless(page).some(({ delta }) => delta), 'a last picture that is a difference');
    assert.ok(lossless(page).at(-1).delta);
    assert.ok(page.sent.filter(({ type }) => type === 'view').every(({ deltas }) => deltas));
});

test('a page that lacks a picture asks for whole ones, and shows the right one', async () => {
    const page = await open();
    await change(page, 'ArrowUp', 3);
    let lost = 0;
    page.loses = ({ delta, chain }) => delta && chain === lossless(page).at(-1).chain && (lost += 1) === 1;
    await page.keyboard.press('ArrowUp');
    await until(() => lost === 1, 'a picture to be lost');
    // The one after it differs from what the page does not have.
    await page.keyboard.press('ArrowUp');
    await until(() => page.sent.some(({ type, deltas }) => type === 'view' && !deltas), 'a view of whole pictures');
    await settled(page);
    await drawnPixels(page, stage, idOf(page));
    assert.equal(page.frames.at(-1).delta, false);
});
