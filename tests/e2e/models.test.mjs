// SPDX-License-Identifier: MIT
// Models and their instances; and everything that can be added, wrapped, looked up.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { ask } from '../support/daemon.mjs';
import {
    documentWhen,
    dragBy,
    field,
    nodeIn,
    picture,
    pictureChanged,
    picturesIn,
    pixels,
    row,
    rows,
    SCENE,
    settled,
    useStage,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(document) {
    id = await stage.scene(document);
    page = await stage.page({ scene: id });
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const inModel = (document, model, node) => nodeIn(document, node, document.models[model]);

/** Adds what is found first. */
async function add(query, option) {
    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill(query);
    await page.locator(`[role=option]${option}[aria-selected=true]`).waitFor();
    await page.keyboard.press('Enter');
}

describe('models', () => {
    test('one part becomes a model; its instances change together', async () => {
        await open();
        await row(page, 'ball').click();
        await page.keyboard.press('Control+Alt+k');
        await when((d) => nodeIn(d, 'ball-1')?.params.model === 'ball', 'the instance');
        await settled(page);
        const before = await pixels(page);
        await row(page, 'crate').click();
        await add('ball', '[data-named=ball]');
        const two = await when((d) => nodeIn(d, 'ball-2') !== null, 'the second instance');
        assert.equal(nodeIn(two, 'ball-2').params.model, 'ball');
        const y = field(page, 'translation y');
        await y.fill('1.2');
        await y.press('Enter');
        const both = await pictureChanged(page, before, 'two balls');

        await page.getByRole('button', { name: 'Edit its model' }).click();
        await page.locator('[data-node][aria-selected=true][aria-label=ball]').waitFor();
        await row(page, 'ball').click();
        await page.getByText('A change here shows in all 2 instances.').waitFor();
        await settled(page);
        const radius = field(page, 'radius');
        await radius.fill('0.6');
        await radius.press('Enter');
        await when((d) => inModel(d, 'ball', 'ball').params.radius === 0.6, 'the smaller ball');
        await pictureChanged(page, both, 'both balls to be smaller');

        await page.locator('[data-resource=ball] .resource-pick').click();
        await page.getByTestId('inspector').getByRole('button', { name: 'ball-1' }).waitFor();
        await page.getByRole('button', { name: 'More actions' }).click();
        await page.getByText(/is used by node ball-1 and 1 more/).waitFor();
        await page.keyboard.press('Escape');
        await row(page, 'ball-1').click();
        await page.getByRole('button', { name: 'Unpack the instance' }).click();
        await when((d) => nodeIn(d, 'ball-1') === null, 'the unpacked instance');
        assert.ok((await rows(page)).includes('ball-2'));
    });

    test('making a model is one step back', async () => {
        await open();
        const before = await stage.document(id);
        await row(page, 'pair').click({ button: 'right' });
        await page.getByRole('menuitem', { name: 'Make a model of it' }).click();
        await when((d) => d.models?.pair !== undefined, 'the model');
        await page.keyboard.press('Control+z');
        await when((d) => nodeIn(d, 'pair') !== null, 'the part in its place');
        assert.equal(await stage.document(id), before);
    });

    test('a model cannot be put into itself', async () => {
        await open({
            ...SCENE,
            models: { pair: { id: 'pair-root', type: 'group', children: [{ type: 'sphere', id: 's' }] } },
            root: {
                ...SCENE.root,
                children: [{ id: 'one', type: 'model', params: { model: 'pair' } }],
            },
        });
        await row(page, 's').click();
        await add('pair', '[data-named=pair]');
        await page.getByText('/models/pair -> /models/pair').waitFor();
        assert.deepEqual(await rows(page), ['root', 'one', 'pair-root', 's']);
    });
});

describe('what can be added', () => {
    test('every type is there with its picture and a line of help', async () => {
        await open();
        await settled(page);
        const schema = await ask(stage.daemon, 'GET', '/v1/schema.json');
        const { nodes } = schema['x-fieldcast'];
        await page.keyboard.press('Shift+A');
        await page.locator('[role=option][data-type=sphere] img').waitFor();
        const offered = await page
            .locator('[role=option]')
            .evaluateAll((options) => options.map((one) => [one.dataset.type, one.textContent]));
        const missing = nodes.filter(
            ({ type, doc }) =>
                type !== 'model' &&
                !offered.some(([name, text]) => name === type && text.includes(doc)),
        );
        assert.deepEqual(missing.map(({ type }) => type), []);
        const { all, without, seen, shown } = await picturesIn(page, '[role=option][data-type]');
        assert.ok(all >= nodes.length - 1, `${all} options`);
        assert.deepEqual(without, []);
        assert.ok(seen > 3 && shown === seen, `${shown} of ${seen} pictures in sight`);
        await page.keyboard.press('Escape');
    });

    test('by a synonym, by keys; a flat shape comes with its solid', async () => {
        await open();
        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill('love');
        await page.locator('[data-type=heart][aria-selected=true]').waitFor();
        await page.getByText('Comes with extrude around it.').waitFor();
        await page.keyboard.press('Enter');
        const d = await when((one) => nodeIn(one, 'heart-1') !== null, 'the heart');
        assert.deepEqual(
            nodeIn(d, 'extrude-1').children.map((child) => child.type),
            ['heart'],
        );
        await page.locator('[data-node=heart-1][aria-selected=true]').waitFor();
        await add('star', '[data-type=star]');
        const e = await when((one) => nodeIn(one, 'star-1') !== null, 'the star');
        assert.equal(nodeIn(e, 'extrude-1').children.length, 2);
        await page.keyboard.press('Control+z');
        await page.keyboard.press('Control+z');
        await when((one) => nodeIn(one, 'extrude-1') === null, 'each to be one step back');
    });

    test('the selection is wrapped in what is chosen', async () => {
        await open();
        await row(page, 'ball').click();
        await row(page, 'crate').click({ modifiers: ['Control'] });
        await page.keyboard.press('w');
        await page.getByRole('dialog', { name: 'Wrap the selection in' }).waitFor();
        assert.equal(await page.locator('[role=option][data-type=sphere]').count(), 0);
        await page.getByRole('combobox').fill('twist');
        await page.getByText('Goes around 2 nodes.').waitFor();
        await page.keyboard.press('Enter');
        const d = await when((one) => nodeIn(one, 'twist-1') !== null, 'the twist');
        assert.deepEqual(
            nodeIn(d, 'twist-1').children.map((child) => child.id),
            ['ball', 'crate'],
        );
    });
});

describe('help at hand', () => {
    test('opens at the type of what is selected, is searched, adds', async () => {
        await open();
        await row(page, 'ring').click();
        await page.getByRole('button', { name: 'What is Torus?' }).click();
        const reference = page.getByTestId('reference');
        await reference.getByRole('heading', { name: 'Torus' }).waitFor();
        await reference.getByText('exact distance').waitFor();
        await reference.getByText('Centre of the ring to centre of the tube.').waitFor();
        await reference.getByText('Source: Inigo Quilez').waitFor();
        await page.getByLabel('Search the reference').fill('melt');
        await reference.getByRole('heading', { name: 'Smooth union' }).waitFor();
        await reference.getByText('quadratic, cubic, quartic').waitFor();
        await page.getByLabel('Search the reference').fill('disc');
        await reference.getByRole('button', { name: 'Vesica' }).click();
        await reference.getByRole('button', { name: 'Add to the scene' }).click();
        await when((d) => nodeIn(d, 'vesica-1') !== null, 'the vesica');
    });

    test('tells of every type', async () => {
        await open();
        const schema = await ask(stage.daemon, 'GET', '/v1/schema.json');
        const { nodes, lights, volumes, shaders } = schema['x-fieldcast'];
        await page.keyboard.press('F1');
        const links = page.locator('.reference-link');
        await links.first().waitFor();
        const types = [nodes, lights, volumes, shaders].flat();
        assert.equal(await links.count(), types.length + 4);
        await page.keyboard.press('Escape');
        await page.getByTestId('reference').waitFor({ state: 'detached' });
    });
});

describe('points of the plane', () => {
    const flat = {
        ...SCENE,
        root: {
            id: 'root',
            type: 'union',
            children: [
                {
                    id: 'plate',
                    type: 'extrude',
                    children: [
                        {
                            id: 'shape',
                            type: 'polygon',
                            params: {
                                points: [
                                    [-1, -1],
                                    [1, -1],
                                    [0, 1],
                                ],
                            },
                        },
                    ],
                },
            ],
        },
    };
    const points = (d) => nodeIn(d, 'shape').params.points;

    test('are dragged, put in, moved by keys and taken away', async () => {
        await open(flat);
        await row(page, 'shape').click();
        await settled(page);
        const before = await pixels(page);
        const third = page.getByRole('button', { name: /^point 3:/ });
        await dragBy(page, third, 40, 0);
        const dragged = await when((d) => points(d)[2][0] > 0.2, 'the dragged point');
        assert.equal(points(dragged)[2][1], 1);
        await pictureChanged(page, before, 'the other shape');
        await third.press('ArrowDown');
        await when((d) => points(d)[2][1] < 1, 'the point moved by a key');
        await page.getByRole('button', { name: 'Add a point after this one' }).click();
        const four = await when((d) => points(d).length === 4, 'the new point');
        await page.getByRole('button', { name: /^point 4:/ }).press('Delete');
        await when((d) => points(d).length === 3, 'the point to be gone');
        assert.deepEqual(points(four)[3].length, 2);
        await page.getByRole('button', { name: 'Remove this point' }).hover();
        await page.getByText('There are 3 points at least.').waitFor();
    });
});

describe('several at once', () => {
    test('a number goes to all that have it, a place moves all by as much', async () => {
        await open();
        await row(page, 'ball').click();
        await row(page, 'crate').click({ modifiers: ['Control'] });
        await row(page, 'ring').click({ modifiers: ['Control'] });
        const radius = field(page, 'radius');
        await radius.fill('0.9');
        await radius.press('Enter');
        const d = await when((one) => nodeIn(one, 'ball').params.radius === 0.9, 'both radii');
        assert.equal(nodeIn(d, 'ring').params.radius, 0.9);
        assert.equal(nodeIn(d, 'crate').params.radius, undefined);
        const x = field(page, 'translation x');
        await x.fill('+=1');
        await x.press('Enter');
        const e = await when((one) => nodeIn(one, 'ring').transform.translation[0] === 1, 'the move');
        assert.deepEqual(
            ['ball', 'crate'].map((name) => nodeIn(e, name).transform.translation[0]),
            [-0.5, 2.5],
        );
        await page.keyboard.press('Escape');
        await row(page, 'root').click();
        await page.keyboard.press('Control+z');
        await when((one) => nodeIn(one, 'crate').transform.translation[0] === 1.5, 'one step back');
    });

    test('what the pointer rests on is shown in the tree', async () => {
        await open();
        await settled(page);
        const box = await picture(page).boundingBox();
        await page.mouse.move(box.x + box.width / 2 - 140, box.y + box.height / 2);
        await page.mouse.move(box.x + box.width / 2 - 130, box.y + box.height / 2);
        await page.locator('[data-node=ball][data-hovered]').waitFor();
        await page.mouse.move(box.x - 60, box.y + 300);
        await page.locator('[data-node][data-hovered]').waitFor({ state: 'detached' });
    });
});
