// SPDX-License-Identifier: MIT
// Primitives made of nodes: numbers chosen as parameters, which each instance has of its own.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { ask, until } from '../support/daemon.mjs';
import { difference, documentWhen, field, nodeIn, pictureChanged, pixels, row, SCENE, settled, stillPixels, useStage } from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(document) {
    id = await stage.scene(document);
    page = await stage.page({ scene: id });
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const choose = (name) => page.getByRole('checkbox', { name: `${name} is a parameter` }).click();
const press = (name) => page.getByRole('button', { name, exact: true }).click();

async function fill(label, text) {
    const input = page.getByLabel(label, { exact: true });
    await input.fill(text);
    await input.press('Enter');
}

/** The dialog about what is selected. */
async function openDialog(node, command = 'Make a primitive of it …') {
    await row(page, node).click({ button: 'right' });
    await page.getByRole('menuitem', { name: command }).click();
    await page.getByTestId('primitive').waitFor();
}

const get = (at) => ask(stage.daemon, 'GET', at);

describe('primitives of nodes', () => {
    test('chosen numbers are fields of every instance', async () => {
        await open();
        await openDialog('pair');
        await choose('ring radius');
        await choose('pole height');
        await fill('Name of the parameter for radius', 'ring_size');
        await fill('Greatest height', '3');
        await fill('Name of the primitive', 'lamp');
        await press('Make primitive');
        const made = await when((d) => d.models?.lamp, 'the model');
        assert.deepEqual(
            made.models.lamp.params.map(({ name, type, sets }) => [name, type, sets]),
            [
                ['ring_size', 'float', '/nodes/ring/params/radius'],
                ['pole_height', 'float', '/nodes/pole/params/height'],
            ],
        );
        assert.equal(made.models.lamp.params[1].range[1], 3);
        assert.equal(nodeIn(made, 'lamp-1').params.model, 'lamp');

        await page.keyboard.press('Control+d');
        await when((d) => nodeIn(d, 'lamp-2'), 'a second instance');
        await settled(page);
        const before = await pixels(page);
        const size = field(page, 'ring size');
        await size.fill('1.2');
        await size.press('Enter');
        const set = await when((d) => nodeIn(d, 'lamp-2').params.ring_size === 1.2, 'its own number');
        assert.equal(nodeIn(set, 'lamp-1').params.ring_size, undefined);
        await pictureChanged(page, before, 'one ring to grow');
        await fill('pole height', '4');
        await page.locator('[data-param=pole_height] [data-stop], [data-param=pole_height] .form-error').first().waitFor();
    });

    test('what is drawn is the tree written out', async () => {
        const tree = (high) => ({
            type: 'union',
            children: [
                { type: 'box', params: { size: [1, high, 1] } },
                { type: 'sphere', params: { radius: 0.7 }, transform: { translation: [0, 1, 0] } },
            ],
        });
        const named = tree(1);
        named.id = 'post-root';
        named.children[0].id = 'post';
        const whole = (models, children) => ({ ...SCENE, ...models, root: { id: 'root', type: 'union', children } });
        const right = { transform: { translation: [2, 0, 0] } };
        const instanced = whole(
            {
                models: {
                    post: {
                        params: [{ name: 'high', type: 'float', sets: '/nodes/post/params/size.y', range: [0.1, 5] }],
                        root: named,
                    },
                },
            },
            [
                { id: 'a', type: 'model', params: { model: 'post', high: 2.5 } },
                { id: 'b', type: 'model', params: { model: 'post' }, ...right },
            ],
        );
        const written = whole({}, [{ ...tree(2.5) }, { ...tree(1), ...right }]);
        const draw = async (scene) => {
            const body = JSON.stringify({ scene, width: 200, height: 150, samples: 1 });
            const headers = { 'Content-Type': 'application/json' };
            const answer = await fetch(`${stage.daemon.url}/v1/render`, { method: 'POST', headers, body });
            assert.equal(answer.status, 200);
            return Buffer.from(await answer.arrayBuffer());
        };
        assert.deepEqual(await draw(instanced), await draw(written));
    });

    test('parameters are chosen anew, and go with what they set', async () => {
        await open();
        await openDialog('pair');
        await choose('ring radius');
        await choose('pole height');
        await press('Make primitive');
        await when((d) => d.models?.pair?.params?.length === 2, 'the parameters');
        const size = field(page, 'ring radius');
        await size.fill('1.5');
        await size.press('Enter');
        await when((d) => nodeIn(d, 'pair-1').params.ring_radius === 1.5, 'a value');

        await page.getByRole('button', { name: 'Choose its parameters' }).click();
        await page.getByTestId('primitive').waitFor();
        await choose('pole height');
        await fill('Name of the parameter for radius', 'across');
        await press('Save');
        const other = await when((d) => nodeIn(d, 'pair-1').params.across === 1.5, 'the other name');
        assert.deepEqual(other.models.pair.params.map(({ name }) => name), ['across']);

        await page.getByRole('button', { name: 'Edit its model' }).click();
        await row(page, 'ring').click();
        await page.keyboard.press('Delete');
        const gone = await when((d) => !d.models.pair.params, 'the parameter to go');
        assert.equal(nodeIn(gone, 'pair-1').params.across, undefined);
        await page.keyboard.press('Control+z');
        await when((d) => nodeIn(d, 'pair-1').params.across === 1.5, 'all of it again');
    });

    test('another name is followed by outer models that set it, and by all values', async () => {
        const sets = (name, place) => ({ name, type: 'float', sets: `/nodes/${place}`, range: [0.2, 2] });
        const scene = (across, bright) => ({
            ...SCENE,
            models: {
                bulb: {
                    params: [sets(across, 'glass/params/radius'), sets('foot', 'socket/params/radius')],
                    root: {
                        id: 'bulb-root',
                        type: 'group',
                        children: [
                            { id: 'glass', type: 'sphere' },
                            { id: 'socket', type: 'cylinder', transform: { translation: [0, -1, 0] } },
                        ],
                    },
                },
                lamp: {
                    params: [sets(bright, `head/params/${across}`)],
                    root: { id: 'head', type: 'model', params: { model: 'bulb', [across]: 0.4, foot: 0.3 } },
                },
                room: {
                    params: [sets('mood', `hung/params/${bright}`)],
                    root: { id: 'hung', type: 'model', params: { model: 'lamp', [bright]: 0.6 } },
                },
            },
            root: {
                ...SCENE.root,
                children: [
                    { id: 'one', type: 'model', params: { model: 'lamp', [bright]: 0.9 } },
                    { id: 'two', type: 'model', params: { model: 'room', mood: 0.7 }, transform: { translation: [2, 0, 0] } },
                    { id: 'three', type: 'model', params: { model: 'bulb', [across]: 0.8 }, transform: { translation: [-2, 0, 0] } },
                ],
            },
        });
        const printed = async (document) => stage.document(await stage.scene(document));
        const is = async (document, what) => {
            const wanted = await printed(document);
            await until(async () => (await stage.document(id)) === wanted, what);
        };
        await open(scene('wide', 'glow'));
        const start = await stage.document(id);
        await settled(page);
        const before = await stillPixels(page);
        await row(page, 'three').click();
        await page.getByRole('button', { name: 'Choose its parameters' }).click();
        await page.getByTestId('primitive').waitFor();
        await page.getByLabel('Name of the parameter for radius', { exact: true }).first().fill('across');
        await press('Save');
        await is(scene('across', 'glow'), 'the new name everywhere');
        await settled(page);
        assert.ok(difference(await stillPixels(page), before) <= 1, 'the picture stays');
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the old name everywhere');
        await field(page, 'wide').waitFor();

        await row(page, 'one').click();
        await page.getByRole('button', { name: 'Choose its parameters' }).click();
        await page.getByTestId('primitive').waitFor();
        await page.getByLabel('Name of the parameter for wide', { exact: true }).fill('bright');
        await press('Save');
        await is(scene('wide', 'bright'), 'a new name of what sets it');
    });

    test('it can go to My library alone, and comes from there with its parameters', async () => {
        await open();
        await openDialog('crate');
        await choose('crate size');
        await page.getByLabel('What of size').click();
        await page.getByRole('option', { name: 'y', exact: true }).click();
        await fill('Name of the primitive', 'slab');
        await page.getByRole('checkbox', { name: 'In My library' }).click();
        await page.getByRole('checkbox', { name: 'In this scene' }).click();
        await press('Make primitive');
        const entry = await until(async () => (await get('/v1/library')).entries.find(({ name }) => name === 'slab'), 'the entry');
        const { document } = await get(`/v1/library/${entry.id}`);
        assert.equal(document.models.slab.params[0].sets, '/nodes/crate/params/size.y');
        const now = await get(`/v1/scenes/${id}`);
        assert.equal(now.models, undefined);

        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill('slab');
        await page.locator('[role=option][aria-selected=true]', { hasText: 'slab' }).waitFor();
        await page.keyboard.press('Enter');
        const taken = await when((d) => d.models?.slab, 'the model');
        assert.equal(taken.models.slab.params[0].name, 'size_y');
        await field(page, 'size y').waitFor();
    });
});
