// SPDX-License-Identifier: MIT
// Materials that one can try: the gallery, a look without an edit, balls that are dragged.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';
import { documentWhen, nodeIn, picture, row, settled, useStage } from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(options) {
    id = await stage.scene();
    page = await stage.page({ scene: id, height: 1000, ...options });
    await settled(page);
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const preset = (name) => page.locator(`[data-preset="${name}"]`);
const materialOf = (document, node) => nodeIn(document, node).material;

/** Opens the gallery for what is selected. */
async function openGallery(node) {
    await row(page, node).click();
    await page.locator('[data-param="material"]').getByRole('button', { name: 'New material' }).click();
    await page.getByTestId('gallery').waitFor();
}

describe('the gallery', () => {
    test('has 31 balls, drawn by the server, each in a colour of its own', async () => {
        await open();
        await page.getByRole('button', { name: 'Add a material' }).click();
        const tiles = page.locator('.gallery-tile');
        await until(async () => (await page.locator('.gallery-ball img').count()) === 31, 'all balls');
        assert.equal(await tiles.count(), 31);
        const looks = new Set();
        for (const [i, name] of ['clay', 'gold', 'cobalt', 'walnut'].entries()) {
            const ball = preset(name).locator('img');
            await ball.scrollIntoViewIfNeeded();
            await until(() => ball.evaluate((one) => one.naturalWidth === 128), `the ball ${name}`);
            const { pixels, width, channels } = decodePng(await ball.screenshot());
            const middle = (Math.floor(width / 2) * width + Math.floor(width / 2)) * channels;
            looks.add(`${[...pixels.subarray(middle, middle + 3)]}`);
            assert.equal(looks.size, i + 1);
        }
    });

    test('is searched and taken by keys; what is not taken leaves nothing', async () => {
        await open();
        const start = await stage.document(id);
        await openGallery('ball');
        await page.keyboard.type('copper');
        await page.locator('[data-testid="trial"][data-shown="copper"]').waitFor();
        assert.equal(await stage.document(id), start, 'a look is no edit');
        await page.keyboard.press('Escape');
        await page.getByTestId('gallery').waitFor({ state: 'detached' });
        await page.getByTestId('trial').waitFor({ state: 'detached' });
        assert.equal(await stage.document(id), start);
        await openGallery('ball');
        await page.keyboard.type('copper');
        await page.keyboard.press('Enter');
        const taken = await when((d) => materialOf(d, 'ball') === 'copper', 'a copper ball');
        assert.equal(taken.materials.copper.properties.metallic, 1);
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'one step takes it back');
    });

    test('shows on the object what the pointer is over', async () => {
        await open();
        await openGallery('ball');
        const look = async (name) => {
            await preset(name).scrollIntoViewIfNeeded();
            await preset(name).hover();
            const image = page.locator(`[data-testid="trial"][data-shown="${name}"] img`);
            await image.waitFor();
            await until(() => image.evaluate((one) => one.complete && one.naturalWidth > 0), `a look at ${name}`);
            return decodePng(await image.screenshot());
        };
        const red = await look('plastic');
        const blue = await look('cobalt');
        const box = await picture(page).boundingBox();
        const at = (image, x, y) => {
            const i = (Math.round(image.height * y) * image.width + Math.round(image.width * x)) * image.channels;
            return [...image.pixels.subarray(i, i + 3)];
        };
        /* The ball stands left of the middle: 1.5 units at 7 units in a view of 45 degrees. */
        const x = 0.5 - (1.5 / 7.16 / (2 * Math.tan(Math.PI / 8))) * (box.height / box.width);
        const [r1, , b1] = at(red, x, 0.5);
        const [r2, , b2] = at(blue, x, 0.5);
        assert.ok(r1 > b1 + 40, `${r1} ${b1}`);
        assert.ok(b2 > r2 + 40, `${r2} ${b2}`);
        const last = page.getByTestId('trial').locator('img');
        await until(() => last.evaluate((one, width) => one.naturalWidth >= width, Math.floor(box.width)), 'a look in full size');
    });

    test('a pattern that is used twice is one material of one shader', async () => {
        await open();
        for (const node of ['ball', 'crate']) {
            await openGallery(node);
            await page.keyboard.type('marble');
            await page.keyboard.press('Enter');
            await when((d) => materialOf(d, node) === 'marble', `${node} of marble`);
        }
        const { materials, shaders } = JSON.parse(await stage.document(id));
        assert.deepEqual(Object.keys(shaders), ['marble']);
        assert.equal(Object.keys(materials).filter((name) => name.startsWith('marble')).length, 1);
        await settled(page);
        assert.equal(await page.locator('.notice[data-level=error]').count(), 0);
    });
});

describe('balls that are dragged', () => {
    const clay = () => page.locator('[data-resource="slate"] .resource-pick');

    test('onto a row, onto the picture, onto a card', async () => {
        await open({ width: 1440 });
        await clay().dragTo(row(page, 'ring'));
        await when((d) => materialOf(d, 'ring') === 'slate', 'a ring of slate');
        await settled(page);
        const box = await picture(page).boundingBox();
        const x = 0.5 - (1.5 / 7.16 / (2 * Math.tan(Math.PI / 8))) * (box.height / box.width);
        await clay().dragTo(picture(page), { targetPosition: { x: box.width * x, y: box.height / 2 } });
        await when((d) => materialOf(d, 'ball') === 'slate', 'a ball of slate');
        await page.keyboard.press('Alt+1');
        await clay().dragTo(page.locator('[data-card="pole"]'));
        await when((d) => materialOf(d, 'pole') === 'slate', 'a pole of slate');
    });
});

describe('values at hand', () => {
    test('colour and gloss stand with the node; others are told of, and left alone by a copy', async () => {
        await open();
        await row(page, 'ring').click();
        await page.locator('[data-param="material"]').getByRole('combobox').click();
        await page.getByRole('option', { name: 'clay' }).click();
        await when((d) => materialOf(d, 'ring') === 'clay', 'a ring of clay');
        await page.getByText('Also on 1 other.').waitFor();
        await page.locator('[data-param="diffuse"]').first().waitFor();
        await page.getByRole('button', { name: 'Make unique' }).click();
        const own = await when((d) => materialOf(d, 'ring') === 'clay-1', 'a material of its own');
        assert.equal(materialOf(own, 'ball'), 'clay');
        await page.getByText('Also on 1 other.').waitFor({ state: 'detached' });
    });

    test('nodes of different materials have none of their values', async () => {
        await open();
        const colour = page.locator('[data-param="diffuse"]').first();
        await row(page, 'crate').click();
        await colour.waitFor();
        await row(page, 'ball').click({ modifiers: ['Control'] });
        await page.getByRole('heading', { name: '2 nodes' }).waitFor();
        await colour.waitFor({ state: 'detached' });
    });

    test('a colour is taken from the picture: that of the surface, by one press', async () => {
        await open();
        await row(page, 'crate').click();
        await page.locator('[data-param="diffuse"] .colour-button').first().click();
        const { x, y, width, height } = await picture(page).boundingBox();
        const ball = x + width / 2 - (1.5 / 7.16 / (2 * Math.tan(Math.PI / 8))) * height;
        const take = page.getByRole('button', { name: 'Take from the picture' });
        await take.click();
        await page.keyboard.press('Escape'); // of the eyedropper alone
        await take.click();
        await page.mouse.click(ball, y + height / 2);
        const taken = await when((d) => d.materials.slate.properties.diffuse[0] === 0.8, 'the colour of clay');
        assert.deepEqual(taken.materials.slate.properties.diffuse, [0.8, 0.3, 0.2]);
        assert.equal(await row(page, 'crate').getAttribute('aria-selected'), 'true');
        await page.keyboard.press('Escape'); // of the sheet, if that is still there
        await take.waitFor({ state: 'detached' });
        await page.mouse.click(ball, y + height / 2); // once: again, it would climb to the parent
        await until(async () => (await row(page, 'ball').getAttribute('aria-selected')) === 'true', 'the ball');
    });
});
