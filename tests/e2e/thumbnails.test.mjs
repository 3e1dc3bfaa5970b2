// SPDX-License-Identifier: MIT
// Thumbnails as a user sees them: a row of the tree has the picture of its node, also after an edit.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ask, until } from '../support/daemon.mjs';
import { row, useStage } from './stage.mjs';

const stage = useStage({ driver: 'null', coarse: true });

/** The mean colour of what the picture shows, red to blue; null: there is no picture yet. */
const tint = (thumbnail) =>
    thumbnail.evaluate(async (slot) => {
        const picture = slot.querySelector('img');
        if (!picture) {
            return null;
        }
        try {
            await picture.decode();
        } catch {
            return null; // another is on its way
        }
        const canvas = new OffscreenCanvas(picture.naturalWidth, picture.naturalHeight);
        const context = canvas.getContext('2d');
        context.drawImage(picture, 0, 0);
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        let [red, blue] = [0, 0];
        for (let i = 0; i < data.length; i += 4) {
            red += data[i] * data[i + 3];
            blue += data[i + 2] * data[i + 3];
        }
        return red / blue;
    });

test('rows, materials and the inspector show what a part looks like now', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id });
    const ball = row(page, 'ball').locator('.thumbnail');
    const pole = row(page, 'pole').locator('.thumbnail');
    const clay = page.locator('[data-resource="clay"] .thumbnail');
    await until(async () => (await tint(ball)) > 1.5, 'a red ball in its row');
    await until(async () => (await tint(clay)) > 1.5, 'a red ball for its material');
    await until(async () => Math.abs((await tint(pole)) - 1) < 0.2, 'a grey pole in its row');
    const source = () => pole.locator('img').getAttribute('src');
    const before = await source();
    const size = await ball.boundingBox();
    await row(page, 'ball').click();
    const head = page.getByTestId('inspector').locator('.inspector-thumbnail');
    await until(async () => (await tint(head)) > 1.5, 'a red ball in the inspector');
    await ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, [
        { op: 'set', at: '/materials/clay/properties/diffuse', value: [0.1, 0.1, 0.8] },
    ]);
    for (const slot of [ball, clay, head]) {
        await until(async () => (await tint(slot)) < 0.7, 'a blue ball');
    }
    assert.equal(await source(), before, 'the pole is as it was');
    assert.deepEqual(await ball.boundingBox(), size, 'the slot has kept its size');
    await page.keyboard.press('Control+k');
    await page.keyboard.type('thumbnails in the tree');
    await page.keyboard.press('Enter');
    await ball.waitFor({ state: 'detached' });
    await clay.waitFor();
});
