// SPDX-License-Identifier: MIT
// What is under the pointer is known to the page, and outlined: at once, without a question, also
// while the server stands still.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { standStill, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { field, picture, row, settled, useStage } from './stage.mjs';

const CAMERA = { position: [0, 1, 12], target: [0, 0, 0], fov: 45 };
const ball = (id, x, y, radius) => ({ id, type: 'sphere', params: { radius }, transform: { translation: [x, y, 0] } });
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: CAMERA,
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'bitten', type: 'difference', children: [ball('body', -2, 0, 1.4), ball('bite', -1.3, 0.6, 1)] },
            { id: 'soft', type: 'smooth_union', params: { k: 0.6 }, children: [ball('left', 0.8, -0.4, 0.9), ball('right', 2, 0.4, 0.8)] },
            ball('alone', 0.4, 2, 0.7),
        ],
    },
};

const stage = useStage();
let page;
let scene;

async function open() {
    scene = await stage.scene(DOCUMENT);
    page = await stage.page({ scene });
    await settled(page);
    await until(async () => (await shown()).guided, 'a guide');
}

const outlines = () => page.getByTestId('outlines');
const shown = () => outlines().evaluate(({ dataset }) => ({ ...dataset, guided: dataset.guide === 'shown' }));
const chosen = async (node) => (await row(page, node).getAttribute('aria-selected')) === 'true';

/** A point of the scene in CSS pixels of the window. */
async function spotOf([x, y, z]) {
    const box = await picture(page).boundingBox();
    const far = Math.hypot(1, 12);
    const [right, up] = [[1, 0, 0], [0, 12 / far, -1 / far]];
    const ahead = [0, -1 / far, -12 / far];
    const to = [x, y - 1, z - 12];
    const along = (axis) => axis.reduce((sum, a, i) => sum + a * to[i], 0);
    const scale = box.height / 2 / Math.tan(Math.PI / 8) / along(ahead);
    return { x: box.x + box.width / 2 + scale * along(right), y: box.y + box.height / 2 - scale * along(up), scale };
}

test('hover and click are answered within a frame while the server stands still', async () => {
    await open();
    const pids = [stage.daemon.worker(), stage.daemon.pid];
    try {
        await Promise.all(pids.map(standStill));
        await page.evaluate(() => {
            Object.assign(window, { frames: [], clicked: [] });
            const watch = () => {
                const { hovered } = document.querySelector('[data-testid=outlines]').dataset;
                requestAnimationFrame(() => window.frames.push([hovered, document.querySelector('[data-testid=outlines]').dataset.hovered]));
            };
            const picture = document.querySelector('[data-testid=picture]');
            const rows = () => [...document.querySelectorAll('[data-node][aria-selected=true]')].map((one) => one.dataset.node);
            picture.addEventListener('pointermove', watch, true);
            picture.addEventListener('pointerup', () => requestAnimationFrame(() => window.clicked.push(rows())), true);
        });
        for (const [number, [node, at]] of [['alone', [0.4, 2, 0.5]], ['body', [-2.6, -0.5, 1]], ['right', [2.3, 0.6, 0.5]]].entries()) {
            const { x, y } = await spotOf(at);
            await page.mouse.move(x, y);
            await until(() => page.evaluate((wanted) => window.frames.some(([, hovered]) => hovered === wanted), node), `${node} outlined`);
            await page.mouse.click(x, y);
            const clicked = await until(() => page.evaluate((i) => window.clicked[i], number), 'a frame after the click');
            assert.deepEqual(clicked, [node], 'selected in the first frame after the click');
            await until(async () => (await shown()).selected === node, `${node} outlined as selected`);
            const { selected, hovered } = await shown();
            assert.deepEqual([selected, hovered], [node, ''], 'what is selected is outlined as that alone');
        }
    } finally {
        pids.forEach((pid) => process.kill(pid, 'SIGCONT'));
    }
});

test('40 pixels on blends and cuts select what the C evaluator names', async () => {
    await open();
    const box = await picture(page).boundingBox();
    const live = await Live.open(stage.daemon, scene);
    live.look({ width: box.width, height: box.height });
    let state = 20261;
    const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
    const wrong = [];
    let asked = 0;
    for (let number = 1; asked < 40; number += 1) {
        const [x, y] = [0.15 + 0.7 * next(), 0.2 + 0.6 * next()].map((part, i) => Math.floor(part * [box.width, box.height][i]));
        live.say({ type: 'pick', pick: number, x: x + 0.5, y: y + 0.5, seq: live.seq });
        const { node } = await live.next('picked', { pick: number });
        if (node === null) {
            continue;
        }
        asked += 1;
        await page.mouse.move(box.x + x + 0.5, box.y + y + 0.5);
        const hovered = (await shown()).hovered || null;
        if (hovered !== node) {
            wrong.push({ x, y, node, hovered });
        }
    }
    await live.close();
    assert.ok(wrong.length <= 1, `${JSON.stringify(wrong)}: an edge may run through one pixel`);
});

const here = () => page.getByRole('menu', { name: 'What is here' });

test('Alt and a click list what is there, from front to back and up to the root', async () => {
    await open();
    const { x, y } = await spotOf([-1.6, 0.35, -0.9]);
    const under = async () => {
        await here().getByRole('menuitem').first().waitFor();
        return here().getByRole('menuitem').allInnerTexts();
    };
    await page.keyboard.down('Alt');
    await page.mouse.click(x, y);
    await page.keyboard.up('Alt');
    assert.deepEqual(await under(), ['body\nSphere', 'bite\nCuts body', 'bitten\nDifference', 'root\nUnion']);
    assert.equal(await page.locator('[role=treeitem][aria-selected=true]').count(), 0, 'the click selects nothing');
    await here().getByRole('menuitem', { name: /^bitten/ }).hover();
    await until(async () => (await shown()).hovered.split(' ').includes('bitten'), 'the outline of the row under the pointer');
    await here().getByRole('menuitem', { name: /^bite/ }).first().click();
    await until(() => chosen('bite'), 'the hidden tool of the cut');
    await here().waitFor({ state: 'detached' });

    await page.mouse.click(x, y, { button: 'right' });
    await page.getByRole('menuitem', { name: 'What is here' }).click();
    assert.equal((await under())[1], 'bite\nCuts body');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('End');
    await until(async () => (await shown()).hovered.includes('root'), 'the outline of what keys come to');
    await page.keyboard.press('Enter');
    await until(() => chosen('root'), 'the root');

    const blend = await spotOf([1.4, 0, 0.6]);
    await page.keyboard.down('Alt');
    await page.mouse.click(blend.x, blend.y);
    assert.match((await under())[0], /^(left|right)\nMelts into soft$/);
    await page.keyboard.press('Escape');
    await here().waitFor({ state: 'detached' });
    const box = await picture(page).boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height - 60);
    await here().getByText('Nothing is here.').waitFor();
    await page.keyboard.press('Escape');
    await page.keyboard.up('Alt');
    assert.ok(await chosen('root'), 'the selection stays');
});

/** Pixels of the outlines' canvas: [x, y] in CSS pixels of the picture, of at least half opacity. */
const drawn = () =>
    outlines().evaluate((canvas) => {
        const copy = document.createElement('canvas');
        Object.assign(copy, { width: canvas.width, height: canvas.height });
        const brush = copy.getContext('2d', { willReadFrequently: true });
        brush.drawImage(canvas, 0, 0);
        const { data, width } = brush.getImageData(0, 0, canvas.width, canvas.height);
        const spots = [];
        for (let i = 3; i < data.length; i += 4) {
            if (data[i] > 127) {
                spots.push([((i - 3) / 4) % width, Math.floor((i - 3) / 4 / width)]);
            }
        }
        return spots;
    });

test('the outline of a ball is around its circle, and goes while the view moves', async () => {
    await open();
    await row(page, 'alone').click();
    await until(async () => (await shown()).selected === 'alone', 'its outline');
    const box = await picture(page).boundingBox();
    const centre = await spotOf([0.4, 2, 0]);
    const outline = await drawn();
    const spots = outline.map(([x, y]) => [box.x + x + 0.5 - centre.x, box.y + y + 0.5 - centre.y]);
    // A ball off the middle of a picture is an ellipse, longer by a little.
    const radius = 0.7 * centre.scale;
    const far = spots.map(([x, y]) => Math.hypot(x, y));
    assert.ok(Math.min(...far) > radius - 2 && Math.max(...far) < radius * 1.05 + 6, `${radius}: ${Math.min(...far)} to ${Math.max(...far)}`);
    const sectors = new Set(spots.map(([x, y]) => Math.floor((18 * Math.atan2(y, x)) / Math.PI)));
    assert.ok(sectors.size >= 36, `${sectors.size} of 36 directions`);

    await page.mouse.move(box.x + 200, box.y + box.height - 150);
    await page.mouse.down();
    await page.mouse.move(box.x + 260, box.y + box.height - 150, { steps: 3 });
    await until(async () => (await shown()).selected === '', 'no outline of an older picture');
    await page.mouse.up();
    await until(async () => (await shown()).selected === 'alone', 'the outline in the new view');
    assert.notDeepEqual(await drawn(), outline);
});

test('a group is outlined by all that is in it; a command takes outlines away', async () => {
    await open();
    await row(page, 'soft').click();
    await until(async () => (await shown()).selected.split(' ').includes('right'), 'the outline of a blend');
    assert.deepEqual((await shown()).selected.split(' ').sort(), ['left', 'right', 'soft']);
    assert.ok((await drawn()).length > 100);
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('outlines');
    await page.keyboard.press('Enter');
    await until(async () => (await drawn()).length === 0, 'no outline');
    assert.ok(await chosen('soft'));
});

test('what is within something else has its box drawn while it is selected', async () => {
    const inner = { ...ball('inner', 0.5, 0.2, 0.5) };
    const outer = { ...ball('outer', 0.5, 0.2, 2) };
    scene = await stage.scene({ ...DOCUMENT, root: { ...DOCUMENT.root, children: [outer, inner] } });
    page = await stage.page({ scene });
    await settled(page);
    await row(page, 'outer').click();
    await until(async () => (await shown()).selected === 'outer', 'the outline of the outer ball');
    assert.equal((await shown()).boxed, 'false');
    await row(page, 'inner').click();
    await until(async () => (await shown()).boxed === 'true', 'the box of the inner ball');
    const box = await picture(page).boundingBox();
    const spots = await drawn();
    assert.ok(spots.length > 100, `${spots.length} pixels`);
    const corners = [-0.5, 0.5].flatMap((x) => [-0.5, 0.5].flatMap((y) => [-0.5, 0.5].map((z) => [0.5 + x, 0.2 + y, z])));
    const ends = await Promise.all(corners.map(spotOf));
    const least = (axis) => Math.min(...ends.map((end) => end[axis])) - box[axis];
    for (const [i, axis] of ['x', 'y'].entries()) {
        const found = Math.min(...spots.map((spot) => spot[i]));
        assert.ok(Math.abs(found - least(axis)) < 4, `${axis} begins at ${found}, not at ${least(axis)}`);
    }
});

test('a plane, which has no end, has no outline', async () => {
    const plane = { id: 'ground', type: 'plane', transform: { translation: [0, -1, 0] } };
    scene = await stage.scene({ ...DOCUMENT, root: { ...DOCUMENT.root, children: [plane, ball('alone', 0, 0, 1)] } });
    page = await stage.page({ scene });
    await settled(page);
    await row(page, 'root').click();
    await until(async () => (await shown()).selected.includes('alone'), 'the outline of what has an end');
    await row(page, 'ground').click();
    await until(async () => (await shown()).selected === '', 'no outline');
    assert.equal((await drawn()).length, 0);
    assert.ok(await chosen('ground'));
});

test('Shift and a drag select what is seen in a rectangle, beside what is selected', async () => {
    await open();
    const drag = async (from, to, keys = []) => {
        const [a, b] = [await spotOf(from), await spotOf(to)];
        await page.keyboard.down('Shift');
        await page.mouse.move(a.x, a.y);
        await page.mouse.down();
        await page.mouse.move(b.x, b.y, { steps: 4 });
        for (const key of keys) {
            await page.keyboard.press(key);
        }
        await page.mouse.up();
        await page.keyboard.up('Shift');
    };
    const selected = () => page.locator('[role=treeitem][aria-selected=true]').evaluateAll((all) => all.map((one) => one.dataset.node).sort().join());
    const before = await page.getByTestId('state').getAttribute('data-revision');
    await drag([0, -1.6, 0], [3, 1, 0]);
    await until(async () => (await selected()) === 'left,right', 'both parts of the blend');
    await drag([-0.1, 1.5, 0], [0.9, 2.5, 0]);
    await until(async () => (await selected()) === 'alone,left,right', 'a third');
    await drag([-4, -2, 0], [3, 3, 0], ['Escape']);
    await page.getByTestId('picture').press('Shift');
    assert.equal(await selected(), 'alone,left,right');
    assert.equal(await page.locator('.view-box').count(), 0);
    assert.equal(await page.getByTestId('state').getAttribute('data-revision'), before);
});

test('a row under the pointer is outlined, also when the pointer comes from the picture', async () => {
    await open();
    const { x, y } = await spotOf([0.4, 2, 0.5]);
    await page.mouse.move(x, y);
    await until(async () => (await shown()).hovered === 'alone', 'the shape under the pointer');
    await row(page, 'left').hover();
    await until(async () => (await shown()).hovered === 'left', 'the row under the pointer');
    await page.mouse.move(x, y);
    await until(async () => (await shown()).hovered === 'alone', 'the shape again');
    const box = await picture(page).boundingBox();
    await page.mouse.move(box.x + box.width / 2, 10);
    await until(async () => (await shown()).hovered === '', 'nothing');
});

test('an edit takes the outline along', async () => {
    await open();
    await row(page, 'alone').click();
    await until(async () => (await shown()).selected === 'alone', 'its outline');
    const before = await drawn();
    await field(page, 'radius').fill('0.3');
    await page.keyboard.press('Enter');
    await settled(page);
    await until(async () => {
        const now = await drawn();
        return now.length > 0 && now.length < 0.7 * before.length;
    }, 'a smaller outline');
});
