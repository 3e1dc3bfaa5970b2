// SPDX-License-Identifier: MIT
// The workbench: an ideal in, its basis step by step, elimination, division, errors under their letter.
import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, test } from 'node:test';
import { algebraOf } from '../support/algebra.mjs';
import { until } from '../support/daemon.mjs';
import { closePage, openStage } from './stage.mjs';

let stage;
let page;
before(async () => {
    stage = await openStage({ driver: 'null' });
});
after(() => stage.close());
beforeEach(async () => {
    page = await stage.page({ scene: await stage.scene(), width: 1440, height: 900 });
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('buchberger');
    await page.locator('[role=option][aria-selected=true]').getByText('Groebner bases').waitFor();
    await page.keyboard.press('Enter');
    await workbench().waitFor();
});
afterEach(() => closePage(page));

const workbench = () => page.getByRole('dialog', { name: 'Groebner bases' });
const part = (name) => workbench().getByRole('region', { name });
const polynomials = () => workbench().getByRole('textbox', { name: 'Polynomials' });
const make = () => workbench().getByRole('button', { name: 'Make the basis' }).click();
const state = (name) => workbench().locator(`[role=status][data-state=${name}]`).waitFor();

async function choose(example) {
    await workbench().getByRole('combobox', { name: 'Examples' }).click();
    await page.getByRole('option', { name: example }).click();
}

const texts = async (region) =>
    (await part(region).getByRole('listitem').allTextContents()).map((text) => text.replaceAll('\u2009', ' '));

test('parameters are eliminated from a surface; each pair is a step', async () => {
    await make();
    await state('done');
    assert.deepEqual(await texts('Elimination ideal'), ['y2 z - x2']);
    await part('Elimination ideal').getByText('the ideal is principal').waitFor();
    const counts = (await part('Steps').getByRole('listitem').allTextContents()).map((text) => Number.parseInt(text, 10));
    const rows = await part('Steps').getByRole('row').count();
    assert.equal(rows - 1, counts.reduce((a, b) => a + b, 0));
});

test('the order decides what the basis is; a division has quotients and a rest', async () => {
    await choose(/Twisted cubic/);
    await make();
    await state('done');
    assert.deepEqual(await texts('Reduced basis'), ['y2 - x z', 'x y - z', 'x2 - y']);
    assert.equal(await workbench().locator('.workbench-rest').textContent(), 'x');
    await workbench().getByRole('radiogroup', { name: 'order' }).getByRole('radio', { name: 'lex', exact: true }).click();
    await make();
    await workbench().getByText('y3 - z2').waitFor();
});

test('what is wrong stands under its letter, and is mended', async () => {
    await polynomials().fill('x^2 - y\ny*(x');
    await make();
    await state('failed');
    await workbench().getByText(/^expected "\)"/).waitFor();
    await workbench().locator('.equation-mark').waitFor();
    await workbench().getByText('Choose an example').waitFor();
    await polynomials().fill('x^2 - y\ny*(x)');
    await make();
    await state('done');
    assert.equal(await workbench().locator('.equation-mark').count(), 0);
});

test('one that takes long is watched, and cancelled with its process; closing cancels too', async () => {
    const seven = [...'abcdfgh'];
    const cyclic = seven.map((_, n) =>
        n < 6
            ? seven.map((_, i) => Array.from({ length: n + 1 }, (_, k) => seven[(i + k) % 7]).join('*')).join('+')
            : `${seven.join('*')}-1`,
    );
    await polynomials().fill(cyclic.join('\n'));
    await make();
    await state('running');
    await part('Steps').getByRole('row').nth(5).waitFor();
    await workbench().getByText(/\d+ pairs left/).waitFor();
    await workbench().getByRole('button', { name: 'Cancel' }).click();
    await state('cancelled');
    await until(() => algebraOf(stage.daemon).length === 0, 'the end of the process');
    await make();
    await until(() => algebraOf(stage.daemon).length === 1, 'another process');
    await page.keyboard.press('Escape');
    await until(() => algebraOf(stage.daemon).length === 0, 'the end of that process');
});
