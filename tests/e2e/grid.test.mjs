// SPDX-License-Identifier: MIT
// What the page draws and sets by how far surfaces are: the ground grid, snapping, the probe.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { documentWhen, nodeIn, picture, row, settled, useStage } from './stage.mjs';

const EYE = [0, 4, 8];
const ball = (id, at, radius) => ({ id, type: 'sphere', params: { radius }, transform: { translation: at } });
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: EYE, target: [0, 0, 0], fov: 45 },
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [ball('sun', [0.5, 0.5, 0.5], 1.2), ball('moon', [-2.5, 0.4, 0], 0.4)] },
};

const stage = useStage({ coarse: true });
let page;
let scene;
let box;

const guided = () => until(() => page.getByTestId('outlines').evaluate(({ dataset }) => dataset.guide === 'shown'), 'a guide');

async function open(options) {
    scene = await stage.scene(DOCUMENT);
    page = await stage.page({ scene, ...options });
    await settled(page);
    await guided();
    box = await picture(page).boundingBox();
}

/** A point of the scene in CSS pixels of the picture. */
function spotOf([x, y, z]) {
    const far = Math.hypot(4, 8);
    const [up, ahead] = [[0, 8 / far, -4 / far], [0, -4 / far, -8 / far]];
    const to = [x, y - EYE[1], z - EYE[2]];
    const along = (axis) => axis.reduce((sum, a, i) => sum + a * to[i], 0);
    const scale = box.height / 2 / Math.tan(Math.PI / 8) / along(ahead);
    return { x: box.width / 2 + scale * to[0], y: box.height / 2 - scale * along(up) };
}

/** Greatest opacity of the grid within two pixels of a point of the scene. */
const inkAt = (point) =>
    page.getByTestId('grid').evaluate((canvas, { x, y }) => {
        const copy = document.createElement('canvas');
        Object.assign(copy, { width: 5, height: 5 });
        const brush = copy.getContext('2d', { willReadFrequently: true });
        brush.drawImage(canvas, Math.round(x) - 2, Math.round(y) - 2, 5, 5, 0, 0, 5, 5);
        return Math.max(...brush.getImageData(0, 0, 5, 5).data.filter((_, i) => i % 4 === 3));
    }, spotOf(point));

/** Whether a ball is between the eye and a point. */
function isHidden(point) {
    const to = point.map((x, i) => x - EYE[i]);
    const far = Math.hypot(...to);
    const along = to.map((x) => x / far);
    return DOCUMENT.root.children.some(({ params: { radius }, transform: { translation } }) => {
        const apart = EYE.map((x, i) => x - translation[i]);
        const b = apart.reduce((sum, x, i) => sum + x * along[i], 0);
        const root = b * b - apart.reduce((sum, x) => sum + x * x, 0) + radius * radius;
        return root > 0 && -b - Math.sqrt(root) < far;
    });
}

test('lines of the grid are seen beside a ball, and hidden behind it and in it', async () => {
    await open();
    const points = [-2, -1, 0, 1, 2].flatMap((line) =>
        Array.from({ length: 17 }, (_, i) => [-2 + 0.25 * i + 0.1, 0, line]),
    );
    /* An edge that is nearer than a few pixels says nothing. */
    const clear = points.filter((point) =>
        [-0.06, 0.06].every((d) => [0, 2].every((i) => isHidden(point.with(i, point[i] + d)) === isHidden(point))),
    );
    const [hidden, seen] = [clear.filter(isHidden), clear.filter((point) => !isHidden(point))];
    assert.ok(hidden.length > 15 && seen.length > 30, `${hidden.length} hidden, ${seen.length} seen`);
    for (const point of seen) {
        assert.ok((await inkAt(point)) > 8, `a line at ${point}`);
    }
    for (const point of hidden) {
        assert.equal(await inkAt(point), 0, `nothing at ${point}`);
    }
});

test('while the camera moves the grid is whole and faint; a button and a command switch it', async () => {
    await open();
    const grid = page.getByTestId('grid');
    const shown = () => grid.evaluate(({ dataset }) => dataset.shown);
    const still = await inkAt([2, 0, 2]);
    await page.mouse.move(box.x + 60, box.y + box.height - 150);
    await page.mouse.down();
    await page.mouse.move(box.x + 61, box.y + box.height - 146, { steps: 3 });
    await until(async () => (await shown()) === 'whole', 'a whole grid');
    await page.mouse.move(box.x + 60, box.y + box.height - 150, { steps: 3 });
    await page.mouse.up();
    await until(async () => (await shown()) === 'hidden', 'a grid behind the balls');
    assert.ok(still > 20);

    const button = page.getByRole('button', { name: 'Ground grid' });
    assert.equal(await button.getAttribute('aria-pressed'), 'true');
    await button.click();
    assert.equal(await shown(), '');
    assert.equal(await inkAt([2, 0, 2]), 0);
    await page.reload();
    await settled(page);
    assert.equal(await button.getAttribute('aria-pressed'), 'false');
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('ground grid');
    await page.keyboard.press('Enter');
    await until(async () => (await shown()) === 'hidden', 'the grid again');
});

/** What the server says is under a point of the picture, in CSS pixels. */
async function surfaceAt({ x, y }) {
    const live = await Live.open(stage.daemon, scene);
    live.look({ width: box.width, height: box.height });
    live.say({ type: 'pick', pick: 1, x, y, seq: live.seq });
    const picked = await live.next('picked', { pick: 1 });
    await live.close();
    return picked;
}

test('with Ctrl, what is moved freely goes to the surface under the pointer', async () => {
    await open();
    await row(page, 'moon').click();
    const middle = async () => {
        const parts = JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');
        return parts.find(({ motion, axis }) => motion === 'move' && axis === null)?.at;
    };
    const from = await until(middle, 'the middle of the gizmo');
    const targets = [[0.9, 1.2, 1.2], [-0.1, 0.7, 1.4], [1.2, 0.2, 1.3]].map(spotOf);
    const wanted = [];
    for (const target of targets) {
        wanted.push(await surfaceAt(target));
    }
    assert.deepEqual(wanted.map(({ node }) => node), ['sun', 'sun', 'sun']);
    await page.mouse.move(box.x + from.x, box.y + from.y);
    await page.keyboard.down('Control');
    await page.mouse.down();
    for (const [i, target] of targets.entries()) {
        await page.mouse.move(box.x + target.x, box.y + target.y, { steps: 3 });
        const far = (document) =>
            Math.hypot(...nodeIn(document, 'moon').transform.translation.map((x, k) => x - wanted[i].position[k]));
        await documentWhen(stage, scene, (document) => far(document) < 0.01, `the surface at ${JSON.stringify(target)}`);
    }
    await page.mouse.up();
    await page.keyboard.up('Control');
    await page.getByRole('button', { name: 'Undo move moon' }).waitFor();
});

test('the probe tells the node, the distance and the place under the pointer', async () => {
    await open();
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('under the pointer');
    await page.keyboard.press('Enter');
    const told = page.getByTestId('pointed');
    const node = async () => ((await told.count()) > 0 ? told.locator('dd').first().textContent() : null);
    const spot = spotOf([0.5, 0.9, 1.6]);
    const picked = await surfaceAt(spot);
    await page.mouse.move(box.x + spot.x, box.y + spot.y);
    await until(async () => (await node()) === 'sun', 'the node');
    const numbers = (await told.locator('dd').allTextContents()).slice(1).join(' ').match(/-?\d+(\.\d+)?/g).map(Number);
    const wanted = [picked.distance, ...picked.position];
    wanted.forEach((x, i) => assert.ok(Math.abs(numbers[i] - x) < 0.01, `${numbers} for ${wanted}`));
    await page.mouse.move(box.x + box.width / 2, box.y + 120);
    await until(async () => (await node()) === 'nothing', 'nothing above the horizon');
    await picture(page).dispatchEvent('pointerleave');
    await told.waitFor({ state: 'detached' });
});

test('a probe that is switched on by keys tells what is under a pointer that rests', async () => {
    await open();
    const spot = spotOf([0.5, 0.9, 1.6]);
    await page.mouse.move(box.x + spot.x, box.y + spot.y);
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('under the pointer');
    await page.keyboard.press('Enter');
    const told = page.getByTestId('pointed').locator('dd').first();
    await until(async () => (await told.count()) > 0 && (await told.textContent()) === 'sun', 'the node');
});
