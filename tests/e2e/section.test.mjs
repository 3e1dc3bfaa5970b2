// SPDX-License-Identifier: MIT
// A plane cuts the pictures of one page: as REST draws them, no edit, and clicks find what is seen.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';
import { difference, drawnPixels, picture, pictureChanged, pixels, pixelsLike, row, settled, useStage } from './stage.mjs';

/* A ball inside of a ball, seen along z. */
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: [0, 0, 8], target: [0, 0, 0], fov: 40 },
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        children: [
            {
                id: 'shell',
                type: 'difference',
                children: [
                    { id: 'egg', type: 'sphere', params: { radius: 1.5 } },
                    { id: 'hollow', type: 'sphere', params: { radius: 1.3 } },
                ],
            },
            { id: 'kernel', type: 'box', params: { size: [0.8, 0.8, 0.8] } },
        ],
    },
};

const stage = useStage();

test('a plane cuts what one page shows, and is no edit', async () => {
    const id = await stage.scene(DOCUMENT);
    const [page, other] = [await stage.page({ scene: id }), await stage.page({ scene: id })];
    const before = await stage.document(id);
    await Promise.all([settled(page), settled(other)]);
    const [all, seen] = [await drawnPixels(page, stage, id), await drawnPixels(other, stage, id)];
    const pill = page.getByTestId('section');
    const box = await picture(page).boundingBox();
    /* What REST draws, as large as the view. */
    const { width, height } = all;
    const drawn = async (section) => {
        const answer = await fetch(`${stage.daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify({ scene: id, width, height, section }),
        });
        return decodePng(Buffer.from(await answer.arrayBuffer()));
    };
    const shows = async (section) => pixelsLike(page, await drawn(section), 1, JSON.stringify(section));

    assert.equal(await pill.count(), 0);
    await picture(page).focus();
    await page.keyboard.press('k');
    await pill.waitFor();
    await pictureChanged(page, all, 'the cut');
    await shows({ normal: [0, 0, 1], offset: 0 });
    assert.equal(await pill.getByRole('button', { name: 'Plane across Z' }).getAttribute('aria-pressed'), 'true');

    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await row(page, 'kernel').and(page.locator('[aria-selected=true]')).waitFor();

    if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT });
    const slider = pill.getByRole('slider', { name: 'Place of the plane' });
    await slider.fill('-0.75');
    assert.equal(await pill.locator('output').innerText(), '-0.75');
    await shows({ normal: [0, 0, 1], offset: -0.75 });
    await pill.getByRole('button', { name: 'Other side' }).click();
    await shows({ normal: [0, 0, -1], offset: 0.75 });
    await pill.getByRole('button', { name: 'Plane across X' }).click();
    await shows({ normal: [-1, 0, 0], offset: 0 });

    assert.equal(await stage.document(id), before);
    assert.equal(difference(await pixels(other), seen), 0, 'the other page shows all');
    await pill.getByRole('button', { name: 'Show all' }).click();
    await pill.waitFor({ state: 'detached' });
    await pixelsLike(page, all, 1, 'all of it again');
    await page.getByRole('button', { name: 'Section' }).click();
    await pill.waitFor();
    await page.keyboard.press('Escape');
    await pill.waitFor({ state: 'detached' });
    await until(async () => (await page.getByRole('button', { name: 'Section' }).getAttribute('aria-pressed')) === 'false', 'the button');
});
