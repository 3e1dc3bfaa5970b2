// SPDX-License-Identifier: MIT
// The picture: picking, the honest state, and that the last frame is the picture of REST.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import {
    closePage,
    difference,
    dragBy,
    drawnPixels,
    field,
    openStage,
    picture,
    pixels,
    row,
    SCENE,
    settled,
} from './stage.mjs';

let stage;
let page;
before(async () => {
    stage = await openStage();
});
after(() => stage.close());
afterEach(async () => {
    const last = page;
    page = null;
    if (last) {
        await closePage(last);
    }
});

/** Where a world point on the plane z = 0 is seen by SCENE's camera; pixels of the picture. */
function onScreen(box, [x, y]) {
    const { position } = SCENE.camera;
    const distance = Math.hypot(...position);
    const forward = position.map((p) => -p / distance);
    const up = [0, -forward[2], forward[1]].map((u) => u / Math.hypot(forward[1], forward[2]));
    const to = [x - position[0], y - position[1], -position[2]];
    const dot = (a, b) => a.reduce((sum, one, i) => sum + one * b[i], 0);
    const scale = box.height / 2 / Math.tan(Math.PI / 8) / dot(to, forward);
    return {
        x: box.width / 2 + to[0] * scale,
        y: box.height / 2 - dot(to, up) * scale,
    };
}

test('a click selects the node under the pointer, a click on nothing deselects', async () => {
    page = await stage.page({ scene: await stage.scene() });
    await settled(page);
    const box = await picture(page).boundingBox();
    for (const [node, place] of [
        ['ball', [-1.5, 0]],
        ['crate', [1.5, 0]],
        ['pole', [0, -2]],
    ]) {
        await picture(page).click({ position: onScreen(box, place) });
        await page.locator(`[data-node=${node}][aria-selected=true]`).waitFor();
        assert.equal(await page.locator('[data-node][aria-selected=true]').count(), 1);
    }
    await page.keyboard.down('Shift');
    await picture(page).click({ position: onScreen(box, [-1.5, 0]) });
    await page.keyboard.up('Shift');
    await page.locator('[data-node=ball][aria-selected=true]').waitFor();
    assert.equal(await page.locator('[data-node][aria-selected=true]').count(), 2);
    await picture(page).click({ position: { x: box.width - 20, y: box.height - 20 } });
    await page.waitForFunction(
        () => document.querySelector('[data-node][aria-selected=true]') === null,
    );
});

test('the same place clicked again climbs to the parent', async () => {
    page = await stage.page({ scene: await stage.scene() });
    await settled(page);
    const box = await picture(page).boundingBox();
    const position = onScreen(box, [0, -2]);
    await picture(page).click({ position });
    await page.locator('[data-node=pole][aria-selected=true]').waitFor();
    /* Two clicks in quick succession frame instead. */
    await page.waitForFunction((from) => performance.now() > from + 400, await page.evaluate(() => performance.now()));
    await picture(page).click({ position });
    await page.locator('[data-node=pair][aria-selected=true]').waitFor();
});

test('the state goes from moving to final, and a still scene stays so', async () => {
    page = await stage.page({ scene: await stage.scene() });
    await settled(page);
    const seen = page.evaluate(
        () =>
            new Promise((resolve) => {
                const pill = document.querySelector('[data-testid=state]');
                const states = [];
                new MutationObserver(() => {
                    states.push(pill.dataset.state);
                    if (pill.dataset.state === 'final') {
                        resolve(states);
                    }
                }).observe(pill, { attributes: true });
            }),
    );
    await dragBy(page, picture(page), 80, 10);
    const states = await seen;
    assert.equal(states[0], 'moving');
    assert.equal(states.at(-1), 'final');
    await page.getByTestId('software').waitFor();
});

test('the pill says final of no picture that lacks an edit', async () => {
    page = await stage.page({ scene: await stage.scene() });
    await settled(page);
    await page.evaluate(() => {
        const pill = document.querySelector('[data-testid=state]');
        const saved = document.querySelector('[data-testid=saved]');
        window.untrue = [];
        const look = () => {
            const { state, revision } = pill.dataset;
            if (state === 'final' && Number(saved.dataset.revision) > Number(revision)) {
                window.untrue.push(`${state} ${revision}, saved ${saved.dataset.revision}`);
            }
        };
        for (const element of [pill, saved]) {
            new MutationObserver(look).observe(element, { attributes: true });
        }
    });
    await row(page, 'ball').click();
    await field(page, 'radius').focus();
    for (let i = 0; i < 30; i += 1) {
        await page.keyboard.press('ArrowUp');
    }
    await row(page, 'root').click();
    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill('torus');
    await page.keyboard.press('Enter');
    await page.locator('[data-node=torus-1]').waitFor();
    await settled(page);
    assert.deepEqual(await page.evaluate(() => window.untrue), []);
});

test('a scene shows what it looked like last before it has a picture', async () => {
    const id = await stage.scene();
    page = await stage.page({ scene: id });
    await settled(page);
    await closePage(page);
    process.kill(stage.daemon.worker(), 'SIGSTOP');
    page = await stage.page({ scene: id });
    await page.getByTestId('poster').waitFor();
    assert.equal(await page.getByTestId('state').getAttribute('data-state'), 'waiting');
    process.kill(stage.daemon.worker(), 'SIGCONT');
    await settled(page);
    await page.getByTestId('poster').waitFor({ state: 'detached' });
});

test('the lossless frame is image.png, pixel for pixel', async () => {
    const id = await stage.scene({ ...SCENE, render: { samples: 2 } });
    page = await stage.page({ scene: id });
    await settled(page);
    await drawnPixels(page, stage, id);
});

test('a new shape appears while the page says that it compiles', async () => {
    const id = await stage.scene();
    page = await stage.page({ scene: id });
    await settled(page);
    const before = await pixels(page);
    await row(page, 'root').click();
    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill('round box');
    await page.keyboard.press('Enter');
    await page.locator('[data-node=round_box-1]').waitFor();
    for (;;) {
        const now = await pixels(page);
        if (difference(now, before) > 8) {
            break;
        }
    }
    await settled(page);
});
