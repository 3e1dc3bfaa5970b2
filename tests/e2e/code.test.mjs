// SPDX-License-Identifier: MIT
// Writing code beside the picture: errors stand where they are, the last good picture stays.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { ask, until } from '../support/daemon.mjs';
import { openScreen } from './screens/screen.mjs';
import {
    closePage,
    difference,
    documentWhen,
    dragBy,
    field,
    keepsOff,
    nodeIn,
    openStage,
    pictureChanged,
    pixels,
    row,
    settled,
    stillPixels,
    useStage,
    valueIs,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

/* What a compressed picture may differ from the same one without loss. */
const LOSS = 48;

const GOOD = 'float sdf(vec3 p) {\n    return length(p) - radius;\n}\n';
const BAD = 'float sdf(vec3 p) {\n    float d = length(p);\n    return d - radios;\n}\n';
const SHADED = {
    format: 'fieldcast/1',
    camera: { position: [0, 0.5, 4] },
    lights: [{ id: 'sun', type: 'directional', intensity: 3 }],
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [{ id: 'ball', type: 'sphere' }] },
};

async function open(document = SHADED) {
    id = await stage.scene(document);
    page = await stage.page({ scene: id });
    await settled(page);
}

const panel = () => page.getByTestId('code');
const good = () => panel().locator('.code-state[data-good]').waitFor();
const bad = (text) => panel().locator('.code-state[data-bad]', { hasText: text }).waitFor();

/** Replaces the text as a hand does: select all, type over it. */
async function write(text) {
    await panel().locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(text);
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const codeIs = (list, name, text) => when((d) => d[list][name].code === text, `the code of ${name}`);

describe('a distance function', () => {
    test('is written, broken, marked at its line, mended; the picture follows', async () => {
        await open();
        await page.getByRole('button', { name: 'Write a primitive' }).click();
        await good();
        await when((d) => nodeIn(d, 'primitive-1')?.params.primitive === 'primitive-1', 'its node');
        await settled(page);
        const template = await stillPixels(page);

        await write(GOOD);
        await codeIs('primitives', 'primitive-1', GOOD);
        await good();
        await pictureChanged(page, template, 'the code in the picture');
        await settled(page);
        const before = await stillPixels(page);
        await write(BAD);
        await bad('error in line 3');
        await codeIs('primitives', 'primitive-1', BAD);
        await panel().locator('.cm-lint-marker-error').waitFor();
        await panel().getByText('line 3, column').waitFor();
        assert.equal(
            await panel().locator('.cm-line:has(.cm-lintRange-error)').textContent(),
            '    return d - radios;',
        );
        await page.getByTestId('broken').getByText('line 3').waitFor();
        assert.ok(difference(await pixels(page), before) < LOSS, 'the last good picture stays');
        /* Where the error is, is also told in the lists and in the form. */
        await page.locator('[data-resource=primitive-1] .tree-error').waitFor();
        await page.getByTestId('inspector').getByText(/^Line 3:/).waitFor();

        await write(GOOD.replace('- radius', '- 1.5 * radius'));
        await good();
        await page.getByTestId('broken').waitFor({ state: 'detached' });
        assert.equal(await panel().locator('.cm-lint-marker-error').count(), 0);
        await until(
            async () => difference(await pixels(page), before) > LOSS,
            'the mended code in the picture',
        );
    });

    test('a parameter that is declared later ends its error; the next stands at its own line', async () => {
        const code = '// wobbly\nfloat sdf(vec3 p) {\n    float d = length(p);\n    return d - wobble;\n}\n';
        const document = structuredClone(SHADED);
        document.primitives = { blob: { params: [], code } };
        document.root.children = [{ id: 'blob', type: 'field', params: { primitive: 'blob' } }];
        id = await stage.scene(document);
        page = await stage.page({ scene: id });
        const mark = page.locator('[data-resource=blob] .tree-error');
        const told = (words) => page.locator(`[data-resource=blob] .tree-error[title*="${words}"]`);
        await told('Line 4: there is no variable wobble').waitFor();
        const set = (at, value) =>
            ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, [{ op: 'set', at, value }]);
        await set('/primitives/blob/params', [{ name: 'wobble', type: 'float', default: 1 }]);
        await mark.waitFor({ state: 'detached' });
        await set('/primitives/blob/code', code.replace('- wobble', '- wobble * woggle'));
        await told('Line 4: there is no variable woggle').waitFor();
        assert.equal(await mark.count(), 1);
    });

    test('an error leads to its place; the text that is typed is not disturbed', async () => {
        /* There is nothing to draw, so no picture is waited for. */
        id = await stage.scene({
            ...SHADED,
            primitives: { rod: { code: BAD } },
            root: { type: 'field', id: 'root', params: { primitive: 'rod' } },
        });
        page = await stage.page({ scene: id });
        await page.getByTestId('broken').click();
        await panel().locator('.cm-content').waitFor();
        await panel().getByRole('button', { name: 'error in line 3' }).click();
        await page.keyboard.press('End');
        await page.keyboard.type(' // here');
        await when((d) => d.primitives.rod.code.includes('radios; // here\n'), 'the typed text');
        await page.keyboard.type(' and on');
        await when((d) => d.primitives.rod.code.includes('// here and on\n'), 'what was typed next');
    });

    test('Ctrl+Enter sends at once; a burst of typing is one step back', async () => {
        await open({ ...SHADED, primitives: { rod: { code: GOOD.replaceAll('radius', '0.5') } } });
        await page.locator('[data-resource=rod] .resource-pick').click();
        await page.getByRole('button', { name: 'Edit code' }).click();
        await good();
        await panel().locator('.cm-content').click();
        await page.keyboard.press('Control+Home');
        await page.keyboard.type('// one\n');
        await page.keyboard.press('Control+Enter');
        const first = await when((d) => d.primitives.rod.code.startsWith('// one\n'), 'the edit');
        await page.keyboard.type('// two\n');
        await when((d) => d.primitives.rod.code.includes('// two\n'), 'the second edit');
        await page.getByRole('button', { name: 'Close' }).click();
        await row(page, 'ball').click();
        await page.keyboard.press('Control+z');
        await when((d) => d.primitives.rod.code === first.primitives.rod.code, 'one step back');
    });

    test('a declared parameter is a slider of the node; its new name goes everywhere', async () => {
        await open({
            ...SHADED,
            primitives: {
                egg: { code: GOOD, params: [{ name: 'radius', type: 'float', default: 0.5 }] },
            },
            root: {
                id: 'root',
                type: 'union',
                children: [{ id: 'it', type: 'field', params: { primitive: 'egg', radius: 0.8 } }],
            },
        });
        await page.locator('[data-resource=egg] .resource-pick').click();
        await page.getByRole('button', { name: 'More of radius' }).click();
        await page.getByRole('button', { name: 'Add a range' }).click();
        await when((d) => d.primitives.egg.params[0].range?.[1] === 1, 'the range');
        const name = page.getByLabel('Name of radius');
        await name.fill('size of it');
        await name.press('Enter');
        await page.getByText(/is not a name for code/).waitFor();
        await page.getByLabel('Name of radius').fill('girth');
        await page.getByLabel('Name of radius').press('Enter');
        const renamed = await when((d) => d.primitives.egg.params[0].name === 'girth', 'the name');
        assert.equal(renamed.primitives.egg.code, GOOD.replaceAll('radius', 'girth'));
        assert.deepEqual(nodeIn(renamed, 'it').params, { primitive: 'egg', girth: 0.8 });
        await settled(page);
        await row(page, 'it').click();
        const before = await pixels(page);
        await dragBy(page, field(page, 'girth'), -90, 0);
        await when((d) => nodeIn(d, 'it').params.girth < 0.4, 'half of the range');
        await pictureChanged(page, before, 'the smaller egg');
    });

    test('a node can have code of its own', async () => {
        await open();
        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill('glsl');
        await page.locator('[role=option][data-type=field][aria-selected=true]').waitFor();
        await page.keyboard.press('Enter');
        await row(page, 'field-1').waitFor();
        await page.getByRole('button', { name: 'Edit code' }).click();
        await good();
        await write('float sdf(vec3 p) { return lenght(p) - 0.3; }');
        await bad('error in line 1');
        await row(page, 'field-1').locator('.tree-error').waitFor();
        await row(page, 'field-1').click();
        await page.keyboard.press('Delete');
        await page.getByTestId('broken').waitFor({ state: 'detached' });
        await panel().waitFor({ state: 'detached' });
    });
});

test('a shader of the scene: its properties are a form, colours and sliders change the picture', async () => {
    await open();
    await row(page, 'ball').click();
    await page.getByRole('button', { name: 'Write a shader' }).click();
    await when((d) => nodeIn(d, 'ball').material === 'shader-1', 'the material of the new shader');
    await good();
    await settled(page);
    const striped = await stillPixels(page);
    await page.locator('[data-resource=shader-1] .resource-pick').first().click();
    const amount = field(page, 'amount');
    await amount.fill('0');
    await amount.press('Enter');
    await when((d) => d.materials['shader-1'].properties?.amount === 0, 'the amount');
    await pictureChanged(page, striped, 'the picture without stripes');
    await page.locator('[data-param=color1] .colour-button').click();
    const hex = page.getByLabel('colour 1 Hex');
    await hex.fill('#2060ff');
    await hex.press('Enter');
    await when((d) => d.materials['shader-1'].properties?.color1?.[2] === 1, 'the colour');
    await page.keyboard.press('Escape');
    await page.locator('.resources').getByText('shader-1').last().click();
    await page.getByRole('button', { name: 'More actions' }).click();
    await page.getByText('This cannot be deleted: the shader shader-1 is used by material shader-1.').waitFor();
    assert.ok(await page.getByRole('menuitem', { name: 'Delete' }).isDisabled());
    await page.keyboard.press('Escape');
});

/** A scene with code, in a window of this width, where the server can be made to say more. */
async function openTold(width, more = {}) {
    const document = structuredClone(SHADED);
    document.primitives = { blob: { params: [], code: GOOD.replace('radius', '1.0') } };
    document.root.children = [{ id: 'blob', type: 'field', params: { primitive: 'blob' } }];
    page = await openScreen(stage, { scene: document, tampered: true }, { theme: 'dark', width, height: 800, ...more });
}

const tellTooSlow = () =>
    page.tell({ type: 'notice', level: 'error', code: 'too_slow', place: '/primitives/blob/code', measured: 4100, limit: 2000, message: 'This code took too long.' });
const notice = () => page.locator('.notice');

test('what is too slow is told as that, with its place by name', async () => {
    await openTold(1200);
    tellTooSlow();
    await page.getByTestId('broken').getByText('Show where').waitFor();
    await page.locator('.notice-place', { hasText: 'blob · code' }).waitFor();
    await page.getByTestId('broken').click();
    await panel().locator('.code-state[data-bad]', { hasText: 'too slow' }).waitFor();
    assert.equal(await panel().locator('.cm-lint-marker-error').count(), 0, 'no line is marked');
});

test('on a phone the message lies over neither grip nor tabs of the sheet with the code', async () => {
    await openTold(390, { height: 844, touch: true });
    tellTooSlow();
    await page.getByTestId('broken').click();
    await panel().waitFor();
    await keepsOff(notice(), [page.locator('.sheet-grip'), page.locator('.sheet .tabs')]);
});

test('what is too slow is tried again with more time, or undone, from its message', async () => {
    await openTold(1200);
    const retries = () => page.sent.filter(({ type }) => type === 'retry');
    tellTooSlow();
    await notice().getByRole('button', { name: 'Try again with more time' }).click();
    await until(() => retries().length === 1, 'the retry');
    assert.deepEqual(retries(), [{ type: 'retry', place: '/primitives/blob/code' }]);
    await notice().filter({ hasText: 'took too long' }).waitFor({ state: 'detached' });
    await row(page, 'blob').click();
    const x = field(page, 'translation x');
    await x.fill('0.5');
    await x.press('Enter');
    await valueIs(x, '0.5');
    tellTooSlow();
    await notice().getByRole('button', { name: 'Undo', exact: true }).click();
    await valueIs(x, '0');
    assert.equal(page.sent.filter(({ type }) => type === 'undo').length, 1);
});

for (const width of [1440, 1024]) {
    test(`messages lie over no value, ${width} pixels wide`, async () => {
        await openTold(width);
        await row(page, 'blob').click();
        tellTooSlow();
        for (const code of ['first', 'second']) {
            page.tell({ type: 'notice', level: 'error', code, message: `The ${code} of two more messages, which is long enough for a second line.` });
        }
        await notice().nth(2).waitFor();
        await keepsOff(page.locator('.notices'), [page.getByTestId('inspector')]);
    });
}

test('a server that takes no code says so', async () => {
    const strict = await openStage({ args: ['--code', 'off'] });
    try {
        const scene = await strict.scene(SHADED);
        const there = await strict.page({ scene });
        await settled(there);
        await there.getByRole('button', { name: 'Write a primitive' }).click();
        await there.getByText(/The server refused/).waitFor();
        await there.locator('[data-resource=primitive-1]').waitFor({ state: 'detached' });
        await closePage(there);
    } finally {
        await strict.close();
    }
});
