// SPDX-License-Identifier: MIT
// What a scene looks like: lights, volumes, what is around it, the camera's lens, effects.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LIGHTS, SHADERS, VOLUMES } from '../support/counts.mjs';
import { ask, until } from '../support/daemon.mjs';
import {
    difference,
    documentWhen,
    drawnPixels,
    field,
    forgetProblem,
    picture,
    pictureChanged,
    pixels,
    pixelsLike,
    row,
    SCENE,
    settled,
    stillPixels,
    useStage,
    valueIs,
} from './stage.mjs';

let page;
let schema;
const stage = useStage({}, async () => {
    schema = (await ask(stage.daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
});

/** Opens a scene; answers a wait for what the server holds of it. */
async function open(part = {}) {
    const id = await stage.scene({ ...SCENE, ...part });
    page = await stage.page({ scene: id });
    await settled(page);
    const when = (holds, what) => documentWhen(stage, id, holds, what);
    when.scene = id;
    return when;
}

const setup = (name) => page.getByRole('button', { name, exact: true }).click();
const toggle = (name) => page.getByRole('switch', { name, exact: true });
const choose = async (label, option) => {
    await page.getByRole('combobox', { name: label, exact: true }).click();
    await page.getByRole('option', { name: option }).click();
};

/** The colour at a part of the picture's width and height. */
function at(image, u, v) {
    const i = Math.floor(v * image.height) * image.width + Math.floor(u * image.width);
    return [...image.pixels.subarray(i * image.channels, i * image.channels + 3)];
}

const near = (a, b) => a.every((x, c) => Math.abs(x - b[c]) <= 3);

test('a light becomes another type and keeps what both know', async () => {
    const when = await open({
        lights: [{ id: 'sun', type: 'directional', color: [1, 0.5, 0.2], intensity: 2 }],
    });
    const before = await stillPixels(page);
    await page.locator('[data-resource=sun] .resource-pick').click();
    await choose('Type', 'Spot');
    const { lights } = await when((d) => d.lights[0].type === 'spot', 'the spot');
    assert.deepEqual([lights[0].color, lights[0].intensity], [[1, 0.5, 0.2], 2]);
    await field(page, 'angle').waitFor();
    await pictureChanged(page, before, 'light of a spot');
    await page.getByRole('radio', { name: 'hard' }).click();
    await when((d) => d.lights[0].shadow === 'hard', 'a hard shadow');
    await field(page, 'size').waitFor({ state: 'detached' });
});

const titleOf = (type) => type[0].toUpperCase() + type.slice(1);

/** Waits until the form has every parameter that a row always has. */
async function formOf({ params = [] }) {
    for (const { name } of params.filter((param) => !param.when)) {
        await page.locator(`[data-param="${name}"]`).first().waitFor();
    }
}

test('a light and a volume of each type can be added, and a material can have each shader', async () => {
    const when = await open();
    const { lights, volumes, shaders } = schema;
    assert.deepEqual([lights.length, volumes.length, shaders.length], [LIGHTS, VOLUMES, SHADERS]);
    for (const [list, what, rows] of [
        ['lights', 'light', lights],
        ['volumes', 'volume', volumes],
    ]) {
        for (const row of rows) {
            await page.getByRole('button', { name: `Add a ${what}` }).click();
            await page.getByRole('menuitem', { name: titleOf(row.type), exact: true }).click();
            await when((d) => d[list]?.at(-1).type === row.type, row.type);
            await formOf(row);
        }
    }
    await page.locator('[data-resource=clay] .resource-pick').click();
    for (const row of [...shaders.slice(1), shaders[0]]) {
        await choose('Shader', titleOf(row.type));
        await when((d) => d.materials.clay.shader === row.type, row.type);
        await formOf(row);
    }
    await page.keyboard.press('Control+k');
    await page.getByRole('dialog').getByRole('combobox').fill('spot light');
    await page.locator('[data-entry=add-lights-spot]').click();
    await when((d) => d.lights.at(-1).id === 'spot-2', 'another spot');
});

test('a volume is put in, changed and taken away', async () => {
    const when = await open();
    const clear = await stillPixels(page);
    await page.getByRole('button', { name: 'Add a volume' }).click();
    await page.getByRole('menuitem', { name: 'Box' }).click();
    await when((d) => d.volumes?.[0].id === 'box-1', 'a box of smoke');
    const smoky = await pictureChanged(page, clear, 'smoke');
    await field(page, 'octaves').waitFor();
    await choose('source', 'constant');
    await when((d) => d.volumes[0].source === 'constant', 'even smoke');
    await field(page, 'octaves').waitFor({ state: 'detached' });
    await pictureChanged(page, smoky, 'even smoke');
    await page.getByRole('button', { name: 'Actions for box-1' }).click();
    await page.getByRole('menuitem', { name: 'Delete' }).click();
    await when((d) => (d.volumes ?? []).length === 0, 'no volume');
});

/** A Radiance picture, 8 × 32: red above, blue below. */
function panorama() {
    const run = (value) => [128 + 8, value];
    const line = (...rgbe) => [2, 2, 0, 8, ...rgbe.flatMap(run)];
    const [red, blue] = [line(128, 0, 0, 129), line(0, 0, 128, 129)];
    const head = '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 8\n';
    return Buffer.concat([Buffer.from(head), ...[red, blue].map((one) => Buffer.from(Array(16).fill(one).flat()))]);
}

const FILE = { name: 'room.hdr', mimeType: 'image/vnd.radiance', buffer: panorama() };

test('a picture is put around the scene', async () => {
    const when = await open({ render: { samples: 1, tone_map: 'none' } });
    await setup('Backdrop');
    assert.equal(await page.getByRole('button', { name: 'Upload …' }).count(), 0);
    await page.getByRole('radio', { name: 'image' }).click();
    const chooser = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: 'Upload …' }).click();
    await (await chooser).setFiles(FILE);
    const { environment } = await when((d) => d.environment.image?.length === 64, 'the picture');
    await until(
        async () => {
            const image = await pixels(page);
            return near(at(image, 0.5, 0.02), [255, 0, 0]) && near(at(image, 0.5, 0.98), [0, 0, 255]);
        },
        'red above and blue below',
    );
    const preview = page.getByRole('img', { name: 'Preview' });
    await preview.waitFor();
    const shown = await preview.evaluate((canvas) => {
        const column = canvas.getContext('2d').getImageData(120, 0, 1, canvas.height).data;
        return [10, 110].map((y) => [...column.slice(4 * y, 4 * y + 4)]);
    });
    assert.ok(shown[0][0] > 150 && shown[0][2] === 0 && shown[1][0] === 0 && shown[1][2] > 150);
    await page.getByRole('button', { name: 'Take the picture away' }).click();
    await when((d) => !d.environment.image, 'no picture');
    await choose('Uploaded pictures', /^HDR 8 × 32/);
    await when((d) => d.environment.image === environment.image, 'the same picture');
});

test('a picture is dropped on its field; one that is none is refused there', async () => {
    const when = await open({ environment: { type: 'image' } });
    await setup('Backdrop');
    const drop = async (name, bytes) => {
        const data = await page.evaluateHandle(
            ([file, list]) => {
                const transfer = new DataTransfer();
                transfer.items.add(new File([new Uint8Array(list)], file));
                return transfer;
            },
            [name, [...bytes]],
        );
        await page.locator('.asset').dispatchEvent('drop', { dataTransfer: data });
    };
    await drop('notes.txt', Buffer.from('no picture'));
    await page.getByRole('alert').getByText(/^notes\.txt:/).waitFor();
    await drop('room.hdr', panorama());
    await when((d) => d.environment.image?.length === 64, 'the picture');
    await page.getByRole('alert').waitFor({ state: 'detached' });
    await forgetProblem(page, /status of 4(15|22)/);
});

test('forms show what belongs to the kind that is chosen', async () => {
    await open();
    await setup('Backdrop');
    await page.locator('[data-param=zenith]').waitFor();
    const shown = (name) => page.locator(`[data-param=${name}]`).count();
    assert.deepEqual([await shown('zenith'), await shown('color'), await shown('image')], [1, 0, 0]);
    await page.getByRole('radio', { name: 'solid' }).click();
    await page.locator('[data-param=color]').waitFor();
    assert.deepEqual([await shown('zenith'), await shown('image')], [0, 0]);
    assert.equal(await shown('fog_color'), 0);
    await field(page, 'fog density').fill('0.1');
    await page.keyboard.press('Enter');
    await page.locator('[data-param=fog_color]').waitFor();
    await toggle('floor shown').click();
    await page.locator('[data-param=floor_reflectivity]').waitFor();
});

test('effects are switches, and change the picture', async () => {
    const when = await open({ environment: { floor: true, floor_height: -1 } });
    const lit = await drawnPixels(page, stage, when.scene);
    await setup('Render');
    await toggle('shadows').click();
    await when((d) => d.render.shadows === false, 'no shadows');
    await pictureChanged(page, lit, 'a picture without shadows');
    await toggle('shadows').click();
    await when((d) => d.render.shadows !== false, 'shadows');
    await pixelsLike(page, lit, 2, 'shadows again');
    await choose('level', 'draft');
    await when((d) => d.render.level === 'draft', 'the level');
});

test('a click says what is sharp', async () => {
    const when = await open({ camera: { ...SCENE.camera, position: [0, 0, 7], aperture: 0.2 } });
    await setup('Camera');
    await page.getByRole('button', { name: 'Pick what to focus on' }).click();
    await page.getByText('Click what is to be sharp').waitFor();
    const box = await picture(page).boundingBox();
    /* The front of the crate: 7 away, less half of its side. */
    const scale = box.height / 2 / Math.tan(Math.PI / 8) / 6.25;
    const position = { x: box.width / 2 + 1.5 * scale, y: box.height / 2 };
    await picture(page).click({ position });
    const { camera } = await when((d) => d.camera.focus > 0, 'a focus');
    assert.ok(Math.abs(camera.focus - 6.25) < 0.01, `focus ${camera.focus}`);
    assert.equal(await page.locator('[data-node][aria-selected=true]').count(), 0);
});

test('a camera without perspective stays so when it is turned', async () => {
    const flat = { ...SCENE.camera, type: 'orthographic', height: 8 };
    const when = await open({ camera: flat });
    const before = await stillPixels(page);
    await picture(page).focus();
    await page.keyboard.press('ArrowRight');
    await pictureChanged(page, before, 'a turned picture');
    await setup('Camera');
    await page.getByRole('button', { name: 'Use the current view' }).click();
    const { camera } = await when((d) => d.camera.position[0] !== 0, 'the camera');
    assert.deepEqual([camera.type, camera.height], ['orthographic', 8]);
});

test('a new spot light is seen, aims at what is selected, and can be switched off', async () => {
    const when = await open({ lights: [] });
    await row(page, 'ball').click();
    const dark = await drawnPixels(page, stage, when.scene);
    await page.getByRole('button', { name: 'Add a light' }).click();
    await page.getByRole('menuitem', { name: 'Spot' }).click();
    const d = await when((one) => one.lights.length === 1, 'the light');
    const [light] = d.lights;
    assert.equal(light.angle, Math.PI / 6);
    const to = [-1.5, 0, 0].map((x, i) => x - light.position[i]);
    const far = Math.hypot(...to);
    const along = to.reduce((sum, x, i) => sum + x * light.direction[i], 0);
    assert.ok(along > 0.99 * far, 'it aims at the ball');
    await valueIs(field(page, 'angle'), '30°');
    await until(async () => difference(await pixels(page), dark) > 40, 'light, by more than 40 of 255');
    await page.getByRole('button', { name: 'Switch spot-1 off' }).click();
    await when((one) => one.lights[0].visible === false, 'the light to be off');
    await pixelsLike(page, dark, 2, 'a picture as dark as before');
});
