// SPDX-License-Identifier: MIT
// What is dragged from the palette lands on the surface under the pointer, upright on it, combined with
// what is there as the palette says; where nothing is let go, nothing happens.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { ask, until } from '../support/daemon.mjs';
import { carryTo, documentWhen, nodeIn, picture, row, settled, useStage } from './stage.mjs';

const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: [0, 0, 8], target: [0, 0, 0], fov: 45 },
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'wall', type: 'box', params: { size: [2, 2, 2] }, transform: { translation: [-1.5, 0, 0] } },
            {
                id: 'turned',
                type: 'union',
                transform: { translation: [1.5, 0, 0], rotation: [0, 0, 0.5] },
                children: [{ id: 'ball', type: 'sphere', params: { radius: 1 } }],
            },
        ],
    },
};

const stage = useStage({ coarse: true });
let page;
let id;

async function open() {
    id = await stage.scene(DOCUMENT);
    page = await stage.page({ scene: id });
    await settled(page);
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const tile = (type) => page.locator(`[data-type="${type}"]`).last();
const landing = () => page.getByTestId('landing');
const close = (a, b, most = 2e-3) => assert.ok(a.length === b.length && a.every((x, i) => Math.abs(x - b[i]) < most), `${a} is ${b}`);

/** A point of the plane z = depth in CSS pixels of the window. */
async function spotOf([x, y], depth = 1) {
    const box = await picture(page).boundingBox();
    const scale = box.height / 2 / Math.tan(Math.PI / 8) / (8 - depth);
    return { x: box.x + box.width / 2 + scale * x, y: box.y + box.height / 2 - scale * y };
}

/** Opens the library and carries a card to a point. */
async function takeCard(name, point) {
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('My library');
    await page.locator('[data-entry="command-library.open"]').click();
    const card = page.getByTestId('library').locator('.card').filter({ hasText: name });
    await carryTo(page, card.locator('img'), point);
}

/** What the pointer points at is told in less time: the page has entries of the library later. */
const LATE_MS = 800;

async function delayEntries() {
    await page.route(/\/v1\/library\/[^/]+$/, async (route) => {
        await sleep(LATE_MS);
        await route.continue();
    });
}

/** Opens the palette and carries a tile to a point. */
async function take(type, point, way = 'union') {
    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill(type);
    await tile(type).hover();
    await page.locator(`[data-way="${way}"]`).click();
    await carryTo(page, tile(type), point);
}

test('a shape stands on the surface that is pointed at, seen before it is let go', async () => {
    await open();
    const start = await stage.document(id);
    await take('cylinder', await spotOf([-1.2, 0.4]));
    await landing().getByText('Beside wall.').waitFor();
    await page.getByTestId('trial').locator('img').waitFor();
    assert.equal(await page.getByRole('dialog').evaluate((one) => getComputedStyle(one).opacity), '0');
    assert.equal(await stage.document(id), start, 'a look is no edit');
    await page.mouse.up();
    const added = await when((d) => nodeIn(d, 'cylinder-1'), 'a cylinder');
    assert.deepEqual(added.root.children.map((one) => one.id), ['wall', 'cylinder-1', 'turned']);
    const { translation, rotation } = nodeIn(added, 'cylinder-1').transform;
    close(translation, [-1.2, 0.4, 1], 0.02);
    close(rotation, [Math.PI / 2, 0, 0]);
    await page.getByRole('dialog').waitFor({ state: 'detached' });
    await until(async () => (await row(page, 'cylinder-1').getAttribute('aria-selected')) === 'true', 'it is selected');
    assert.equal(await landing().count(), 0);
    await page.keyboard.press('Control+z');
    await until(async () => (await stage.document(id)) === start, 'one step takes it back');
});

test('the way of the palette combines it with what is there, in turned parents too', async () => {
    await open();
    await take('sphere', await spotOf([1.45, 0]), 'blend');
    await landing().getByText('With ball, in a new smooth union.').waitFor();
    await page.mouse.up();
    const blended = await when((d) => nodeIn(d, 'sphere-1'), 'a second ball');
    const [around] = nodeIn(blended, 'turned').children;
    assert.equal(around.type, 'smooth_union');
    assert.deepEqual(around.children.map((one) => one.id), ['ball', 'sphere-1']);
    const { translation } = around.children[1].transform;
    close([Math.hypot(...translation)], [1], 0.02);
    await settled(page);

    await row(page, 'wall').click();
    await take('box', await spotOf([-1.5, 0.5]), 'cut');
    await landing().getByText('Cuts wall, in a new difference.').waitFor();
    await page.mouse.up();
    const cut = await when((d) => nodeIn(d, 'box-1'), 'a cut');
    const [difference] = cut.root.children;
    assert.equal(difference.type, 'difference');
    assert.deepEqual(difference.children.map((one) => one.id), ['wall', 'box-1']);
});

test('let go beside the picture nothing happens, and the palette is back', async () => {
    await open();
    const start = await stage.document(id);
    await take('torus', await spotOf([-1.2, 0.4]));
    await landing().getByText('Beside wall.').waitFor();
    await page.mouse.move(300, 12, { steps: 3 });
    await landing().waitFor({ state: 'hidden' });
    await page.mouse.up();
    await until(() => page.getByRole('dialog').evaluate((one) => getComputedStyle(one).opacity === '1'), 'the palette');
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
    assert.equal(await stage.document(id), start);
});

test('what goes around others, and things of the library, land too', async () => {
    await open();
    const entry = (kind, name, material, type, diffuse) => ({
        kind,
        document: {
            format: 'fieldcast/1',
            name,
            materials: { [material]: { shader: 'phong', properties: { diffuse } } },
            root: { type, material },
        },
    });
    const entries = [
        entry('model', 'Post', 'clay', 'capsule', [0.8, 0.3, 0.2]),
        entry('material', 'Red', 'red', 'sphere', [0.9, 0, 0]),
    ];
    await ask(stage.daemon, 'POST', '/v1/library', { format: 'fieldcast-library/1', entries });
    const at = await spotOf([-1.2, 0.4]);

    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill('twist');
    await carryTo(page, tile('twist'), at);
    await landing().getByText('Goes around wall.').waitFor();
    await page.mouse.up();
    await when((d) => d.root.children[0].type === 'twist' && d.root.children[0].children[0].id === 'wall', 'a twist around it');
    await settled(page);
    await page.keyboard.press('Control+z');
    await when((d) => d.root.children[0].id === 'wall', 'the wall again');
    await settled(page);

    await delayEntries();
    await takeCard('Post', at);
    await landing().getByText('Beside wall.').waitFor();
    await page.mouse.up();
    const [, post] = (await when((d) => d.root.children[1].name === 'Post', 'the post')).root.children;
    close(post.transform.translation, [-1.2, 0.4, 1], 0.02);
    close(post.transform.rotation, [Math.PI / 2, 0, 0]);
    await settled(page);
    await takeCard('Red', at);
    await landing().getByText('For Post.').waitFor();
    await page.mouse.up();
    const red = await when((d) => d.root.children[1].material === 'red' && d, 'the material');
    assert.equal(red.root.children[0].material, undefined);
    assert.deepEqual(red.materials.red.properties.diffuse, [0.9, 0, 0]);
});
