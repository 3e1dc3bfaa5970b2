// SPDX-License-Identifier: MIT
// The badge of an equation in the inspector: it follows the equation and its numbers, explains itself,
// and typing does not wait for it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ask } from '../support/daemon.mjs';
import { closePage, documentWhen, field, nodeIn, row, useStage } from './stage.mjs';

const stage = useStage({ coarse: true });

const badge = (page) => page.locator('.quality-badge');
const says = (page, text) => badge(page).and(page.locator(':not([data-old])')).getByText(text).waitFor();
const text = (page) => page.getByRole('textbox', { name: 'equation', exact: true });

async function open(params) {
    const children = [{ id: 'it', type: 'implicit', params }, { id: 'ball', type: 'sphere' }];
    const id = await stage.scene({
        format: 'fieldcast/1',
        lights: [{ id: 'sun', type: 'directional', intensity: 3 }],
        root: { id: 'root', type: 'union', children },
    });
    const page = await stage.page({ scene: id });
    await row(page, 'it').click();
    return { id, page };
}

async function change(page, equation) {
    await text(page).fill(equation);
    await text(page).press('Enter');
}

test('the badge follows the equation', async () => {
    const { page } = await open({ equation: 'x^2 + y^2 + z^2 = 1' });
    await says(page, /^Exact polynomial of degree 2$/);
    await change(page, 'sin(3*x)*cos(2*y) = z');
    await says(page, /^Safe$/);
    await change(page, '(sin(3*x) - y)^2 = 0');
    await says(page, /^Safe, \d\d\u00a0% unresolved$/);
    assert.equal(await badge(page).getAttribute('data-quality'), 'unresolved');
    page.expected = /compile/;
    await text(page).fill('x +');
    await badge(page).waitFor({ state: 'detached' });
    await change(page, 'x^3 = y');
    await says(page, /^Exact polynomial of degree 3$/);
    await page.keyboard.press('Escape');
    await row(page, 'ball').click();
    await badge(page).waitFor({ state: 'detached' });
    await closePage(page);
});

test('a pole has its place, which follows a letter', async () => {
    const { id, page } = await open({ equation: 'y = 1/(x - a)', a: 0.5, mode: 'sheet' });
    await says(page, /^Unsafe: pole at \(0\.5, /);
    assert.equal(await badge(page).getAttribute('data-quality'), 'unsafe');
    await badge(page).hover();
    await page.locator('.tip').getByText('A wall is drawn there that is no part of the surface').waitFor();
    await field(page, 'a').fill('1.6');
    await page.keyboard.press('Enter');
    await says(page, /^Safe/);
    const edit = [{ op: 'set', at: '/nodes/it/params/a', value: -0.25 }];
    await ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, edit);
    await says(page, /^Unsafe: pole at \(−0\.25, /);
    await closePage(page);
});

test('typing does not wait for an answer', async () => {
    const { id, page } = await open({ equation: 'x = 1' });
    await says(page, /^Exact polynomial of degree 1$/);
    let held = [];
    await page.route('**/equations?node=it', (route) => held.push(route));
    await text(page).click();
    await page.keyboard.press('End');
    await page.keyboard.type(' + y^2', { delay: 20 });
    await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.equation === 'x = 1 + y^2', 'what was typed');
    await page.locator('.quality-badge[data-old]').waitFor();
    assert.equal(await text(page).inputValue(), 'x = 1 + y^2');
    await page.unroute('**/equations?node=it');
    for (const route of held) {
        await route.continue().catch(() => {});
    }
    held = [];
    await page.keyboard.type(' + z^3');
    await says(page, /^Exact polynomial of degree 3$/);
    await closePage(page);
});
