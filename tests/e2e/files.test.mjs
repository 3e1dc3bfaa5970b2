// SPDX-License-Identifier: MIT
// Files in the editor, dropped or chosen, and nodes that go from one scene to another as text.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { describe, test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { documentWhen, nodeIn, picture, row, useStage, waitForSaved } from './stage.mjs';

const THESIS = new URL('../import/thesis/', import.meta.url).pathname;

const stage = useStage({ coarse: true });
let page;
let id;

const SPARE = {
    format: 'fieldcast/1',
    name: 'Spare',
    lights: [{ id: 'sun', type: 'directional', intensity: 1 }],
    materials: {
        clay: { shader: 'stripy', properties: { wide: 0.5 } },
        unused: { shader: 'phong' },
    },
    shaders: {
        stripy: {
            properties: [{ name: 'wide', type: 'float', default: 0.2, range: [0, 1] }],
            code: 'vec3 shade(FragmentProperties properties) { return vec3(wide); }\n',
        },
    },
    primitives: {
        knob: {
            params: [{ name: 'span', type: 'float', default: 0.5, range: [0, 4] }],
            code: 'float sdf(vec3 p) { return length(p) - span; }\n',
        },
    },
    models: { knobs: { id: 'ball', type: 'field', material: 'clay', params: { primitive: 'knob', span: 0.3 } } },
    root: { id: 'root', type: 'union', children: [{ id: 'crate', type: 'model', params: { model: 'knobs' } }] },
};
const spareFile = { name: 'spare.json', type: 'application/json', bytes: [...Buffer.from(JSON.stringify(SPARE))] };

/** Radiance without compression: 4 by 2 pixels of one colour. */
const HDR = {
    name: 'sky.hdr',
    type: '',
    bytes: [
        ...Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n'),
        ...Array.from({ length: 8 }, () => [90, 120, 200, 129]).flat(),
    ],
};

async function open(options = {}) {
    id = await stage.scene(options.document);
    page = await stage.page({ width: 1440, height: 900, ...options, scene: id });
    await picture(page).waitFor();
}

const transfer = (files) =>
    page.evaluateHandle((list) => {
        const data = new DataTransfer();
        for (const { name, type, bytes } of list) {
            data.items.add(new File([new Uint8Array(bytes)], name, { type }));
        }
        return data;
    }, files);

/** The parts that take drops are loaded when the page has time. */
async function hover(files) {
    const dataTransfer = await transfer(files);
    await until(async () => {
        await picture(page).dispatchEvent('dragover', { dataTransfer });
        return (await page.getByTestId('drop-zone').count()) === 1;
    }, 'a zone to drop in');
    return dataTransfer;
}

async function drop(files) {
    const dataTransfer = await hover(files);
    await picture(page).dispatchEvent('drop', { dataTransfer });
    await page.getByTestId('drop-zone').waitFor({ state: 'detached' });
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const says = (text) => page.locator('.notices').getByText(text).waitFor();

/** What has come into a scene with a material of the same name. */
function checkArrived(document, node) {
    const instance = nodeIn(document, node);
    assert.equal(instance.params.model, 'knobs');
    const { knobs } = document.models;
    assert.notEqual(knobs.id, 'ball', 'the id is in use');
    assert.equal(knobs.material, 'clay-1');
    assert.deepEqual(knobs.params, { primitive: 'knob', span: 0.3 });
    assert.deepEqual(document.materials['clay-1'], SPARE.materials.clay);
    assert.deepEqual(document.shaders, SPARE.shaders);
    assert.deepEqual(document.primitives.knob, SPARE.primitives.knob);
    assert.equal(document.materials.unused, undefined);
}

describe('a scene that is dropped', () => {
    test('is inserted with what it uses, renamed where it collides, in one step of undo', async () => {
        await open();
        const start = await stage.document(id);
        await drop([spareFile]);
        await page.getByTestId('offer').getByRole('button', { name: /^Insert into this scene/ }).click();
        const document = await when((d) => d.models?.knobs, 'the model');
        const spare = document.root.children.find((child) => child.name === 'Spare');
        assert.equal(document.lights.length, 1);
        assert.deepEqual(document.materials.clay, JSON.parse(start).materials.clay);
        checkArrived(document, spare.children[0].id);
        await row(page, spare.id).and(page.locator('[aria-selected="true"]')).waitFor();
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the scene as it was');
    });

    test('is opened as a scene of its own; this one stays', async () => {
        await open();
        const start = await stage.document(id);
        await drop([spareFile]);
        await page.getByTestId('offer').getByRole('button', { name: /^Open as a new scene/ }).click();
        await page.locator('.bar-name').getByText('Spare').waitFor();
        assert.equal(await stage.document(id), start);
    });

    test('is refused with its line where it is wrong, and nothing is changed', async () => {
        await open();
        const start = await stage.document(id);
        const text = JSON.stringify({ ...SPARE, root: { id: 'root', type: 'sphere', params: { radus: 1 } } }, null, 1);
        await drop([{ ...spareFile, bytes: [...Buffer.from(text)] }]);
        await page.getByTestId('offer').getByRole('button', { name: /^Insert/ }).click();
        await says(/spare\.json was not inserted\. Line \d+: sphere has no radus/);
        assert.equal(await stage.document(id), start);
    });

    test('a file chosen in the palette is asked about, too', async () => {
        await open();
        await page.keyboard.press('Control+k');
        const chooser = page.waitForEvent('filechooser');
        await page.keyboard.insertText('insert files');
        await page.getByRole('option', { name: /Open or insert files/ }).click();
        const { name, bytes, type } = spareFile;
        await (await chooser).setFiles([{ name, mimeType: type, buffer: Buffer.from(bytes) }]);
        await page.getByTestId('offer').waitFor();
        await page.keyboard.press('Escape');
        await page.getByTestId('offer').waitFor({ state: 'detached' });
    });
});

describe('other files that are dropped', () => {
    test('a picture becomes the backdrop; one step of undo', async () => {
        await open();
        const start = await stage.document(id);
        await drop([HDR]);
        const { environment } = await when((d) => d.environment?.type === 'image', 'a picture around');
        assert.match(environment.image, /^[0-9a-f]{64}$/);
        await says('sky.hdr is the backdrop now.');
        await waitForSaved(page);
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the scene as it was');
    });

    test('a JPEG, too: the server gets a PNG of it', async () => {
        await open();
        const bytes = await page.evaluate(async () => {
            const canvas = new OffscreenCanvas(16, 8);
            canvas.getContext('2d').fillRect(0, 0, 16, 8);
            const blob = await canvas.convertToBlob({ type: 'image/jpeg' });
            return [...new Uint8Array(await blob.arrayBuffer())];
        });
        await drop([{ name: 'sky.jpg', type: 'image/jpeg', bytes }]);
        const { environment } = await when((d) => d.environment?.type === 'image', 'a picture around');
        const asset = await fetch(`${stage.daemon.url}/v1/assets/${environment.image}`);
        assert.equal(asset.headers.get('content-type'), 'image/png');
    });

    test('files of the other format become a scene', async () => {
        await open();
        const names = fs.readdirSync(THESIS, { recursive: true, encoding: 'utf8' });
        const files = names
            .filter((name) => name.endsWith('.json'))
            .map((name) => ({ name: name.replace(/^.*\//, ''), type: '', bytes: [...fs.readFileSync(THESIS + name)] }));
        await drop(files);
        await until(() => !page.url().endsWith(id), 'another scene');
        await page.locator('[role=treeitem]').first().waitFor();
    });

    test('what is neither is said, and changes nothing', async () => {
        await open();
        const start = await stage.document(id);
        await drop([{ name: 'notes.pdf', type: 'application/pdf', bytes: [1, 2, 3] }]);
        await says(/Nothing can be done with notes\.pdf/);
        await drop([{ name: 'broken.hdr', type: '', bytes: [1, 2, 3] }]);
        await says(/broken\.hdr did not become the backdrop/);
        assert.equal(await stage.document(id), start);
        page.expected = /400|422|415/;
    });

    test('a field that takes a picture takes it itself', async () => {
        await open({ document: { format: 'fieldcast/1', environment: { type: 'image' }, root: { id: 'root', type: 'sphere' } } });
        await hover([HDR]);
        await page.getByRole('button', { name: 'Backdrop' }).click();
        const dataTransfer = await transfer([HDR]);
        const asset = page.locator('.asset').first();
        await asset.dispatchEvent('dragover', { dataTransfer });
        await page.getByTestId('drop-zone').waitFor({ state: 'detached' });
        await asset.dispatchEvent('drop', { dataTransfer });
        await when((d) => d.environment.image, 'the picture');
        assert.equal(await page.locator('.notices').getByText('is the backdrop now').count(), 0);
    });
});

test('nodes copied in one scene are pasted in another with all that they name', async () => {
    id = await stage.scene(SPARE);
    page = await stage.page({ width: 1440, height: 900, scene: id });
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await row(page, 'crate').click();
    await page.keyboard.press('Control+c');
    await until(
        async () => (await page.evaluate(() => navigator.clipboard.readText())).includes('knobs'),
        'the nodes in the clipboard',
    );
    id = await stage.scene();
    await page.goto(`${stage.site}/s/${id}`);
    await row(page, 'crate').click();
    await page.keyboard.press('Control+v');
    const document = await when((d) => d.models?.knobs, 'the model');
    const selected = page.locator('[data-node][aria-selected="true"]');
    checkArrived(document, await selected.first().getAttribute('data-node'));
});
