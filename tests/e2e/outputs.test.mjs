// SPDX-License-Identifier: MIT
// Outputs live and as files, and where the time goes.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { test } from 'node:test';
import { OUTPUTS } from '../support/counts.mjs';
import { ask, until } from '../support/daemon.mjs';
import { readNpy } from '../support/npy.mjs';
import { decodePng } from '../support/png.mjs';
import {
    picture,
    pictureChanged,
    pixels,
    SCENE,
    settled,
    stillPixels,
    useStage,
} from './stage.mjs';

let page;
let schema;
const stage = useStage({}, async () => {
    schema = (await ask(stage.daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
});

/* From the front: the crate's front looks along +Z. */
const FRONT = { ...SCENE, camera: { position: [0, 0, 7], target: [0, 0, 0] } };

async function open(document = FRONT) {
    page = await stage.page({ scene: await stage.scene(document) });
    await settled(page);
}

/** The colour of the crate's front. */
async function crate() {
    const image = await pixels(page);
    const scale = image.height / 2 / Math.tan(Math.PI / 8) / 6.25;
    const i = Math.round(image.height / 2) * image.width + Math.round(image.width / 2 + 1.5 * scale);
    return [...image.pixels.subarray(i * image.channels, i * image.channels + 3)];
}

const isNormal = ([r, g, b]) => Math.abs(r - 128) < 3 && Math.abs(g - 128) < 3 && b > 252;
const pill = () => page.getByTestId('outputs');
const normalsShown = () => until(async () => isNormal(await crate()), 'the normal along Z');
const normalsGone = () => until(async () => !isNormal(await crate()), 'other colours');

test('the menu shows every output that has a picture', async () => {
    await open();
    await pill().click();
    const items = page.getByRole('menuitemradio');
    await items.first().waitFor();
    const docs = await page.locator('.menu-doc').allTextContents();
    const pictures = schema.outputs.filter((output) => output.picture);
    assert.equal(pictures.length, OUTPUTS - 1, 'all but position');
    assert.deepEqual(
        docs,
        pictures.map(({ doc }) => doc),
    );
    await items.filter({ hasText: 'Normals' }).click();
    await normalsShown();
    await pill().getByText('Normals').waitFor();
    await page.getByRole('button', { name: 'Back to the colours' }).click();
    await normalsGone();
});

test('each output can be shown, and is another picture', async () => {
    await open();
    let before = await stillPixels(page);
    for (const { name } of schema.outputs.filter(({ picture: shown }) => shown).slice(1)) {
        await page.keyboard.press('z');
        const now = await pictureChanged(page, before, name);
        await settled(page);
        before = now;
    }
    await page.keyboard.press('z');
    await pill().getByText('Colour').waitFor();
});

test('steps have a legend, in the colours of the scale', async () => {
    await open();
    const legend = page.getByTestId('legend');
    assert.equal(await legend.count(), 0);
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('show steps');
    await page.keyboard.press('Enter');
    await page.getByRole('combobox').waitFor({ state: 'detached' }); // else it takes the next key
    await legend.getByText(/64/).waitFor();
    const { scale } = schema.outputs.find(({ name }) => name === 'steps');
    assert.equal(scale.greatest, 64);
    const ramp = await legend
        .locator('.outputs-ramp')
        .evaluate((one) => getComputedStyle(one).backgroundImage);
    const shown = ramp.match(/rgb\(\d+, \d+, \d+\)/g);
    const rgb = (hex) => [1, 3, 5].map((i) => Number.parseInt(hex.slice(i, i + 2), 16)).join(', ');
    assert.deepEqual(
        shown,
        scale.colors.map((hex) => `rgb(${rgb(hex)})`),
    );
    const box = await legend.boundingBox();
    const { width } = page.viewportSize();
    assert.ok(box.x >= 0 && box.x + box.width <= width);
    await page.keyboard.press('Shift+Z');
    await legend.waitFor({ state: 'detached' });
});

test('keys and the palette change the output; a page begins with colours', async () => {
    await open();
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('show normals');
    await page.keyboard.press('Enter');
    await normalsShown();
    await pill().getByText('Normals').waitFor();
    await page.keyboard.press('Shift+Z');
    await normalsGone();
    await page.keyboard.press('z');
    await pill().getByText('Colour').waitFor({ state: 'detached' });
    await page.reload();
    await pill().getByText('Colour').waitFor();
});

test('statistics name every stage of the renderer', async () => {
    await open();
    await page.getByTestId('statistics').click();
    const table = page.locator('.stats-table').first();
    await table.waitFor();
    const rows = await table.locator('.stats-row').evaluateAll((list) =>
        list.map((one) => [one.querySelector('dt').textContent, one.querySelector('dd').textContent]),
    );
    assert.deepEqual(
        rows.slice(0, schema.stages.length).map(([name]) => name),
        schema.stages.map(({ name }) => name),
    );
    const times = Object.fromEntries(rows.map(([name, text]) => [name, Number.parseFloat(text)]));
    assert.ok(times.shade > 0 && times.encode > 0, JSON.stringify(times));
});

/** Opens the dialog by its key. */
async function dialog() {
    await page.keyboard.press('Control+Shift+S');
    const sheet = page.getByRole('dialog');
    await sheet.getByRole('button', { name: 'Download' }).waitFor();
    for (const [name, value] of [
        ['Width', '160'],
        ['Height', '90'],
    ]) {
        await sheet.getByRole('spinbutton', { name, exact: true }).fill(value);
        await page.keyboard.press('Enter');
    }
    return sheet;
}

async function save(sheet) {
    const file = page.waitForEvent('download');
    await sheet.getByRole('button', { name: 'Download' }).click();
    const download = await file;
    return { name: download.suggestedFilename(), bytes: fs.readFileSync(await download.path()) };
}

test('a picture is saved in the size asked for, from the view', async () => {
    await open();
    await picture(page).focus();
    await page.keyboard.press('ArrowRight');
    const sheet = await dialog();
    const turned = await save(sheet);
    assert.equal(turned.name, 'Table.png');
    const image = decodePng(turned.bytes);
    assert.deepEqual([image.width, image.height], [160, 90]);
    await page.keyboard.press('Escape');
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('Back to the scene');
    await page.keyboard.press('Enter');
    await page.getByRole('combobox').waitFor({ state: 'hidden' });
    const straight = await save(await dialog());
    assert.notDeepEqual(decodePng(straight.bytes).pixels, image.pixels);
});

/** Names of a ZIP's entries, by its central directory. */
function entries(zip) {
    const names = [];
    const end = zip.lastIndexOf(Buffer.from('PK\x05\x06', 'latin1'));
    let at = zip.readUInt32LE(end + 16);
    for (let i = 0; i < zip.readUInt16LE(end + 10); i += 1) {
        assert.equal(zip.toString('latin1', at, at + 4), 'PK\x01\x02');
        const length = zip.readUInt16LE(at + 28);
        names.push(zip.toString('latin1', at + 46, at + 46 + length));
        at += 46 + length + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32);
    }
    return names;
}

test('several outputs come in one file, numbers too', async () => {
    await open();
    const sheet = await dialog();
    await sheet.getByRole('checkbox', { name: 'Normals' }).check();
    const zip = await save(sheet);
    assert.equal(zip.name, 'Table.zip');
    assert.deepEqual(entries(zip.bytes).sort(), ['color.png', 'normal.png']);
    await sheet.getByRole('radio', { name: 'jpg' }).click();
    await sheet.getByText('A JPEG holds one output').waitFor();
    assert.ok(await sheet.getByRole('button', { name: 'Download' }).isDisabled());
    await sheet.getByRole('radio', { name: 'npy' }).click();
    await sheet.getByRole('checkbox', { name: 'Position' }).check();
    const npz = await save(sheet);
    assert.equal(npz.name, 'Table.npz');
    assert.deepEqual(entries(npz.bytes).sort(), ['color.npy', 'normal.npy', 'position.npy']);
});

test('a transparent picture has holes where nothing is', async () => {
    await open();
    const sheet = await dialog();
    await sheet.getByRole('switch', { name: 'Transparent' }).click();
    const { bytes } = await save(sheet);
    const image = decodePng(bytes);
    assert.equal(image.channels, 4);
    assert.equal(image.pixels[3], 0);
    assert.ok(image.pixels.some((value, i) => i % 4 === 3 && value === 255));
});

test('the value of an output stands beside it, as in the numbers of REST', async () => {
    await open();
    const box = await picture(page).boundingBox();
    const [width, height] = [Math.round(box.width), Math.round(box.height)];
    const scale = height / 2 / Math.tan(Math.PI / 8) / 6.25;
    const [x, y] = [Math.round(width / 2 + 1.5 * scale), Math.round(height / 2)];
    const value = page.getByTestId('probe').locator('output');
    const numbers = async () => (await value.innerText()).split(/\s+/).map(Number);
    await page.mouse.move(box.x + x + 0.5, box.y + y + 0.5);
    assert.equal(await value.count(), 0, 'none of the picture itself');
    const show = async (name) => {
        await pill().click();
        await page.getByRole('menuitemradio', { name }).click();
        await page.getByRole('menu').waitFor({ state: 'detached' });
        await page.mouse.move(box.x + x + 0.5, box.y + y + 0.5);
        await value.waitFor();
    };
    await show(/^Depth/);
    /* The middle of the crate's front: 6.25 before the camera, 1.5 to the right. */
    const depth = Math.hypot(6.25, (x + 0.5 - width / 2) / scale, (y + 0.5 - height / 2) / scale);
    await until(async () => Math.abs((await numbers())[0] - depth) < 2e-3, `the depth ${depth}`);
    await show(/^Normals/);
    await until(async () => (await numbers()).join() === '0,0,1', 'the normal along Z');
    await show(/^Steps/);
    const [id] = await page.evaluate(() => [location.pathname.split('/').at(-1)]);
    const camera = 'camera.position=0,0,7&camera.target=0,0,0&camera.up=0,1,0&camera.fov=45';
    const answer = await fetch(
        `${stage.daemon.url}/v1/scenes/${id}/image.npy?aov=steps&width=${width}&height=${height}&${camera}`,
    );
    const steps = readNpy(Buffer.from(await answer.arrayBuffer()));
    await until(async () => (await numbers()).join() === `${steps.values[y * width + x]}`, 'the steps of REST');
    await page.mouse.move(box.x + 2, box.y - 20);
    await value.waitFor({ state: 'detached' });
});
