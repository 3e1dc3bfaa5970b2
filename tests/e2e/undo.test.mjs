// SPDX-License-Identifier: MIT
// Undo over reloads of the page, and beside somebody else.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import {
    closePage,
    documentWhen,
    field,
    nodeIn,
    row,
    useStage,
    valueIs,
    waitForSaved,
} from './stage.mjs';

const stage = useStage({ driver: 'null', coarse: true });

const radiusOf = (document) => nodeIn(document, 'ball').params.radius;

async function setRadius(page, value) {
    await row(page, 'ball').click();
    await field(page, 'radius').fill(value);
    await field(page, 'radius').press('Enter');
    await waitForSaved(page);
    await row(page, 'ball').click();
}

test('what was done before a reload can be undone by its name', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id });
    await setRadius(page, '0.4');
    const undo = page.getByRole('button', { name: /^Undo/ });
    await page.getByRole('button', { name: /^Undo .*radius/ }).waitFor();
    await page.reload();
    await row(page, 'ball').click();
    await page.getByRole('button', { name: /^Undo .*radius/ }).waitFor();
    await undo.click();
    await documentWhen(stage, id, (d) => radiusOf(d) === 1, 'the old radius');
    await page.getByRole('button', { name: /^Redo/ }).click();
    await documentWhen(stage, id, (d) => radiusOf(d) === 0.4, 'the newer radius');
    await closePage(page);
});

test('tabs of one browser are different authors', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id });
    await setRadius(page, '0.4');
    const tab = await page.context().newPage();
    await tab.goto(page.url());
    await row(tab, 'ball').click();
    await valueIs(field(tab, 'radius'), '0.4');
    assert.ok(await tab.getByRole('button', { name: /^Undo/ }).isDisabled());
    await page.getByRole('button', { name: /^Undo/ }).click();
    await documentWhen(stage, id, (d) => radiusOf(d) === 1, 'the old radius');
    await closePage(page);
});

test('a newer value of somebody else stays until the author insists', async () => {
    const id = await stage.scene();
    const [one, other] = [await stage.page({ scene: id }), await stage.page({ scene: id })];
    await setRadius(one, '0.4');
    await setRadius(other, '0.7');
    await valueIs(field(one, 'radius'), '0.7');
    await one.getByRole('button', { name: /^Undo/ }).click();
    const notice = one.locator('.notice[data-code=overwritten]');
    await notice.waitFor();
    assert.equal(radiusOf(JSON.parse(await stage.document(id))), 0.7);
    await notice.getByRole('button', { name: 'Undo anyway' }).click();
    await documentWhen(stage, id, (d) => radiusOf(d) === 1, 'the old radius');
    await notice.waitFor({ state: 'detached' });
    await closePage(one);
    await closePage(other);
});

test('what somebody else deletes while its values are looked at is told by its name', async () => {
    const id = await stage.scene();
    const [one, other] = [await stage.page({ scene: id }), await stage.page({ scene: id })];
    await row(one, 'ball').click();
    await field(one, 'radius').waitFor();
    await row(other, 'crate').click();
    await row(other, 'ball').click();
    await other.keyboard.press('Delete');
    await one.locator('.notice[data-code=lost]', { hasText: 'Ball deleted by somebody else.' }).waitFor();
    assert.equal(await other.locator('.notice[data-code=lost]').count(), 0, 'the author knows');
    await other.getByRole('button', { name: /^Undo/ }).first().click();
    await field(one, 'radius').waitFor();
    await closePage(one);
    await closePage(other);
});

test('an addition taken back selects what was selected before it', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id });
    const chosen = () => page.locator('[data-node][aria-selected=true]').evaluateAll((list) => list.map((one) => one.dataset.node).join());
    await row(page, 'ring').click();
    await page.keyboard.press('Shift+A');
    await page.getByRole('combobox').fill('cone');
    await page.keyboard.press('Enter');
    await until(async () => (await chosen()) === 'cone-1', 'the new cone selected');
    await page.keyboard.press('Control+z');
    await until(async () => (await chosen()) === 'ring', 'the ring selected again');
    await page.keyboard.press('Control+y');
    await until(async () => (await chosen()) === 'cone-1', 'the cone back and selected');
    await page.keyboard.press('Control+z');
    await until(async () => (await chosen()) === 'ring', 'the ring once more');
    await closePage(page);
});
