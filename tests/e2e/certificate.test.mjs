// SPDX-License-Identifier: MIT
// Whitney's umbrella from its parametric equations, by somebody new: an implicit surface whose
// equation is proved, by the page and by `fieldcast check`. Each act is counted. A document whose
// equation does not fit is drawn, and says so.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { algebraOf, SLOW_SURFACE } from '../support/algebra.mjs';
import { ask, until } from '../support/daemon.mjs';
import { closePage, documentWhen, field, nodeIn, pictureChanged, row, settled, stillPixels, useStage } from './stage.mjs';

const MOST_ACTS = 9;
const program = process.env.FIELDCAST ?? 'build/release/fieldcast';

const stage = useStage({ coarse: true });

const check = (document) => spawnSync(program, ['check', '-'], { input: JSON.stringify(document), encoding: 'utf8' });
const only = (node, type) => (node.type === type ? node : (node.children ?? []).map((one) => only(one, type)).find(Boolean));
const badge = (page) => page.locator('.surface-badge');
const told = (page, text) => badge(page).getByText(text).waitFor();

const UMBRELLA = {
    equation: 'x^2 = y^2*z',
    parametric: { x: 's*t', y: 's', z: 't^2', s: [-1, 1], t: [-1, 1] },
};
const scene = (params) => ({
    format: 'fieldcast/1',
    camera: { position: [2, 1.5, 4] },
    lights: [{ id: 'sun', type: 'directional', intensity: 3 }],
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [{ id: 'it', type: 'implicit', params }] },
});
async function open(params) {
    const id = await stage.scene(scene(params));
    const page = await stage.page({ scene: id });
    await row(page, 'it').click();
    await badge(page).waitFor();
    return { id, page };
}

test(`the umbrella takes at most ${MOST_ACTS} acts`, async () => {
    const page = await stage.page({ width: 1440, height: 900 });
    const acts = [];
    const act = async (words, what) => {
        acts.push(words);
        await what();
    };
    const dialog = page.getByRole('dialog', { name: 'Equation of a parametric surface' });
    const type = (part, text) =>
        act(`type ${part} = ${text}`, () => dialog.getByRole('textbox', { name: `${part} =` }).fill(text));

    await act('make a new scene', () => page.getByRole('button', { name: 'New scene' }).first().click());
    await page.locator('[role=treeitem]').first().waitFor();
    const id = new URL(page.url()).pathname.split('/').at(-1);
    await act('Shift+A: add something', () => page.keyboard.press('Shift+A'));
    await act('click Implicit', () => page.locator('[role=option][data-type=implicit]').first().click());
    await act('ask for a parametric surface', () => page.getByRole('button', { name: 'From a parametric surface' }).click());
    await type('x', 'u*v');
    await type('y', 'u');
    await type('z', 'v^2');
    await dialog.getByText('Degree 3, 2 terms; proved to be exact.').waitFor();
    await dialog.getByRole('spinbutton', { name: 'u from' }).waitFor();
    await act('use the equation', () => dialog.getByRole('button', { name: 'Use this equation' }).click());
    await told(page, 'Verified: degree 3, 2 terms');

    const made = await documentWhen(stage, id, (d) => only(d.root, 'implicit')?.params?.parametric, 'a certificate');
    assert.deepEqual(only(made.root, 'implicit').params, {
        equation: 'y^2*z-x^2 = 0',
        parametric: { x: 'u*v', y: 'u', z: 'v^2', u: [-1, 1], v: [-1, 1] },
    });
    console.log(acts.map((words, i) => `# ${i + 1}. ${words}`).join('\n'));
    assert.ok(acts.length <= MOST_ACTS, `${acts.length} acts`);
    const { status, stdout } = check(await ask(stage.daemon, 'GET', `/v1/scenes/${id}`));
    assert.match(stdout, /^-: \/nodes\/implicit-1\/params\/parametric: verified: degree 3, 2 terms; the patch covers \d+ % of the implicit surface within the clip$/m);
    assert.equal(status, 0);

    await page.keyboard.press('Control+z');
    await documentWhen(stage, id, (d) => !only(d.root, 'implicit').params.parametric, 'one step back');
    const back = await ask(stage.daemon, 'GET', `/v1/scenes/${id}`);
    assert.notEqual(only(back.root, 'implicit').params.equation, 'y^2*z-x^2 = 0', 'the same step takes the equation back');
    await closePage(page);
});

test('an equation that is changed by hand does not fit, and fits again', async () => {
    const { id, page } = await open(UMBRELLA);
    await told(page, 'Verified');
    const equation = page.getByRole('textbox', { name: 'equation', exact: true });
    await equation.fill('x^2 = y^2*z + 0.1');
    await equation.press('Enter');
    await told(page, 'Not verified: at the point (2, 1, 4) of the surface the equation is off by -0.1');
    const document = await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.equation.endsWith('0.1'), 'the new equation');
    assert.deepEqual(nodeIn(document, 'it').params.parametric, UMBRELLA.parametric);
    await page.keyboard.press('Control+z');
    await told(page, 'Verified');
    await closePage(page);
});

test('the method is chosen among those of the schema', async () => {
    const { page } = await open(UMBRELLA);
    const asked = [];
    page.on('request', (request) => request.method() === 'POST' && request.url().includes('/implicitize') && asked.push(request.postDataJSON().method));
    await page.getByRole('button', { name: 'Change …' }).click();
    const dialog = page.getByRole('dialog', { name: 'Equation of a parametric surface' });
    const found = () => dialog.getByText('Degree 3, 2 terms; proved to be exact.').waitFor();
    await found();
    const schema = await ask(stage.daemon, 'GET', '/v1/schema.json');
    const { choices } = schema['x-fieldcast'].implicitize[0];
    assert.deepEqual(choices, ['nullspace', 'resultant', 'groebner', 'saturation']);
    const method = dialog.getByRole('combobox', { name: 'Method' });
    for (const choice of choices.slice(1)) {
        await method.click();
        await page.getByRole('option', { name: choice }).click();
        await dialog.getByText('Looking for the equation …').waitFor();
        await found();
    }
    assert.deepEqual(asked, [undefined, ...choices.slice(1)]);
    await closePage(page);
});

test('a letter of the equation is a number of the node', async () => {
    const { page } = await open({ ...UMBRELLA, equation: 'a*x^2 = y^2*z' });
    await told(page, 'Verified');
    await field(page, 'a').fill('2');
    await page.keyboard.press('Enter');
    await told(page, 'Not verified: at the point (2, 1, 4)');
    await closePage(page);
});

test('a document with a false certificate is drawn and marked', async () => {
    const empty = await stage.scene({ ...scene({}), root: { id: 'root', type: 'union' } });
    const other = await stage.page({ scene: empty });
    await settled(other);
    const nothing = await stillPixels(other);
    await closePage(other);

    const tampered = { ...UMBRELLA, parametric: { ...UMBRELLA.parametric, z: 't^2+1' } };
    const { id, page } = await open(tampered);
    await told(page, 'Not verified: at the point (2, 1, 5) of the surface the equation is off by -1');
    await pictureChanged(page, nothing, 'the surface');
    const { status, stdout } = check(await ask(stage.daemon, 'GET', `/v1/scenes/${id}`));
    assert.match(stdout, /\/nodes\/it\/params\/parametric: does not fit: at the point/);
    assert.equal(status, 1);
    await closePage(page);
});

test('a certificate can be changed in the same dialog, and taken away', async () => {
    const { id, page } = await open(UMBRELLA);
    await page.getByRole('button', { name: 'Change …' }).click();
    const dialog = page.getByRole('dialog', { name: 'Equation of a parametric surface' });
    assert.equal(await dialog.getByRole('textbox', { name: 'x =' }).inputValue(), 's*t');
    await dialog.getByRole('textbox', { name: 'x =' }).fill('s*cos(t)');
    await dialog.getByRole('textbox', { name: 'y =' }).fill('s*sin(t)');
    await dialog.getByRole('textbox', { name: 'z =' }).fill('s');
    await dialog.getByText('Degree 2, 3 terms').waitFor();
    const end = dialog.getByRole('spinbutton', { name: 's to' });
    await end.fill('-3');
    await end.press('Enter');
    await dialog.getByText('s has to end above its start.').waitFor();
    assert.equal(await dialog.getByRole('button', { name: 'Use this equation' }).isDisabled(), true);
    await end.fill('2');
    await end.press('Enter');
    await dialog.getByRole('button', { name: 'Use this equation' }).click();
    await told(page, 'Verified: degree 2, 3 terms');
    const document = await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.parametric.z === 's', 'the cone');
    assert.deepEqual(nodeIn(document, 'it').params.parametric.s, [-1, 2]);
    await page.getByRole('button', { name: /^Reset parametric surface/i }).click();
    await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.parametric === undefined, 'none');
    await badge(page).waitFor({ state: 'detached' });
    await closePage(page);
});

const HALF = {
    equation: 'x^2+y^2+z^2 = 1',
    parametric: { x: 'cos(u)*cos(v)', y: 'sin(u)*cos(v)', z: 'sin(v)', u: [0, 6.283185], v: [0, 1.570796] },
    thickness: 0.02,
};

test('the badge tells how much the patch covers, and one edit keeps only the patch', async () => {
    const { id, page } = await open(HALF);
    await told(page, /The patch covers (49|50|51)\u00a0% of the implicit surface within the clip\./);
    await page.getByRole('button', { name: 'Keep only the patch' }).click();
    const document = await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.mode === 'sheet', 'the patch alone');
    const [cut] = document.root.children;
    assert.equal(cut.type, 'intersection');
    const [sheet, patch] = cut.children;
    assert.deepEqual([sheet.id, sheet.params], ['it', { ...HALF, mode: 'sheet' }]);
    assert.deepEqual([patch.type, patch.params], ['parametric', { surface: HALF.parametric, thickness: 0.04 }]);
    await page.getByRole('button', { name: 'Keep only the patch' }).waitFor({ state: 'detached' });
    await page.keyboard.press('Control+z');
    const back = await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.mode !== 'sheet', 'one step back');
    assert.deepEqual(back.root.children.map((node) => node.id), ['it']);
    await page.getByRole('button', { name: 'Keep only the patch' }).waitFor();
    await closePage(page);
});

test('a root becomes what cuts it, in one edit', async () => {
    const id = await stage.scene({ ...scene({}), root: { id: 'it', type: 'implicit', params: HALF } });
    const page = await stage.page({ scene: id });
    await row(page, 'it').click();
    await page.getByRole('button', { name: 'Keep only the patch' }).click();
    const { root } = await documentWhen(stage, id, (d) => d.root.type === 'intersection', 'the patch alone');
    const [sheet, patch] = root.children;
    assert.deepEqual([root.id, sheet.type, sheet.params], ['it', 'implicit', { ...HALF, mode: 'sheet' }]);
    assert.deepEqual([patch.type, patch.params], ['parametric', { surface: HALF.parametric, thickness: 0.04 }]);
    await page.keyboard.press('Control+z');
    const back = await documentWhen(stage, id, (d) => d.root.type === 'implicit', 'one step back');
    assert.deepEqual([back.root.params, back.root.children], [HALF, undefined]);
    await closePage(page);
});

test('the dialog tells of the clip that the badge tells of', async () => {
    const { page } = await open(UMBRELLA);
    await told(page, /The patch covers/);
    const [covers] = /The patch covers \d+\u00a0% /.exec(await page.locator('.surface-badge').innerText());
    await page.getByRole('button', { name: 'Change …' }).click();
    await page.getByRole('dialog').getByText(covers).waitFor();
    await closePage(page);
});

test('a search tells its steps, and is cancelled', async () => {
    const { page } = await open(UMBRELLA);
    await told(page, 'Verified');
    await page.getByRole('button', { name: 'Change …' }).click();
    const dialog = page.getByRole('dialog', { name: 'Equation of a parametric surface' });
    await dialog.getByText('The patch covers').waitFor();
    for (const [part, text] of Object.entries(SLOW_SURFACE)) {
        await dialog.getByRole('textbox', { name: `${part} =` }).fill(text);
    }
    await dialog.getByText(/Looking for the equation … prime \d+: \d+ bits \(\d+\.\d s\)/).waitFor();
    assert.equal(algebraOf(stage.daemon).length, 1);
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    await dialog.getByText('Cancelled.').waitFor();
    await until(() => algebraOf(stage.daemon).length === 0, 'the end of the process');
    await dialog.getByRole('textbox', { name: 'x =' }).fill('s*t');
    await dialog.getByRole('textbox', { name: 'y =' }).fill('s');
    await dialog.getByRole('textbox', { name: 'z =' }).fill('t^2');
    await dialog.getByText('Degree 3, 2 terms; proved to be exact.').waitFor();
    await closePage(page);
});
