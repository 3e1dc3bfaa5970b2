// SPDX-License-Identifier: MIT
// A plane cuts the pictures of one page: as REST draws them, no edit, and clicks find what is seen.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';
import { TAGS, violationsOf } from './axe.mjs';
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

/** Waits until the page shows what REST draws of a section. */
async function showsCut(page, id, section) {
    const { width, height } = await pixels(page);
    const answer = await fetch(`${stage.daemon.url}/v1/render`, {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify({ scene: id, width, height, section }),
    });
    const image = decodePng(Buffer.from(await answer.arrayBuffer()));
    return pixelsLike(page, image, 1, JSON.stringify(section));
}

const sum = (...vectors) => vectors.reduce((a, b) => a.map((x, i) => x + b[i]));
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a.reduce((all, x, i) => all + x * b[i], 0);
const unit = (a) => times(a, 1 / Math.hypot(...a));
const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

/** Where on the z axis, from `at`, the ray of a point of the picture is nearest to it. */
function alongZ({ position, target, fov }, { width, height }, { x, y }, at) {
    const forward = unit(sum(target, times(position, -1)));
    const right = unit(cross(forward, [0, 1, 0]));
    const pixel = (2 * Math.tan((fov * Math.PI) / 360)) / height;
    const ray = unit(
        sum(forward, times(right, (x - width / 2) * pixel), times(cross(right, forward), (height / 2 - y) * pixel)),
    );
    const apart = sum(position, [0, 0, -at]);
    return (apart[2] - ray[2] * dot(apart, ray)) / (1 - ray[2] ** 2);
}

const arrowOf = (page) => page.getByTestId('section-arrow');
const placeOf = async (page) => Number(await arrowOf(page).getAttribute('aria-valuenow'));

/** Presses the arrow and leaves the button down: the point in the window. */
async function takeArrow(page) {
    const box = await arrowOf(page).boundingBox();
    const at = { x: Math.round(box.x + box.width / 2), y: Math.round(box.y + box.height / 2) };
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    return at;
}

test('a plane cuts what one page shows, and is no edit', async () => {
    const id = await stage.scene(DOCUMENT);
    const [page, other] = [await stage.page({ scene: id }), await stage.page({ scene: id })];
    const before = await stage.document(id);
    await Promise.all([settled(page), settled(other)]);
    const [all, seen] = [await drawnPixels(page, stage, id), await drawnPixels(other, stage, id)];
    const pill = page.getByTestId('section');
    const box = await picture(page).boundingBox();
    const shows = (section) => showsCut(page, id, section);

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

test('a hand or keys move the plane along its normal by the arrow, and edit nothing', async () => {
    const camera = { position: [4, 3, 6], target: [0, 0, 0], fov: 40 };
    const id = await stage.scene({ ...DOCUMENT, camera });
    const page = await stage.page({ scene: id });
    const before = await stage.document(id);
    await settled(page);
    await picture(page).focus();
    await page.keyboard.press('k');
    await arrowOf(page).waitFor();
    const cut = await showsCut(page, id, { normal: [0, 0, 1], offset: 0 });

    const box = await picture(page).boundingBox();
    const inPicture = ({ x, y }) => ({ x: x - box.x, y: y - box.y });
    const between = (from, to, at) =>
        alongZ(camera, box, inPicture(to), at) - alongZ(camera, box, inPicture(from), at);
    const from = await takeArrow(page);
    const to = { x: from.x - 40, y: from.y + 30 };
    await page.mouse.move(from.x - 10, from.y - 20);
    await page.mouse.move(to.x, to.y);
    const wanted = between(from, to, 0);
    assert.ok(wanted > 0.2 && wanted < 1.5, `a way of ${wanted} within the scene`);
    await until(async () => Math.abs((await placeOf(page)) - wanted) < 1e-6, `the place ${wanted}`);
    const told = await page.getByTestId('section').locator('output').innerText();
    assert.ok(Math.abs(Number(told) - wanted) < 1e-2, `the bar says ${told}`);
    await pictureChanged(page, cut, 'the cut while the hand moves');
    await page.keyboard.down('Control');
    await page.mouse.move(to.x + 1, to.y);
    const stepped = Math.round(between(from, { x: to.x + 1, y: to.y }, 0) * 10) / 10;
    await until(async () => (await placeOf(page)) === stepped, `the step ${stepped}`);
    await page.keyboard.up('Control');
    await page.mouse.move(to.x, to.y);
    await page.mouse.up();
    await showsCut(page, id, { normal: [0, 0, 1], offset: await placeOf(page) });
    assert.ok(Math.abs((await placeOf(page)) - wanted) < 1e-6);

    /* A tenth of the way. */
    const start = await placeOf(page);
    const again = await takeArrow(page);
    await page.keyboard.down('Shift');
    await page.mouse.move(again.x + 40, again.y - 30);
    await page.keyboard.up('Shift');
    const fine = between(again, { x: again.x + 4, y: again.y - 3 }, start);
    await until(async () => Math.abs((await placeOf(page)) - start - fine) < 1e-6, `a way of ${fine}`);
    await page.keyboard.press('Escape');
    assert.equal(await placeOf(page), start);
    await page.mouse.up();
    await page.getByTestId('section').waitFor();

    await arrowOf(page).focus();
    await page.keyboard.press('Home');
    const least = await placeOf(page);
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('Shift+ArrowRight');
    assert.ok(Math.abs((await placeOf(page)) - least - 0.11) < 6e-3, 'a step and a tenth of one');
    await page.getByRole('button', { name: 'Other side' }).click();
    await showsCut(page, id, { normal: [0, 0, -1], offset: -(await placeOf(page)) });
    assert.deepEqual(await violationsOf(page, { inside: '.view', tags: [...TAGS, 'best-practice'] }), []);
    assert.equal(await stage.document(id), before);
});

test('a plane that faces the viewer follows a way down, and a finger', async () => {
    const id = await stage.scene(DOCUMENT);
    const page = await stage.page({ scene: id, touch: true });
    await settled(page);
    await picture(page).focus();
    await page.keyboard.press('k');
    await arrowOf(page).waitFor();
    const { height } = await picture(page).boundingBox();
    const box = await arrowOf(page).boundingBox();
    const at = { x: Math.round(box.x + box.width / 2), y: Math.round(box.y + box.height / 2) };
    const session = await page.context().newCDPSession(page);
    const touch = (type, touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
    await touch('touchStart', [at]);
    /* A finger that rests elsewhere gets the menu after half a second. */
    await page.evaluate(() => new Promise((done) => setTimeout(done, 800)));
    assert.equal(await page.getByRole('menu').count(), 0);
    await touch('touchMove', [{ x: at.x, y: at.y + 20 }]);
    await touch('touchMove', [{ x: at.x + 5, y: at.y + 50 }]);
    await touch('touchEnd', []);
    const wanted = (50 * 8 * 2 * Math.tan((20 * Math.PI) / 180)) / height;
    await until(async () => Math.abs((await placeOf(page)) - wanted) < 1e-6, `the place ${wanted}`);
    await showsCut(page, id, { normal: [0, 0, 1], offset: await placeOf(page) });
});
