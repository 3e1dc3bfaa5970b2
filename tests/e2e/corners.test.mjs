// SPDX-License-Identifier: MIT
// Corners of a flat shape in the picture: dragged in their plane, put in by a double click, taken away.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import {
    documentWhen,
    nodeIn,
    picture,
    pictureChanged,
    pixels,
    row,
    SCENE,
    settled,
    useStage,
} from './stage.mjs';

const POINTS = [
    [-1, -1],
    [1, -1],
    [0, 1],
];
/* The camera looks along Z: the plane of the points is that of the picture. */
const scene = (type, params = {}) => ({
    ...SCENE,
    camera: { position: [0, 0, 6], target: [0, 0, 0] },
    root: {
        id: 'solid',
        type,
        params,
        material: 'clay',
        children: [{ id: 'shape', type: 'polygon', params: { points: POINTS } }],
    },
});

const stage = useStage({ coarse: true });
let page;
let id;

async function open(type, params) {
    id = await stage.scene(scene(type, params));
    page = await stage.page({ scene: id, width: 1440, height: 900 });
    await row(page, 'shape').click();
    await settled(page);
    await until(async () => (await corners()).length === POINTS.length, 'three corners');
}

/** Where the corners are in the window, as the page says that it drew them. */
async function corners() {
    const parts = JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');
    const box = await picture(page).boundingBox();
    return parts
        .filter(({ look }) => look === 'corner')
        .map(({ at }) => ({ x: box.x + at.x, y: box.y + at.y }));
}
const between = (a, b) => [(a.x + b.x) / 2, (a.y + b.y) / 2];
const points = (document) => nodeIn(document, 'shape').params.points;
const when = (holds, what) => documentWhen(stage, id, holds, what);
const near = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.03;

for (const [type, params] of [['extrude'], ['revolve'], ['revolve', { offset: 0.5 }]]) {
    test(`a corner is dragged, as one step of undo: ${type} ${JSON.stringify(params ?? {})}`, async () => {
        await open(type, params);
        const start = await stage.document(id);
        const before = await pixels(page);
        const [left, , top] = await corners();
        const { x, width } = await picture(page).boundingBox();
        const unit = (top.x - left.x) / (POINTS[2][0] - POINTS[0][0]);
        assert.ok(Math.abs(top.x - (x + width / 2) - unit * (params?.offset ?? 0)) < 1, 'corners on the shape');
        await page.mouse.move(top.x, top.y);
        await page.mouse.down();
        await page.mouse.move(top.x + 40, top.y, { steps: 4 });
        await page.mouse.up();
        const moved = await when((d) => points(d)[2][0] > 0.1, 'the corner at the right');
        assert.ok(Math.abs(points(moved)[2][1] - 1) < 0.01, JSON.stringify(points(moved)));
        assert.deepEqual(points(moved).slice(0, 2), POINTS.slice(0, 2));
        await pictureChanged(page, before, 'another shape');
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });
}

test('a double click on an edge puts a corner there, Delete takes it away, not below three', async () => {
    await open('extrude');
    const [left, right] = await corners();
    await page.mouse.dblclick(...between(left, right));
    const four = await when((d) => points(d).length === 4, 'four corners');
    assert.ok(near(points(four)[1], [0, -1]), JSON.stringify(points(four)));
    assert.equal(await row(page, 'shape').getAttribute('aria-selected'), 'true');
    await page.keyboard.press('Delete');
    const three = await when((d) => points(d).length === 3, 'three corners');
    assert.deepEqual(points(three), POINTS);
    await page.keyboard.press('Delete');
    await page.getByText('There are 3 points at least.').waitFor();
    assert.deepEqual(points(JSON.parse(await stage.document(id))), POINTS);
    /* Without a corner that is chosen, Delete is about the node. */
    await page.keyboard.press('Escape');
    await page.keyboard.press('Delete');
    await when((d) => nodeIn(d, 'shape') === null, 'the shape to be gone');
});
