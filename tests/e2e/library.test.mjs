// SPDX-License-Identifier: MIT
// The library: what is saved in one scene is offered in every other, with a picture; scenes take
// copies; what is deleted comes back; a file of it fills the library of another server.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { describe, test } from 'node:test';
import { ask, until } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';
import { closePage, documentWhen, nodeIn, openStage, row, settled, useStage } from './stage.mjs';

/** A cup in a clay of its own among other things. */
const KITCHEN = {
    format: 'fieldcast/1',
    name: 'Kitchen',
    camera: { position: [0, 1.5, 7], target: [0, 0, 0] },
    materials: {
        clay: { shader: 'phong', properties: { diffuse: [0.8, 0.3, 0.2] } },
        rim: { shader: 'phong', properties: { diffuse: [0.1, 0.1, 0.4] } },
    },
    primitives: {
        egg: {
            params: [{ name: 'radius', type: 'float', default: 0.5, range: [0, 10] }],
            code: 'float sdf(vec3 p) { p.y *= 0.7; return 0.7 * (length(p) - radius); }',
        },
    },
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        children: [
            {
                id: 'mug',
                type: 'difference',
                name: 'Mug',
                material: 'clay',
                transform: { translation: [-1, 0, 0] },
                children: [
                    { id: 'body', type: 'cylinder' },
                    { id: 'hollow', type: 'cylinder', material: 'rim', params: { radius: 0.4 }, transform: { translation: [0, 0.2, 0] } },
                ],
            },
            { id: 'breakfast', type: 'field', params: { primitive: 'egg' }, transform: { translation: [1, 0, 0] } },
        ],
    },
};
const TABLE = {
    format: 'fieldcast/1',
    name: 'Table',
    camera: { position: [0, 1.5, 7], target: [0, 0, 0] },
    materials: { clay: { shader: 'phong', properties: { diffuse: [0.2, 0.6, 0.3] } } },
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [{ id: 'top', type: 'box', material: 'clay', params: { size: [3, 0.2, 2] } }] },
};

const stage = useStage({ coarse: true });
let page;

const entries = async (from = stage) => (await ask(from.daemon, 'GET', '/v1/library')).entries;
const names = async (from) => (await entries(from)).map(({ name }) => name).sort();
const library = () => page.getByTestId('library');
const card = (name) => library().locator('.card').filter({ hasText: name });
const notice = (text) => page.locator('.notice').filter({ hasText: text });

async function empty() {
    for (const { id } of await entries()) {
        await ask(stage.daemon, 'DELETE', `/v1/library/${id}`);
    }
}

async function open(document, from = stage) {
    const id = await from.scene(document);
    page = await from.page({ scene: id, height: 900 });
    await settled(page);
    return id;
}

/** Chooses in the menu of a node. */
async function choose(node, item) {
    await row(page, node).click({ button: 'right' });
    await page.getByRole('menuitem', { name: item }).click();
}

async function openLibrary() {
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('My library');
    await page.locator('[data-entry="command-library.open"]').click();
    await library().waitFor();
}

async function cardMenu(name, item) {
    await card(name).getByRole('button', { name: `Actions for ${name}` }).click();
    await page.getByRole('menuitem', { name: item }).click();
}

/** Waits until the picture of a card is there, and answers its pixels. */
async function pictureOf(name) {
    const image = card(name).locator('img');
    await until(() => image.evaluate((one) => !one.hidden && one.naturalWidth > 0), `the picture of ${name}`);
    return decodePng(await image.screenshot());
}

describe('the library', () => {
    test('a node that is saved in one scene is a copy in another', async () => {
        await empty();
        await open(KITCHEN);
        await choose('mug', 'Save to My library');
        await notice('“Mug” is in My library.').waitFor();
        assert.deepEqual(await names(), ['Mug']);
        const [saved] = await entries();
        const kept = await ask(stage.daemon, 'GET', `/v1/library/${saved.id}`);
        assert.equal(kept.kind, 'model');
        assert.deepEqual(Object.keys(kept.document.materials).sort(), ['clay', 'rim']);
        assert.equal(kept.document.root.transform, undefined, 'it stands at the origin');
        await closePage(page);

        const table = await open(TABLE);
        await row(page, 'root').click();
        await page.keyboard.press('Shift+A');
        const tile = page.locator('[data-type="library"]');
        await tile.scrollIntoViewIfNeeded();
        await tile.locator('img').waitFor();
        assert.equal(await tile.getAttribute('data-named'), saved.id);
        await page.keyboard.type('mug');
        /* A capped cone is found by this word too, behind what is named so. */
        await until(async () => (await page.getByRole('option').count()) === 2, 'two matches');
        assert.equal(await page.getByRole('option').first().getAttribute('data-type'), 'library');
        await page.keyboard.press('Enter');
        const after = await documentWhen(stage, table, (d) => d.root.children.length === 2, 'the mug');
        const mug = after.root.children[1];
        assert.equal(mug.name, 'Mug');
        assert.equal(mug.type, 'difference');
        /* The table has another clay: it stays, and the mug brings its own. */
        assert.equal(mug.material, 'clay-1');
        assert.deepEqual(after.materials['clay-1'].properties.diffuse, [0.8, 0.3, 0.2]);
        assert.deepEqual(after.materials.clay.properties.diffuse, [0.2, 0.6, 0.3]);
        await settled(page);

        await ask(stage.daemon, 'DELETE', `/v1/library/${saved.id}`);
        assert.equal(nodeIn(JSON.parse(await stage.document(table)), mug.id).type, 'difference', 'a copy stays');
        await page.keyboard.press('Control+z');
        await documentWhen(stage, table, (d) => d.root.children.length === 1 && !d.materials['clay-1'], 'one step takes it back');
    });

    test('has a card with a picture, a name that can be changed, and a way back from deleting', async () => {
        await empty();
        await open(KITCHEN);
        await choose('mug', 'Save to My library');
        await notice('“Mug” is in My library.').waitFor();
        await choose('breakfast', 'Save to My library');
        await until(async () => (await entries()).length === 2, 'two entries');
        await notice('“breakfast” is in My library.').getByRole('button', { name: 'Undo' }).click();
        await until(async () => (await entries()).length === 1, 'one entry again');
        await openLibrary();
        const { width, height, channels, pixels } = await pictureOf('Mug');
        let clay = 0;
        for (let i = 0; i < width * height; i += 1) {
            const [r, g, b] = pixels.subarray(i * channels, i * channels + 3);
            clay += r > g + 40 && r > b + 40;
        }
        assert.ok(clay > 0.1 * width * height, `${clay} of ${width * height} pixels are of clay`);

        await cardMenu('Mug', 'Rename');
        await page.keyboard.type('Cup <b>of</b> tea');
        await page.keyboard.press('Enter');
        await card('Cup <b>of</b> tea').waitFor();
        await until(async () => (await names())[0] === 'Cup <b>of</b> tea', 'the new name');
        const before = await ask(stage.daemon, 'GET', '/v1/library.json');

        await cardMenu('Cup <b>of</b> tea', 'Delete');
        await library().getByText('Nothing here yet.').waitFor();
        assert.deepEqual(await names(), []);
        await page.keyboard.press('Escape');
        await notice('is deleted from My library').getByRole('button', { name: 'Undo' }).click();
        await until(async () => (await names()).length === 1, 'the entry again');
        assert.deepEqual(await ask(stage.daemon, 'GET', '/v1/library.json'), before);
    });

    test('a material goes to what is selected; a primitive brings its code', async () => {
        await empty();
        await open(KITCHEN);
        await page.locator('[data-resource="rim"]').getByRole('button', { name: /Actions/ }).click();
        await page.getByRole('menuitem', { name: 'Save to My library' }).click();
        await notice('“rim” is in My library.').waitFor();
        await choose('breakfast', 'Save to My library');
        await until(async () => (await entries()).length === 2, 'two entries');
        assert.deepEqual((await entries()).map(({ kind }) => kind).sort(), ['material', 'primitive']);
        await closePage(page);

        const table = await open(TABLE);
        await row(page, 'top').click();
        await openLibrary();
        await library().getByRole('textbox').fill('material');
        await until(async () => (await library().locator('.card').count()) === 1, 'one card');
        await page.getByRole('button', { name: 'Add rim to the scene' }).click();
        const given = await documentWhen(stage, table, (d) => nodeIn(d, 'top').material === 'rim', 'the material');
        assert.deepEqual(given.materials.rim.properties.diffuse, [0.1, 0.1, 0.4]);

        await openLibrary();
        await page.getByRole('button', { name: 'Add breakfast to the scene' }).click();
        const both = await documentWhen(stage, table, (d) => d.primitives?.egg, 'the primitive');
        assert.match(both.primitives.egg.code, /length\(p\) - radius/);
    });

    test('the gallery of materials offers those of the library', async () => {
        await empty();
        await ask(stage.daemon, 'PUT', '/v1/library/mine', {
            kind: 'material',
            document: {
                format: 'fieldcast/1',
                name: 'Mine',
                materials: { mine: { shader: 'phong', properties: { diffuse: [0, 1, 0] } } },
                root: { type: 'sphere', material: 'mine' },
            },
        });
        const table = await open(TABLE);
        await row(page, 'top').click();
        await page.locator('[data-param="material"]').getByRole('button', { name: 'New material' }).click();
        await page.getByTestId('gallery').locator('[data-entry="mine"]').click();
        await documentWhen(stage, table, (d) => nodeIn(d, 'top').material === 'mine', 'the material');
    });

    test('a file of it fills the library of another server, once', async () => {
        await empty();
        await open(KITCHEN);
        await choose('mug', 'Save to My library');
        await notice('“Mug” is in My library.').waitFor();
        await choose('breakfast', 'Save to My library');
        await until(async () => (await entries()).length === 2, 'two entries');
        await openLibrary();
        const coming = page.waitForEvent('download');
        await library().getByRole('button', { name: 'Export' }).click();
        const file = path.join(os.tmpdir(), `library-${process.pid}.json`);
        const download = await coming;
        assert.equal(download.suggestedFilename(), 'my-library.json');
        await download.saveAs(file);
        const before = await ask(stage.daemon, 'GET', '/v1/library.json');
        await closePage(page);

        const other = await openStage();
        try {
            await open(TABLE, other);
            await openLibrary();
            await library().getByText('Nothing here yet.').waitFor();
            const bring = async (what) => {
                const chooser = page.waitForEvent('filechooser');
                await library().getByRole('button', { name: 'Import' }).click();
                await (await chooser).setFiles(what);
            };
            await bring(file);
            await card('Mug').waitFor();
            assert.deepEqual(await ask(other.daemon, 'GET', '/v1/library.json'), before);
            await bring(file);
            await notice('2 were there already.').waitFor();
            assert.equal((await entries(other)).length, 2);
            await bring({ name: 'scene.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(TABLE)) });
            await page.locator('.notice[data-level="error"]').waitFor();
            assert.equal((await entries(other)).length, 2);
            page.expected = /422/;
            await closePage(page);
            page = null;
        } finally {
            await other.close();
            fs.rmSync(file, { force: true });
        }
    });
});
