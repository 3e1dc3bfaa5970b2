// SPDX-License-Identifier: MIT
// The scene as text: it follows the scene, what is typed becomes few edits, faults stand at their
// places, and nothing that two authors do is lost.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { describe, test } from 'node:test';
import { ask, program, until } from '../support/daemon.mjs';
import { documentWhen, field, nodeIn, row, useStage, waitForSaved } from './stage.mjs';

const FOLDER = new URL('../import/thesis', import.meta.url).pathname;

const stage = useStage({ coarse: true });
let page;
let id;

async function open(options = {}) {
    id = await stage.scene(options.document);
    page = await stage.page({ width: 1440, height: 1000, ...options, scene: id });
    await page.keyboard.press('Alt+2');
    await lines().first().waitFor();
}

const panel = () => page.getByTestId('text');
const lines = () => panel().locator('.cm-line');
const same = () => panel().locator('.code-state[data-good]').waitFor();
const bad = (text) => panel().locator('.code-state[data-bad]', { hasText: text }).waitFor();
const lineWith = (text) => lines().filter({ hasText: text }).first();
const when = (holds, what) => documentWhen(stage, id, holds, what);
const others = () => page.getByTestId('text-others');

/** Selects a word of the text by two clicks and types over it. */
async function retype(line, word, text) {
    const at = await lineWith(line).evaluate((element, wanted) => {
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        const range = document.createRange();
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
            const from = node.data.indexOf(wanted);
            if (from >= 0) {
                range.setStart(node, from);
                range.setEnd(node, from + wanted.length);
                const { left, right, top, height } = range.getBoundingClientRect();
                return { left, right, y: top + height / 2 };
            }
        }
        throw new Error(`no ${wanted}`);
    }, word);
    await page.mouse.move(at.left + 1, at.y);
    await page.mouse.down();
    await page.mouse.move(at.right, at.y, { steps: 3 });
    await page.mouse.up();
    await page.keyboard.insertText(text);
}

describe('the text', () => {
    test('is what the program prints, byte for byte', async () => {
        const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'text-'));
        const file = path.join(folder, 'scene.json');
        const run = spawnSync(program, ['import', FOLDER, '-o', file], { encoding: 'utf8' });
        assert.equal(run.status, 0, run.stderr);
        const text = fs.readFileSync(file, 'utf8');
        await open({ document: JSON.parse(text) });
        await same();
        await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
        await panel().locator('.cm-content').click();
        await page.keyboard.press('Control+a');
        await page.keyboard.press('Control+c');
        assert.equal(await page.evaluate(() => navigator.clipboard.readText()), text);
        fs.rmSync(folder, { recursive: true });
    });

    test('follows the inspector and other authors; the cursor keeps its place', async () => {
        await open({ height: 1600 });
        await lineWith('"pole"').click();
        await page.keyboard.press('End');
        await ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, [
            { op: 'set', at: '/camera/fov', value: 33 },
            { op: 'set', at: '/nodes/ball/name', value: 'Ball of clay' },
        ]);
        await lineWith('"Ball of clay"').waitFor();
        await lineWith('"fov": 33').waitFor();
        await page.keyboard.insertText(' ');
        assert.match(await lineWith('"pole"').innerText(), / $/);
        await row(page, 'ball').click();
        await field(page, 'radius').last().fill('1.25');
        await page.keyboard.press('Enter');
        await lineWith('"radius": 1.25').waitFor();
    });

    test('a node that is selected is marked and in sight; the cursor selects', async () => {
        await open({ height: 700 });
        await row(page, 'pole').click();
        const marked = panel().locator('.text-marked', { hasText: '"pole"' });
        await until(async () => {
            const line = (await marked.count()) === 1 && (await marked.boundingBox());
            const all = await panel().locator('.code-text').boundingBox();
            return line && line.y >= all.y && line.y + line.height <= all.y + all.height;
        }, 'the lines of the pole in sight');
        assert.equal(await panel().locator('.text-marked', { hasText: '"ring"' }).count(), 0);
        await lineWith('"ring"').click();
        await page.locator('[data-node="ring"][aria-selected="true"]').waitFor();
        await panel().locator('.text-marked', { hasText: '"ring"' }).waitFor();
        await row(page, 'root').click();
        await lineWith('"clay": ').click();
        const name = page.getByTestId('inspector').getByRole('textbox').first();
        await until(async () => (await name.inputValue()) === 'clay', 'the material in the inspector');
    });
});

describe('typing', () => {
    test('a number is one set, one step of undo, and nothing else', async () => {
        await open({ height: 1600 });
        await retype('"radius": 1', '1', '1.4');
        await panel().locator('[data-waiting]').or(panel().locator('.code-state')).first().waitFor();
        const changed = await when((d) => nodeIn(d, 'ball').params.radius === 1.4, 'the radius');
        nodeIn(changed, 'ball').params.radius = 1;
        await waitForSaved(page);
        await row(page, 'crate').click();
        await page.keyboard.press('Control+z');
        const back = await when((d) => nodeIn(d, 'ball').params.radius === 1, 'the radius as it was');
        assert.deepEqual(back, changed);
        await lineWith('"radius": 1}').waitFor();
    });

    test('Ctrl+Enter applies at once and prints anew', async () => {
        await open({ height: 1600 });
        await lines().filter({ hasText: '"children": [' }).last().click();
        await page.keyboard.press('End');
        await page.keyboard.insertText('{  "type":"box","id" :"lid"},');
        await page.keyboard.press('Control+Enter');
        await lineWith('{"id": "lid", "type": "box"},').waitFor();
        const document = await when((d) => nodeIn(d, 'lid'), 'the lid');
        assert.deepEqual(
            nodeIn(document, 'pair').children.map((child) => child.id),
            ['lid', 'ring', 'pole'],
        );
        await same();
    });

    test('faults stand at their places, the last valid scene stays, and what is typed too', async () => {
        await open({ height: 1600 });
        const start = await stage.document(id);
        await retype('"radius": 1', '1', '-1');
        await bad('1 error, not applied');
        await panel().locator('.text-faults').getByText('below the minimum').waitFor();
        await panel().locator('.cm-lintRange-error', { hasText: '-1' }).waitFor();
        assert.equal(await stage.document(id), start);
        await page.keyboard.press('Backspace');
        await page.keyboard.press('Backspace');
        await panel().locator('.text-faults').getByText('the value of "radius" is missing').waitFor();
        await page.getByRole('button', { name: /^line \d+, column \d+$/ }).click();
        await page.keyboard.insertText('2 ');
        await when((d) => nodeIn(d, 'ball').params.radius === 2, 'a valid radius');
        await same();
    });

    test('what only the server refuses comes back to its place, typed as it was', async () => {
        await open({ height: 1600 });
        const start = await stage.document(id);
        const long = 'm'.repeat(300);
        await retype('"name": "Table"', 'Table', long);
        await bad('1 error, not applied');
        await panel().locator('.text-faults').getByText('200').waitFor();
        assert.ok((await lineWith('"name"').innerText()).includes(long));
        assert.equal(await stage.document(id), start);
        await lineWith('"name"').click({ position: { x: 40, y: 8 } });
        await page.keyboard.press('End');
        await page.keyboard.press('Shift+Home');
        await page.keyboard.insertText('"name": "Desk",');
        await when((d) => d.name === 'Desk', 'a shorter name');
        await same();
    });

    test('an equation that cannot be read is marked where it stands', async () => {
        const params = { equation: 'x^2 + y^2 + z^2 = 1' };
        const document = { format: 'fieldcast/1', root: { id: 'egg', type: 'implicit', params } };
        await open({ height: 1600, document });
        await retype('"equation"', 'z^2', 'z^');
        await bad('1 place with an error');
        await panel().locator('.text-faults li').first().waitFor();
        await retype('"equation"', 'z^', 'z^4');
        await when((d) => d.root.params.equation === 'x^2 + y^2 + z^4 = 1', 'the equation');
        await same();
    });

    test('closing the text loses nothing of it', async () => {
        await open({ height: 1600 });
        await retype('"radius": 1', '1', 'one');
        await bad('1 error, not applied');
        await page.keyboard.press('Alt+2');
        await panel().waitFor({ state: 'detached' });
        await page.keyboard.press('Alt+2');
        await bad('1 error, not applied');
        await lineWith('"radius": one').waitFor();
    });
});

describe('two authors', () => {
    const patch = (...ops) => ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, ops);
    const set = (at, value) => ({ op: 'set', at, value });

    test('different values: both stay', async () => {
        await open({ height: 1600 });
        await retype('"radius": 1', '1', 'x');
        await bad('1 error, not applied');
        await patch(set('/nodes/crate/params/size', [2, 2, 2]));
        await others().getByText('Your text is kept').waitFor();
        await page.keyboard.press('Backspace');
        await page.keyboard.insertText('1.5');
        const document = await when((d) => nodeIn(d, 'ball').params.radius === 1.5, 'my radius');
        assert.deepEqual(nodeIn(document, 'crate').params.size, [2, 2, 2]);
        await lineWith('"size": [2, 2, 2]').waitFor();
        await others().waitFor({ state: 'detached' });
    });

    test('the same value: a choice', async () => {
        await open({ height: 1600 });
        const conflict = async (theirs, mine) => {
            await retype('"radius": ', await lineWith('"radius"').innerText().then((l) => /: ([\d.]+)}/.exec(l)[1]), 'x');
            await bad('1 error, not applied');
            await patch(set('/nodes/ball/params/radius', theirs));
            await others().waitFor();
            await page.keyboard.press('Backspace');
            await page.keyboard.insertText(mine);
            await others().getByText('/nodes/ball/params/radius').waitFor();
        };
        await conflict(3, '1.5');
        await page.getByRole('button', { name: 'Keep mine' }).click();
        await when((d) => nodeIn(d, 'ball').params.radius === 1.5, 'mine');
        await same();
        await conflict(2.5, '1.75');
        await page.getByRole('button', { name: 'Take theirs' }).click();
        await lineWith('"radius": 2.5').waitFor();
        await same();
        assert.equal(nodeIn(JSON.parse(await stage.document(id)), 'ball').params.radius, 2.5);
    });

    test('mine is in a node that is gone: it can be brought back', async () => {
        await open({ height: 1600 });
        await retype('"radius": 1', '1', 'x');
        await bad('1 error, not applied');
        await patch({ op: 'remove', at: '/nodes/ball' });
        await others().waitFor();
        await page.keyboard.press('Backspace');
        await page.keyboard.insertText('1.5');
        await others().getByRole('button', { name: 'Keep mine' }).click();
        await when((d) => nodeIn(d, 'ball')?.params.radius === 1.5, 'the ball again');
    });
});

test('on a phone it is a tab of the sheet, and in the menu of the scene', async () => {
    id = await stage.scene();
    page = await stage.page({ width: 390, height: 844, touch: true, scene: id });
    await page.getByRole('button', { name: 'Table' }).first().click();
    await page.getByRole('menuitem', { name: 'Scene as text' }).click();
    await lineWith('"format"').waitFor();
    await page.getByRole('tab', { name: 'Text', selected: true }).waitFor();
    await page.getByRole('tab', { name: 'Nodes' }).click();
    await page.getByRole('tab', { name: 'Text' }).click();
    await lineWith('"format"').waitFor();
    /* What does not fit into a line goes on further in than it began. */
    const starts = await lineWith('"camera"').evaluate((line) => {
        const range = document.createRange();
        range.selectNodeContents(line);
        const rows = new Map();
        for (const { left, top, width } of range.getClientRects()) {
            rows.set(top, Math.min(left + (width > 0 ? 0 : Infinity), rows.get(top) ?? Infinity));
        }
        return [...rows.keys()].sort((a, b) => a - b).map((top) => rows.get(top));
    });
    assert.ok(starts.length > 1 && starts[1] > starts[0] + 24, `${starts}`);
});
