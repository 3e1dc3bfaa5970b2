// SPDX-License-Identifier: MIT
// The graph of nodes: the same selection, keys and undo as the tree, and what its wires do to the
// document on the server.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { until } from '../support/daemon.mjs';
import {
    closePage,
    difference,
    documentWhen,
    dragBy,
    field,
    nodeIn,
    picture,
    pixels,
    row,
    settled,
    useStage,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

/** Cards near enough that they show their values. */
async function near() {
    const head = page.locator('.graph-head');
    await until(async () => {
        await head.getByRole('button', { name: 'Enlarge' }).click();
        return (await page.locator('.graph-flow[data-far]').count()) === 0;
    }, 'cards with values');
}

const card = (node) => page.locator(`[data-card="${node}"]`);
const grip = (node, what) => card(node).locator(`[data-grab="${what}"]`);
const inputOf = (node, index) => card(node).locator(`[data-index="${index}"]`);
const heldSays = () => page.locator('.graph-say').innerText();
const childrenOf = (document, node) => (nodeIn(document, node).children ?? []).map((child) => child.id);
const when = (holds, what) => documentWhen(stage, id, holds, what);
const inputsBecome = (node, wanted) =>
    when((document) => childrenOf(document, node).join() === wanted.join(), `${node}: ${wanted}`);

async function open(options = {}) {
    id = await stage.scene(options.document);
    page = await stage.page({ width: 1440, height: 1000, ...options, scene: id });
    await page.keyboard.press('Alt+1');
    await card('root').waitFor();
}

/** The middle of an element, or a point of the window. */
async function pointOf(target) {
    if ('x' in target) {
        return target;
    }
    const box = await target.boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Drags from one place to another and tells what the graph said it would do. */
async function drag(from, to) {
    const start = await pointOf(from);
    const end = await pointOf(to);
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    await page.mouse.move((start.x + end.x) / 2, (start.y + end.y) / 2, { steps: 4 });
    await page.mouse.move(end.x, end.y, { steps: 4 });
    const said = await heldSays();
    await page.mouse.up();
    return said;
}

/** A place of the graph where nothing is. */
async function nowhere() {
    const box = await page.locator('.graph-flow').boundingBox();
    return { x: box.x + 12, y: box.y + box.height - 30 };
}

/** The middle of the wire from a node. */
const wire = async (node) =>
    page.locator(`[data-wire="${node}"]`).evaluate((path) => {
        const { x, y } = path.getPointAtLength(path.getTotalLength() / 2);
        const at = new DOMPoint(x, y).matrixTransform(path.getScreenCTM());
        return { x: at.x, y: at.y };
    });

describe('the second view of the one tree', () => {
    test('a card for each node, inputs left of results, and the same selection', async () => {
        await open();
        const ids = await page
            .locator('[data-card]')
            .evaluateAll((cards) => cards.map((one) => one.dataset.card).sort());
        assert.deepEqual(ids, ['ball', 'crate', 'pair', 'pole', 'ring', 'root']);
        const box = async (node) => card(node).boundingBox();
        assert.ok((await box('ring')).x < (await box('pair')).x);
        assert.ok((await box('pair')).x < (await box('root')).x);
        assert.ok((await box('ball')).y < (await box('crate')).y);
        await card('crate').locator('header').click();
        await page.locator('[data-node="crate"][aria-selected="true"]').waitFor();
        await row(page, 'ring').click();
        await page.locator('[data-card="ring"][data-selected]').waitFor();
        assert.equal(await page.locator('[data-card][data-selected]').count(), 1);
    });

    test('a value of a card is the value of the inspector; a drag of it is one step', async () => {
        await open();
        await row(page, 'ball').click();
        await near();
        const start = await stage.document(id);
        const radius = card('ball').getByRole('spinbutton', { name: 'radius' });
        await dragBy(page, radius, 60, 0);
        const larger = await when((d) => nodeIn(d, 'ball').params.radius > 1, 'a larger ball');
        await card('ball').locator('header').click();
        await until(
            async () => (await field(page, 'radius').last().inputValue()) === (await radius.inputValue()),
            'the same number on both',
        );
        assert.ok(nodeIn(larger, 'ball').params.radius < 3);
        await page.locator('.graph-head h2').click();
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });

    test('keys: arrows go along wires, Space folds, Delete removes', async () => {
        await open();
        await card('root').focus();
        await page.keyboard.press('ArrowLeft');
        await page.locator('[data-card="crate"][data-selected]:focus').waitFor();
        await page.keyboard.press('ArrowDown');
        await page.locator('[data-card="pair"]:focus').waitFor();
        await page.keyboard.press(' ');
        await card('ring').waitFor({ state: 'detached' });
        assert.equal(await row(page, 'ring').count(), 0, 'folded in the tree, too');
        await page.keyboard.press(' ');
        await card('ring').waitFor();
        await page.keyboard.press('ArrowLeft');
        await page.locator('[data-card="ring"]:focus').waitFor();
        await page.keyboard.press('Delete');
        await inputsBecome('pair', ['pole']);
        await card('ring').waitFor({ state: 'detached' });
        await page.locator('[data-card="pole"]:focus').waitFor();
    });

    test('Tab reaches the active card, or the result, also where it is out of sight', async () => {
        await open();
        const head = page.locator('.graph-head');
        const push = async () => {
            const from = await nowhere();
            await page.mouse.move(from.x, from.y);
            await page.mouse.down();
            await page.mouse.move(from.x + 1000, from.y - 100, { steps: 4 });
            await page.mouse.up();
        };
        for (const node of ['root', 'ball']) {
            if (node !== 'root') {
                await row(page, node).click();
            }
            await until(async () => {
                await push();
                return (await card(node).count()) === 0;
            }, 'no card in sight');
            await head.getByRole('button', { name: 'Close' }).focus();
            await page.keyboard.press('Tab');
            await page.locator(`[data-card="${node}"]:focus`).waitFor();
            const [inner, outer] = [await card(node).boundingBox(), await page.locator('.graph-flow').boundingBox()];
            assert.ok(inner.x >= outer.x && inner.x + inner.width <= outer.x + outer.width, 'in sight');
        }
        await head.getByRole('button', { name: 'Close' }).press('Enter');
        await page.locator('[data-testid=picture]:focus').waitFor();
    });

    test('what is selected elsewhere is unfolded and comes in sight', async () => {
        const many = Array.from({ length: 40 }, (_, i) => ({ id: `s${i}`, type: 'sphere' }));
        await open({ document: { format: 'fieldcast/1', root: { id: 'root', type: 'union', children: many } } });
        await row(page, 's0').click();
        await card('s0').waitFor();
        const flow = await page.locator('.graph-flow').boundingBox();
        await until(async () => {
            const box = await card('s0').boundingBox();
            return box && box.y >= flow.y && box.y + box.height <= flow.y + flow.height;
        }, 'the first card in sight');
        assert.ok((await page.locator('[data-card]').count()) < 40, 'cards out of sight are not drawn');
        await card('s0').focus();
        await page.keyboard.press('ArrowRight');
        await page.locator('[data-card="root"]:focus').waitFor();
        await card('s0').waitFor({ state: 'detached' });
        await page.keyboard.press('ArrowLeft');
        await page.locator('[data-card="s19"]:focus').waitFor();
    });

    test('isolate shows a part alone and is no edit; mute hides it', async () => {
        await open();
        await row(page, 'ball').click();
        await near();
        await page.keyboard.press('Escape');
        await settled(page);
        const start = await stage.document(id);
        const whole = await pixels(page);
        await card('ball').getByRole('button', { name: 'Isolate ball' }).click();
        await until(async () => difference(await pixels(page), whole) > 8, 'the ball alone');
        await card('ball').getByRole('button', { name: 'Show all again' }).click();
        await until(async () => difference(await pixels(page), whole) === 0, 'all of it again');
        assert.equal(await stage.document(id), start);
        await row(page, 'pair').click();
        await card('pair').getByRole('button', { name: 'Hide pair' }).click();
        await when((d) => nodeIn(d, 'pair').visible === false, 'a hidden pair');
    });
});

describe('wires', () => {
    test('an input is dragged to another place among its siblings', async () => {
        await open();
        const said = await drag(inputOf('root', 0), inputOf('root', 2));
        assert.equal(said, 'Make it input 3 of root');
        await inputsBecome('root', ['crate', 'pair', 'ball']);
        await page.keyboard.press('Control+z');
        await inputsBecome('root', ['ball', 'crate', 'pair']);
    });

    test('a wire goes to another card; a gap closes', async () => {
        await open();
        assert.equal(await drag(inputOf('root', 0), grip('pair', 'free')), 'Make it input 3 of pair');
        await inputsBecome('pair', ['ring', 'pole', 'ball']);
        await inputsBecome('root', ['crate', 'pair']);
    });

    test('two shapes become a smooth union by a wire that is dropped on nothing', async () => {
        await open();
        await card('ball').locator('header').click();
        await page.keyboard.down('Control');
        await card('crate').locator('header').click();
        await page.keyboard.up('Control');
        assert.equal(await drag(grip('crate', 'output'), await nowhere()), 'Wrap in …');
        await page.getByRole('dialog').waitFor();
        await page.keyboard.type('smooth union');
        await page.keyboard.press('Enter');
        const wrapped = await when(
            (d) => (d.root.children ?? []).some(({ type }) => type === 'smooth_union'),
            'a smooth union',
        );
        const made = wrapped.root.children.find(({ type }) => type === 'smooth_union');
        assert.deepEqual(childrenOf(wrapped, made.id), ['ball', 'crate']);
        await page.keyboard.press('Control+z');
        await inputsBecome('root', ['ball', 'crate', 'pair']);
    });

    test('a wire that is pulled off and dropped on nothing parks its node', async () => {
        await open();
        const from = await wire('ring');
        assert.equal(await drag(from, await nowhere()), 'Put on the shelf');
        const parked = await when((d) => childrenOf(d, 'pair').join() === 'pole', 'the ring gone');
        const shelf = parked.root.children.at(-1);
        assert.deepEqual([shelf.name, shelf.visible], ['Shelf', false]);
        assert.deepEqual(childrenOf(parked, shelf.id), ['ring']);
    });

    test('a free input asks what becomes one', async () => {
        await open();
        assert.equal(await drag(grip('pair', 'free'), await nowhere()), 'Add an input …');
        await page.getByRole('dialog').waitFor();
        await page.keyboard.type('donut');
        await page.keyboard.press('Enter');
        const added = await when((d) => childrenOf(d, 'pair').length === 3, 'a third input');
        assert.equal(nodeIn(added, 'pair').children.at(-1).type, 'torus');
    });

    test('a card that holds others comes between the ends of a wire; a shape does not', async () => {
        await open();
        assert.equal(await drag(card('crate').locator('header'), await wire('ball')), 'It does not fit here');
        const said = await drag(card('pair').locator('header'), await wire('ball'));
        assert.equal(said, 'Put between ball and its result');
        await inputsBecome('root', ['pair', 'crate']);
        await inputsBecome('pair', ['ring', 'pole', 'ball']);
    });

    test('Esc lets go of what is held and changes nothing', async () => {
        await open();
        const start = await stage.document(id);
        const from = await pointOf(inputOf('root', 0));
        await page.mouse.move(from.x, from.y);
        await page.mouse.down();
        await page.mouse.move(from.x - 80, from.y + 60, { steps: 4 });
        await page.locator('.graph-say').waitFor();
        await page.keyboard.press('Escape');
        await page.locator('.graph-say').waitFor({ state: 'detached' });
        await page.mouse.up();
        assert.equal(await stage.document(id), start);
        assert.equal(await picture(page).count(), 1);
    });

    test('cutters show themselves, or by a switch the result', async () => {
        const cut = { id: 'cut', type: 'difference', children: [{ id: 'a', type: 'sphere' }, { id: 'b', type: 'box' }] };
        await open({ document: { format: 'fieldcast/1', root: { id: 'root', type: 'union', children: [cut] } } });
        const pictureOf = async (node) => {
            const image = card(node).locator('.thumbnail img').first();
            await image.waitFor();
            return image.getAttribute('src');
        };
        assert.notEqual(await pictureOf('b'), await pictureOf('cut'));
        await page.getByRole('button', { name: 'Cutters and modifiers show the result' }).click();
        await until(async () => (await pictureOf('b')) === (await pictureOf('cut')), 'the result on the card of a cutter');
        assert.notEqual(await pictureOf('a'), await pictureOf('cut'));
    });

    test('the operands of a difference are put in order in three ways, with the same document', async () => {
        const cut = { id: 'cut', type: 'difference', children: [{ id: 'a', type: 'sphere' }, { id: 'b', type: 'box' }] };
        const document = { format: 'fieldcast/1', root: { id: 'root', type: 'union', children: [cut] } };
        const texts = [];
        const ways = [
            () => drag(inputOf('cut', 1), inputOf('cut', 0)),
            async () => {
                await card('b').focus();
                await card('b').locator('header').click();
                await page.keyboard.press('Alt+ArrowUp');
            },
            async () => {
                const box = await row(page, 'a').boundingBox();
                await row(page, 'b').dragTo(row(page, 'a'), { targetPosition: { x: box.width / 2, y: 3 } });
            },
        ];
        for (const way of ways) {
            await open({ document });
            await way();
            await inputsBecome('cut', ['b', 'a']);
            texts.push(await stage.document(id));
            await closePage(page);
        }
        page = null;
        assert.equal(texts[1], texts[0]);
        assert.equal(texts[2], texts[0]);
    });
});
