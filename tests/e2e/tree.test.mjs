// SPDX-License-Identifier: MIT
// The scene tree, by pointer and by keys: what each act makes of the document on the server.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import {
    documentWhen,
    nodeIn,
    row,
    rows,
    useStage,
} from './stage.mjs';

const stage = useStage({ driver: 'null', coarse: true });
let page;
let id;

async function open() {
    id = await stage.scene();
    page = await stage.page({ scene: id });
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const childrenOf = (document, node) => (nodeIn(document, node).children ?? []).map((c) => c.id);
const order = (...wanted) => `the order ${wanted}`;
const ordered = (node, ...wanted) =>
    when((d) => childrenOf(d, node).join() === wanted.join(), order(...wanted));

/** Presses a row and moves the pointer in steps, as a hand does. `at` is a part of its height. */
async function drag(from, to, at) {
    const a = await row(page, from).boundingBox();
    const b = await row(page, to).boundingBox();
    await page.mouse.move(a.x + 80, a.y + a.height / 2);
    await page.mouse.down();
    await page.mouse.move(a.x + 86, a.y + a.height / 2 + 4, { steps: 3 });
    await page.mouse.move(b.x + 80, b.y + b.height * at, { steps: 12 });
    await page.mouse.move(b.x + 81, b.y + b.height * at, { steps: 2 });
    await page.mouse.up();
}

describe('by keys', () => {
    test('arrows move and fold, the inspector follows', async () => {
        await open();
        await row(page, 'root').click();
        await page.keyboard.press('ArrowDown');
        await page.getByTestId('inspector').getByPlaceholder('ball').waitFor();
        await row(page, 'pair').click();
        await page.keyboard.press('ArrowLeft');
        await row(page, 'ring').waitFor({ state: 'detached' });
        await page.keyboard.press('ArrowRight');
        await row(page, 'ring').waitFor();
        assert.deepEqual(await rows(page), ['root', 'ball', 'crate', 'pair', 'ring', 'pole']);
        for (const [key, reached] of [['ArrowRight', 'ring'], ['ArrowLeft', 'pair'], ['End', 'pole'], ['Home', 'root']]) {
            await page.keyboard.press(key);
            await page.locator(`[data-node=${reached}][aria-selected=true]:focus`).waitFor();
        }
    });

    test('add by a synonym', async () => {
        await open();
        await row(page, 'crate').click();
        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill('donut');
        await page.locator('[role=option][data-type=torus][aria-selected=true]').waitFor();
        await page.keyboard.press('Enter');
        await ordered('root', 'ball', 'crate', 'torus-1', 'pair');
        await page.locator('[data-node=torus-1][aria-selected=true]').waitFor();
    });

    test('duplicate, rename, hide, delete, and all of it undone', async () => {
        await open();
        const before = await stage.document(id);
        await row(page, 'ball').click();
        await page.keyboard.press('Control+d');
        await ordered('root', 'ball', 'ball-1', 'crate', 'pair');
        await page.locator('[data-node=ball-1][aria-selected=true]').waitFor();
        await page.keyboard.press('F2');
        await page.keyboard.type('Twin');
        await page.keyboard.press('Enter');
        await when((d) => nodeIn(d, 'ball-1').name === 'Twin', 'the new name');
        await page.keyboard.press('h');
        await when((d) => nodeIn(d, 'ball-1').visible === false, 'the hidden node');
        await page.keyboard.press('h');
        await when((d) => nodeIn(d, 'ball-1').visible !== false, 'the shown node');
        await page.keyboard.press('Delete');
        await ordered('root', 'ball', 'crate', 'pair');
        for (let i = 0; i < 5; i += 1) {
            await page.keyboard.press('Control+z');
        }
        await ordered('root', 'ball', 'crate', 'pair');
        await page.waitForFunction(
            () => document.querySelector('[data-command="edit.undo"]').ariaDisabled === 'true',
        );
        assert.equal(await stage.document(id), before);
    });

    test('reorder with Alt and an arrow', async () => {
        await open();
        await row(page, 'ball').click();
        await page.keyboard.press('Alt+ArrowDown');
        await ordered('root', 'crate', 'ball', 'pair');
        await page.keyboard.press('Alt+ArrowUp');
        await ordered('root', 'ball', 'crate', 'pair');
    });

    test('carry a row to another parent', async () => {
        await open();
        await row(page, 'ball').click();
        await page.keyboard.press('Control+Shift+D');
        for (let i = 0; i < 12; i += 1) {
            const into = page.locator('[data-node=pair][data-drop=inside]');
            if ((await into.count()) > 0) {
                break;
            }
            await page.keyboard.press('ArrowDown');
        }
        await page.keyboard.press('Enter');
        await when((d) => childrenOf(d, 'pair').includes('ball'), 'the ball inside the group');
        await ordered('root', 'crate', 'pair');
    });

    test('a key typed into a field is no command', async () => {
        await open();
        await row(page, 'ball').click();
        await page.getByLabel('Filter nodes').fill('');
        await page.getByLabel('Filter nodes').press('h');
        await page.getByLabel('Filter nodes').press('Delete');
        assert.equal(nodeIn(JSON.parse(await stage.document(id)), 'ball').visible, undefined);
        assert.equal(await page.getByLabel('Filter nodes').inputValue(), 'h');
    });
});

describe('by pointer', () => {
    test('a drag between rows reorders, onto a row reparents', async () => {
        await open();
        await drag('crate', 'ball', 0.1);
        await ordered('root', 'crate', 'ball', 'pair');
        await drag('ball', 'pair', 0.5);
        await when((d) => childrenOf(d, 'pair').includes('ball'), 'the ball inside the group');
    });

    test('a node cannot be dropped into itself', async () => {
        await open();
        const before = await stage.document(id);
        await drag('pair', 'ring', 0.5);
        assert.equal(await page.locator('.notice').count(), 0);
        /* An edit that comes after whatever the drag made. */
        await row(page, 'ball').click();
        await page.keyboard.press('Control+d');
        await ordered('root', 'ball', 'ball-1', 'crate', 'pair');
        await page.keyboard.press('Control+z');
        await ordered('root', 'ball', 'crate', 'pair');
        assert.equal(await stage.document(id), before);
    });

    test('a moved node stays where it is in the world', async () => {
        await open();
        await row(page, 'pair').click();
        const y = page.getByRole('spinbutton', { name: 'translation y', exact: true });
        await y.fill('0.5');
        await y.press('Enter');
        await when((d) => nodeIn(d, 'pair').transform?.translation[1] === 0.5, 'the moved group');
        await drag('ball', 'pair', 0.5);
        const document = await when((d) => childrenOf(d, 'pair').includes('ball'), 'the drop');
        assert.deepEqual(nodeIn(document, 'ball').transform.translation, [-1.5, -0.5, 0]);
    });

    test('the eye hides and shows; the menu deletes', async () => {
        await open();
        await row(page, 'crate').hover();
        await row(page, 'crate').getByRole('button', { name: 'Hide crate' }).click();
        await when((d) => nodeIn(d, 'crate').visible === false, 'the hidden node');
        await row(page, 'crate').getByRole('button', { name: 'Show crate' }).click();
        await when((d) => nodeIn(d, 'crate').visible !== false, 'the shown node');
        await row(page, 'crate').click({ button: 'right' });
        await page.getByRole('menuitem', { name: /^Delete/ }).click();
        await ordered('root', 'ball', 'pair');
    });

    test('what is in a hidden node looks hidden', async () => {
        await open();
        const hidden = (id) => row(page, id).and(page.locator('[data-hidden]'));
        await row(page, 'pair').hover();
        await row(page, 'pair').getByRole('button', { name: 'Hide Pair' }).click();
        await hidden('ring').waitFor();
        assert.equal(await row(page, 'ring').getByRole('button', { name: 'Hide ring' }).count(), 1);
        assert.equal(await hidden('ball').count(), 0);
        await row(page, 'pair').getByRole('button', { name: 'Show Pair' }).click();
        await hidden('ring').waitFor({ state: 'detached' });
    });

    test('double click renames', async () => {
        await open();
        await row(page, 'crate').dblclick();
        await page.getByLabel('New name of crate').fill('Box of things');
        await page.keyboard.press('Enter');
        await when((d) => nodeIn(d, 'crate').name === 'Box of things', 'the new name');
        await page.keyboard.press('Control+k');
        await page.getByRole('combobox').fill('of things');
        await page.locator('[data-entry=node-crate]').click();
        await page.locator('[data-node=crate][aria-selected=true]').waitFor();
    });

    test('the filter leaves what fits and what holds it', async () => {
        await open();
        await page.getByLabel('Filter nodes').fill('torus');
        await row(page, 'ball').waitFor({ state: 'detached' });
        assert.deepEqual(await rows(page), ['root', 'pair', 'ring']);
    });
});

describe('materials and lights', () => {
    test('a new material for one node, made unique, renamed, deleted', async () => {
        await open();
        await row(page, 'ball').click();
        await page.getByRole('button', { name: 'New material' }).click();
        await page.getByRole('button', { name: 'Plain material' }).click();
        await when((d) => nodeIn(d, 'ball').material === 'material-1', 'the new material');
        await page.locator('[data-resource=material-1] .resource-pick').click();
        const name = page.getByTestId('inspector').getByLabel('Name', { exact: true });
        await name.fill('gold');
        await name.press('Enter');
        const renamed = await when((d) => nodeIn(d, 'ball').material === 'gold', 'the new name');
        assert.ok('gold' in renamed.materials && !('material-1' in renamed.materials));
        await page.locator('[data-resource=gold]').hover();
        await page.getByRole('button', { name: 'Actions for gold' }).click();
        await page.getByRole('menuitem', { name: 'Delete' }).click();
        const left = await when((d) => !('gold' in d.materials), 'the deleted material');
        assert.equal(nodeIn(left, 'ball').material, undefined);
    });

    test('a material that two nodes share is made unique for one', async () => {
        await open();
        await row(page, 'crate').click();
        await page.getByRole('combobox', { name: 'material' }).click();
        await page.getByRole('option', { name: 'clay' }).click();
        await when((d) => nodeIn(d, 'crate').material === 'clay', 'the shared material');
        await page.getByRole('button', { name: 'Make unique' }).click();
        const d = await when((one) => nodeIn(one, 'crate').material === 'clay-1', 'its own one');
        assert.equal(nodeIn(d, 'ball').material, 'clay');
        assert.deepEqual(d.materials['clay-1'], d.materials.clay);
    });

    test('a light is added, changed and removed', async () => {
        await open();
        await page.getByRole('button', { name: 'Add a light' }).click();
        await page.getByRole('menuitem', { name: 'Point' }).click();
        await when((d) => d.lights.some((light) => light.id === 'point-1'), 'the new light');
        const intensity = page.getByRole('spinbutton', { name: 'intensity', exact: true });
        await intensity.fill('2.5');
        await intensity.press('Enter');
        await when((d) => d.lights[1].intensity === 2.5, 'the new intensity');
        await page.locator('[data-resource=point-1]').hover();
        await page.getByRole('button', { name: 'Actions for point-1' }).click();
        await page.getByRole('menuitem', { name: 'Delete' }).click();
        await when((d) => d.lights.length === 1, 'the light to be gone');
    });
});

describe('carrying a row', () => {
    test('a line shows where it will be put, also while the pointer rests', async () => {
        await open();
        const [a, b] = [await row(page, 'crate').boundingBox(), await row(page, 'ball').boundingBox()];
        await page.mouse.move(a.x + 80, a.y + a.height / 2);
        await page.mouse.down();
        await page.mouse.move(a.x + 86, a.y + a.height / 2 + 4, { steps: 3 });
        await page.mouse.move(b.x + 80, b.y + 3, { steps: 12 });
        const line = page.locator('.tree-line');
        await line.waitFor();
        /* Longer than the tree waits before it believes that the pointer has left. */
        await page.waitForTimeout(400);
        const { y } = await line.boundingBox();
        assert.ok(Math.abs(y - b.y) < 4, `the line is at ${y}, the row at ${b.y}`);
        await page.mouse.up();
        await when((d) => d.root.children[0].id === 'crate', 'the row in its new place');
    });
});
