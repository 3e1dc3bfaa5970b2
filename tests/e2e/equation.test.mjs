// SPDX-License-Identifier: MIT
// Equations: the picture and what is typeset follow each text that can be read, the last good ones stay
// otherwise, and marks stand under the letters that are wrong.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import {
    difference,
    documentWhen,
    field,
    nodeIn,
    pictureChanged,
    settled,
    stillPixels,
    useStage,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

const EMPTY = {
    format: 'fieldcast/1',
    camera: { position: [0, 1, 4] },
    lights: [{ id: 'sun', type: 'directional', intensity: 3 }],
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [{ id: 'it', type: 'implicit' }] },
};

const text = () => page.getByRole('textbox', { name: 'equation' });
const equationIs = (wanted) =>
    documentWhen(stage, id, (d) => nodeIn(d, 'it').params?.equation === wanted, wanted);

async function open() {
    id = await stage.scene(EMPTY);
    page = await stage.page({ scene: id });
    await settled(page);
    await page.locator('[data-node="it"]').click();
    await text().waitFor();
}

test('is typed letter by letter; what cannot be read is marked and leaves the picture', async () => {
    await open();
    const nothing = await stillPixels(page);
    await text().click();
    await page.keyboard.type('x^2 + y^2 + z^2 = 1', { delay: 20 });
    await equationIs('x^2 + y^2 + z^2 = 1');
    await pictureChanged(page, nothing, 'the ball');
    await settled(page);
    const ball = await stillPixels(page);

    page.expected = /compile/;
    await page.keyboard.type(' + j');
    const mark = page.locator('.equation-mark mark');
    await mark.waitFor();
    assert.equal(await mark.textContent(), 'j');
    await page.getByText('"j" is no name').first().waitFor();
    assert.ok(difference(await stillPixels(page), ball) <= 1, 'the last good picture stays');

    await page.keyboard.press('Backspace');
    await page.keyboard.type('x');
    await mark.waitFor({ state: 'detached' });
    await page.keyboard.press('Enter');
    await equationIs('x^2 + y^2 + z^2 = 1 + x');
    await pictureChanged(page, ball, 'the moved ball');
});

test('is typeset while it is typed; the last that can be read stays dimmed, and each fault is marked', async () => {
    await open();
    const set = page.getByRole('group', { name: 'typeset' });
    /* Without what is invisible. */
    const lines = async () => (await set.locator('math').allTextContents()).map((line) => line.replace(/[\u2061\u2062]/g, ''));
    const shows = (...wanted) => until(async () => String(await lines()) === String(wanted), `${wanted} typeset`);
    const marked = () => page.locator('.equation-mark mark').allTextContents();

    assert.equal(await set.count(), 0, 'nothing is typeset before something is typed');
    await text().click();
    await page.keyboard.type('x^2', { delay: 20 });
    await shows('x2=0');
    await page.keyboard.type('/4 + sin(z) < a', { delay: 20 });
    await shows('x24+sinz<a');
    assert.equal(await set.locator('mfrac msup').count(), 1, 'a power in a fraction');
    assert.equal(await set.getAttribute('data-old'), null);

    page.expected = /compile/;
    await page.keyboard.type(' + j*sine(z) + max(z)', { delay: 20 });
    await until(async () => String(await marked()) === 'j,sine,max', 'three marks');
    const faults = page.locator('.equation-faults li');
    assert.equal(await faults.count(), 3);
    assert.equal(await faults.nth(1).textContent(), '"sine" is no function; did you mean "sin"?');
    assert.deepEqual(await lines(), ['x24+sinz<a'], 'the last that could be read stays');
    assert.equal(await set.getAttribute('data-old'), 'true');

    await text().fill('r := x^2; (r + y^2 + z^2 - 1)^3 = r*z^3');
    await shows('r≔x2', '(r+y2+z2−1)3=rz3');
    await set.and(page.locator(':not([data-old])')).waitFor();
    assert.equal(await faults.count(), 0);

    await text().fill(Array.from({ length: 200 }, (_, i) => `${i}*x^2*y`).join(' + '));
    await until(async () => (await lines()).at(-1)?.endsWith('+⋯=0'), 'an ellipsis');
    const [inner, outer] = await Promise.all([set.boundingBox(), text().boundingBox()]);
    assert.ok(inner.width <= outer.width + 1 && inner.height < 220, 'a long one scrolls');
    await page.keyboard.press('Escape');
    await set.waitFor({ state: 'detached' });
});

test('a letter is a number, and the picture follows it', async () => {
    await open();
    const nothing = await stillPixels(page);
    await text().fill('x^2 + y^2 + z^2 = r^2');
    await page.keyboard.press('Enter');
    await pictureChanged(page, nothing, 'the ball');
    await settled(page);
    const ball = await stillPixels(page);
    assert.equal(await field(page, 'b').count(), 0, 'a letter that the equation lacks is not offered');
    await field(page, 'r').fill('0.4');
    await page.keyboard.press('Enter');
    await pictureChanged(page, ball, 'the smaller ball');
});

test('is found for a parametric surface, which is proved, and drawn as one edit', async () => {
    await open();
    page.expected = /status of 422/;
    const nothing = await stillPixels(page);
    await page.getByRole('button', { name: 'From a parametric surface' }).click();
    const dialog = page.getByRole('dialog', { name: 'Equation of a parametric surface' });
    const take = dialog.getByRole('button', { name: 'Use this equation' });
    await dialog.getByText('Degree 3, 2 terms; proved to be exact.').waitFor();
    await dialog.getByRole('textbox', { name: 'x =' }).fill('s*cos(t)');
    await dialog.getByRole('textbox', { name: 'y =' }).fill('s*sin(t)');
    await dialog.getByRole('textbox', { name: 'z =' }).fill('t');
    await dialog.getByText('z: t stands inside and outside of sin, cos or tan: this surface is not algebraic').waitFor();
    assert.equal(await take.isDisabled(), true);
    await dialog.getByRole('textbox', { name: 'z =' }).fill('s +* 1');
    await dialog.locator('mark').getByText('*', { exact: true }).waitFor();
    await dialog.getByRole('textbox', { name: 'z =' }).fill('s^2 - 1');
    await dialog.getByText('Degree 2, 4 terms; proved to be exact.').waitFor();
    await take.click();
    await equationIs('x^2+y^2-z-1 = 0');
    await pictureChanged(page, nothing, 'the paraboloid');
    await page.keyboard.press('Control+z');
    await documentWhen(stage, id, (d) => nodeIn(d, 'it').params?.equation !== 'x^2+y^2-z-1 = 0', 'undo');
});

test('of colours of a material follows what is typed, and says where it is wrong', async () => {
    const materials = { tint: { shader: 'map', properties: { lines: 0 } } };
    const root = { id: 'it', type: 'sphere', material: 'tint' };
    id = await stage.scene({ ...EMPTY, materials, root });
    page = await stage.page({ scene: id });
    await settled(page);
    await page.locator('[data-resource=tint] .resource-pick').click();
    const byHeight = await stillPixels(page);
    const typed = page.getByRole('textbox', { name: 'function' });
    const functionIs = (wanted) => documentWhen(stage, id, (d) => d.materials.tint.properties.function === wanted, wanted);

    await typed.click();
    await page.keyboard.type('a*x', { delay: 20 });
    await functionIs('a*x');
    await pictureChanged(page, byHeight, 'colours from left to right');
    await settled(page);
    const byWidth = await stillPixels(page);

    page.expected = /compile/;
    await page.keyboard.type(' + j');
    await page.locator('.equation-mark mark').getByText('j', { exact: true }).waitFor();
    assert.ok(difference(await stillPixels(page), byWidth) <= 1, 'the last good picture stays');
    await typed.fill('a*x');
    await page.keyboard.press('Enter');
    await page.locator('.equation-mark mark').waitFor({ state: 'detached' });
    await field(page, 'a').fill('-1');
    await page.keyboard.press('Enter');
    await pictureChanged(page, byWidth, 'colours from right to left');
});
