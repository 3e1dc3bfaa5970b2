// SPDX-License-Identifier: MIT
// While the server's picture is on its way, the page shows the last one as the camera sees it by now:
// behind a long line, and behind no other.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { openScreen } from './screens/screen.mjs';
import { dragBy, picture, settled, useStage } from './stage.mjs';

/* A card off the target, with a light in it, whose mark the page draws. */
const AT = [1.3, 0.5, 0.9];
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: [0, 0.6, 7], target: [0, 0, 0] },
    environment: { type: 'solid', color: [0, 0, 0] },
    lights: [{ id: 'lamp', type: 'point', position: AT, intensity: 0 }],
    materials: { bright: { shader: 'unlit', properties: { color: [0.4, 0.4, 0.4] } } },
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        material: 'bright',
        children: [{ id: 'card', type: 'box', params: { size: [0.8, 0.8, 0.02] }, transform: { translation: AT } }],
    },
};
const WINDOW = { theme: 'dark', width: 1100, height: 700 };
const MOVED = 8; // of the pointer, CSS pixels

const stage = useStage({ webgl: true });

/** The processors may do what the page asks of a GPU. */
function allowSoftware() {
    const get = OffscreenCanvas.prototype.getContext;
    OffscreenCanvas.prototype.getContext = function (kind, settings = {}) {
        return get.call(this, kind, { ...settings, failIfMajorPerformanceCaveat: false });
    };
    WebGL2RenderingContext.prototype.getExtension = () => null;
}

/** A short line, whatever the machine. */
function slowClock() {
    const now = performance.now.bind(performance);
    performance.now = () => now() / 1e4;
}

/** Middles of what is bright in the picture, and of the mark; CSS pixels of the picture. */
const look = (page) =>
    page.evaluate(() => {
        const canvas = document.querySelector('.view-picture > canvas');
        const copy = document.createElement('canvas');
        Object.assign(copy, { width: canvas.width, height: canvas.height });
        const brush = copy.getContext('2d', { willReadFrequently: true });
        brush.drawImage(canvas, 0, 0);
        const { data, width } = brush.getImageData(0, 0, canvas.width, canvas.height);
        let [x, y, weight] = [0, 0, 0];
        for (let i = 0; i < data.length; i += 4) {
            const light = Math.max(0, data[i + 1] - 12);
            x += light * (((i / 4) % width) + 0.5);
            y += light * (Math.floor(i / 4 / width) + 0.5);
            weight += light;
        }
        const mark = document.querySelector('[data-mark="lights/lamp"]').style.translate.split(' ').map(parseFloat);
        return { card: [x / weight, y / weight], mark };
    });

const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
const views = (page) => page.sent.filter(({ type }) => type === 'view');

async function open(...scripts) {
    const script = { content: scripts.map((one) => `(${one})();`).join('\n') };
    const page = await openScreen(stage, { scene: DOCUMENT, tampered: true, delay: scripts.includes(slowClock) ? 0 : 120, script }, WINDOW);
    await settled(page);
    await page.locator('[data-mark="lights/lamp"]').waitFor({ state: 'attached' }); // it comes later than the picture
    // So many views that the way of each is known.
    for (let i = 0; i < 6; i += 1) {
        const sent = views(page).length;
        await dragBy(page, picture(page), i % 2 === 0 ? 6 : -6, 0, { steps: 2 });
        await until(() => views(page).length > sent, 'a view');
        await settled(page);
    }
    return page;
}

/** Turns the camera while nothing that the server draws gets through; answers what is let through then. */
async function turnAlone(page) {
    const held = [];
    page.hold = (message) => typeof message !== 'string' && held.push(message) > 0;
    const sent = views(page).length;
    await dragBy(page, picture(page), MOVED, 0, { steps: 6, leave: true });
    await until(() => views(page).length > sent, 'a view');
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return async () => {
        await page.mouse.up();
        await until(() => held.length > 0, 'a picture of the new view');
        page.hold = null;
        held.forEach(page.pass);
        await settled(page);
    };
}

test('behind a long line the picture and what is drawn over it go along with the pointer', async () => {
    const page = await open(allowSoftware);
    assert.ok(views(page).at(-1).depths, 'depths are asked for');
    const before = await look(page);
    const letThrough = await turnAlone(page);
    let last = before;
    const warped = await until(async () => {
        const earlier = last;
        last = await look(page);
        return apart(last.card, before.card) > 3 && apart(last.card, earlier.card) === 0 && last;
    }, 'a picture that has moved and stands');
    assert.ok(apart(warped.card, warped.mark) < 2, JSON.stringify(warped));
    await letThrough();
    const after = await look(page);
    console.log(`# ${JSON.stringify({ before, warped, after })}`);
    assert.ok(apart(after.mark, warped.mark) < 0.01, 'the mark was where it has to be');
    assert.ok(apart(after.card, warped.card) < 2, JSON.stringify({ before, warped, after }));
});

test('behind a short line each picture is the server\'s', async () => {
    const page = await open(allowSoftware, slowClock);
    assert.ok(views(page).every(({ depths }) => !depths), 'no depths are asked for');
    const before = await look(page);
    const letThrough = await turnAlone(page);
    assert.deepEqual(await look(page), before);
    await letThrough();
    assert.ok(apart((await look(page)).card, before.card) > 3);
});

test('where the processors would draw it each picture is the server\'s', async () => {
    const page = await open();
    assert.ok(views(page).every(({ depths }) => !depths), 'no depths are asked for');
    const before = await look(page);
    const letThrough = await turnAlone(page);
    assert.deepEqual(await look(page), before);
    await letThrough();
});
