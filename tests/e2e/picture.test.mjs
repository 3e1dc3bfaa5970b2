// SPDX-License-Identifier: MIT
// The picture: picking, the honest state, and that the last frame is the picture of REST.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { standStill, until } from '../support/daemon.mjs';
import { openScreen } from './screens/screen.mjs';
import {
    closePage,
    difference,
    dragBy,
    drawnPixels,
    field,
    picture,
    pixels,
    row,
    SCENE,
    settled,
    useStage,
} from './stage.mjs';

const stage = useStage();
let page;

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
    await standStill(stage.daemon.worker());
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

/* Pictures are held back, so that the pill has to say why there is none. */
const DESKTOP = { theme: 'dark', width: 1200, height: 800 };
const openHeld = () =>
    openScreen(stage, { scene: SCENE, tampered: true, fresh: true, hold: (message) => typeof message !== 'string' }, DESKTOP);

test('the pill tells how long compiling takes, and about how long it will', async () => {
    page = await openHeld();
    const pill = page.getByTestId('state');
    await pill.evaluate((one) => {
        window.said = [];
        const options = { childList: true, characterData: true, subtree: true };
        new MutationObserver(() => window.said.push(one.innerText)).observe(one, options);
    });
    const says = (pattern) => until(async () => (await page.evaluate(() => window.said)).some((text) => pattern.test(text)), String(pattern));
    const compiling = { type: 'compiling', revision: 0, over: false };
    page.tell({ ...compiling, elapsed_ms: 3000, expected_ms: 6000 });
    await says(/^compiling \d+ s of about 6 s$/);
    page.tell({ ...compiling, over: true, elapsed_ms: 4000 });
    await pill.getByText('waiting for the first picture').waitFor();
    /* Far beyond what was expected no more is promised. */
    page.tell({ ...compiling, elapsed_ms: 60_000, expected_ms: 6000 });
    await pill.getByText(/^compiling \d+ s$/).waitFor();
});

test('the pill says that a scene is given up, why, and offers another try', async () => {
    page = await openHeld();
    const pill = page.getByTestId('state');
    const leftOut = { type: 'notice', level: 'error', code: 'scene_left_out', place: '/nodes/root', message: 'It is not drawn.' };
    await pill.getByText('waiting for the first picture').waitFor();
    page.tell({ ...leftOut, reason: 'crashed' });
    await pill.getByText('given up: it crashed').waitFor();
    page.tell({ ...leftOut, reason: 'too_slow', measured: 900, limit: 500 });
    await pill.getByText('given up: too slow').waitFor();
    await page.getByTestId('broken').click();
    await row(page, 'root').and(page.locator('[aria-selected=true]')).waitFor();
    assert.equal(await page.getByTestId('code').count(), 0, 'there is no code to show');
    await page.getByTestId('retry').getByText('Try again', { exact: true }).click();
    await until(() => page.sent.some(({ type, place }) => type === 'retry' && place === '/nodes/root'), 'the retry');
    page.tell({ type: 'notice', level: 'info', code: 'retrying', place: '/nodes/root', message: 'It is tried again.' });
    await pill.getByText('waiting for the first picture').waitFor();
    assert.equal(await page.getByTestId('retry').count(), 0);
});

test('a new shape appears in the picture, which becomes final', async () => {
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
