// SPDX-License-Identifier: MIT
// A daemon, a browser and pages for the tests of this folder; what a user sees and does, by names.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { after, afterEach, before } from 'node:test';
import { ask, startDaemon, until } from '../support/daemon.mjs';
import { descendantsOf, Patience } from '../support/patience.mjs';
import { decodePng } from '../support/png.mjs';
import { slowLine } from '../support/slow_line.mjs';
import { Tabs } from './tabs.mjs';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = require('playwright-core');

/** Every wait is for a condition. It ends in vain when nothing happens: pages are closed then. */
const PATIENCE = { idleSeconds: Number(process.env.E2E_IDLE_SECONDS ?? 90), busySeconds: 400 };

/** Pages hear of the server so many milliseconds later: tests that take its state for theirs fail. */
const DELAY_MS = Number(process.env.E2E_DELAY_MS ?? 0);

/** Without windows of its own it takes half of what the whole browser takes. It cannot lock a pointer. */
export const SHELL = '/usr/bin/chromium-headless-shell';
const WHOLE = '/usr/bin/chromium';
const FLAGS = [
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--force-color-profile=srgb',
    '--disable-features=BackForwardCache', // it keeps pages that were left
];

/** Pages of tests live for seconds: what compiles their scripts for speed takes more time than it saves. */
const SHORT_LIVES = '--js-flags=--no-opt,--no-maglev,--min-semi-space-size=16';

const WEBGL_FLAGS = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** Small, quick to draw, with one of everything that the tests touch. */
export const SCENE = {
    format: 'fieldcast/1',
    name: 'Table',
    camera: { position: [0, 1.5, 7], target: [0, 0, 0] },
    lights: [{ id: 'sun', type: 'directional', direction: [-0.5, -1, -0.5] }],
    materials: {
        clay: { shader: 'phong', properties: { diffuse: [0.8, 0.3, 0.2] } },
        slate: { shader: 'phong', properties: { diffuse: [0.2, 0.25, 0.3] } },
    },
    render: { samples: 1 },
    root: {
        id: 'root',
        type: 'union',
        children: [
            {
                id: 'ball',
                type: 'sphere',
                material: 'clay',
                params: { radius: 1 },
                transform: { translation: [-1.5, 0, 0] },
            },
            {
                id: 'crate',
                type: 'box',
                material: 'slate',
                params: { size: [1.5, 1.5, 1.5] },
                transform: { translation: [1.5, 0, 0] },
            },
            {
                id: 'pair',
                type: 'group',
                children: [
                    { id: 'ring', type: 'torus', transform: { translation: [0, 2, 0] } },
                    { id: 'pole', type: 'cylinder', transform: { translation: [0, -2, 0] } },
                ],
            },
        ],
    },
};

/** Tells what its pages show, for whoever reads why a wait was in vain, and closes them. */
async function closeTold(context) {
    for (const page of context.pages()) {
        const shown = page.evaluate(() => ({
            address: location.pathname,
            state: document.querySelector('[data-testid=state]')?.dataset.state,
            strip: document.querySelector('[data-testid=strip]')?.innerText,
            focus: document.activeElement?.outerHTML.slice(0, 120),
        }));
        const silence = new Promise((done) => setTimeout(() => done('no answer'), 5000));
        console.log(`# page: ${JSON.stringify(await Promise.race([shown, silence]).catch(String))}`);
    }
    await context.close();
}

/** Closes all pages when they, the daemon and the test itself have nothing more to say. */
function watch(browser) {
    const patience = new Patience(() => descendantsOf(process.pid), PATIENCE);
    const timer = setInterval(() => {
        const reason = patience.isOver();
        if (reason) {
            console.log(`# waited in vain: ${reason}\n${String(patience).replace(/^/gm, '# ')}`);
            patience.heard();
            browser.contexts().forEach(closeTold);
        }
    }, patience.periodMs);
    return { heard: () => patience.heard(), end: () => clearInterval(timer) };
}

/**
 * FIELDCAST_WEB: a built page to serve instead of the one in the program. `data`: where. `driver`: as
 * of startDaemon. `whole`: in the browser that users have. `webgl`: the processors do what it asks for.
 * `coarse`: pictures have a quarter of the pixels, for tests that count none and hold none against the server's.
 */
export async function openStage({ data, driver, whole = false, webgl = false, coarse = false, args: more = [] } = {}) {
    const web = process.env.FIELDCAST_WEB;
    const args = [...(web ? ['--web', web] : []), ...more];
    const daemon = await startDaemon({ data, driver, args });
    const site = DELAY_MS > 0 ? await slowLine(Number(new URL(daemon.url).port), DELAY_MS) : daemon.url;
    const executablePath = whole ? WHOLE : SHELL;
    const flags = webgl ? [...FLAGS.filter((flag) => flag !== '--disable-gpu'), ...WEBGL_FLAGS] : [...FLAGS];
    if (!whole) {
        flags.push(SHORT_LIVES);
    }
    const browser = await chromium.launch({ executablePath, args: flags, timeout: 0 });
    const watched = watch(browser);
    const tabs = new Tabs(browser, () => `${site}/healthz`);
    let made = 0;
    return {
        daemon,
        /** Where pages find it. */
        site,
        browser,
        args,
        /** A new scene's id. */
        async scene(document = SCENE) {
            made += 1;
            const id = `scene-${made}`;
            await ask(daemon, 'POST', `/v1/scenes?id=${id}`, document);
            return id;
        },
        /** Something is still going on. */
        heard: watched.heard,
        page: (options) => openPage(tabs, site, watched, { whole, coarse, ...options }),
        /** The document's bytes as the server holds them. */
        document: async (id) => (await fetch(`${daemon.url}/v1/scenes/${id}`)).text(),
        async close() {
            watched.end();
            await browser.close();
            await daemon.stop();
        },
    };
}

/**
 * The stage of a suite: there before its tests, gone after them. `prepare` runs before the tests as
 * well. Pages that a test leaves open are closed after it; `keep` does that for a page that was opened
 * otherwise.
 */
export function useStage(options, prepare = () => {}) {
    const stage = {};
    const open = new Set();
    before(async () => {
        const made = await openStage(options);
        const keep = (page) => open.add(page) && page;
        Object.assign(stage, made, { keep, page: async (more) => keep(await made.page(more)) });
        await prepare();
    });
    after(() => stage.close());
    afterEach(async () => {
        const left = [...open].filter(isOpen);
        open.clear();
        for (const page of left) {
            await closePage(page);
        }
    });
    return stage;
}

const tabsOf = new WeakMap(); // of pages that a stage opened

/** `scene` null: the start page. What the console says goes into `page.problems`. */
async function openPage(tabs, site, watched, options = {}) {
    const { scene = null, width = 1200, height = 800, theme = 'dark', ...more } = options;
    const page = await tabs.take({ width, height, theme, ...more });
    tabsOf.set(page, tabs);
    page.on('request', watched.heard);
    page.on('websocket', (socket) => socket.on('framereceived', watched.heard));
    page.problems = [];
    page.expected = undefined;
    page.on('pageerror', (error) => page.problems.push(String(error)));
    page.on('console', (message) => {
        if (message.type() === 'error' || message.type() === 'warning') {
            page.problems.push(message.text());
        }
    });
    await page.goto(`${site}/${scene === null ? '' : `s/${scene}`}`);
    if (scene !== null) {
        await page.locator('[role=treeitem]').first().waitFor();
    }
    return page;
}

const isOpen = (page) => (tabsOf.has(page) ? tabsOf.get(page).isOut(page) : !page.isClosed());

/** Ends a page and answers for its console; `expected`: what it may say at any time. */
export async function closePage(page) {
    await (tabsOf.has(page) ? tabsOf.get(page).giveBack(page) : page.context().close());
    assert.deepEqual(page.problems.filter((problem) => !page.expected?.test(problem)), []);
}

export const row = (page, node) => page.locator(`[data-node="${node}"]`);
export const picture = (page) => page.getByTestId('picture');
export const field = (page, name) => page.getByRole('spinbutton', { name, exact: true });

/** Waits until a field shows `value`. */
export const valueIs = (locator, value) =>
    until(async () => (await locator.inputValue()) === value, `the value ${value}`);

/** Asserts that an element covers nothing of others, all of which are seen. */
export async function keepsOff(one, others) {
    const a = await one.boundingBox();
    for (const other of others) {
        const b = await other.boundingBox();
        assert.ok(a !== null && b !== null && a.width * a.height > 0 && b.width * b.height > 0, `${one} or ${other} is not seen`);
        const apart = a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height || b.y >= a.y + a.height;
        assert.ok(apart, `${one} at ${JSON.stringify(a)} lies over ${other} at ${JSON.stringify(b)}`);
    }
}

/** Waits until everything is saved and the lossless picture of that revision is shown. */
export const settled = (page) =>
    page.waitForFunction(
        () => {
            const saved = document.querySelector('[data-testid=saved]')?.dataset;
            const shown = document.querySelector('[data-testid=state]')?.dataset;
            return (
                saved?.state === 'saved' &&
                shown?.state === 'final' &&
                shown.revision === saved.revision
            );
        },
        undefined,
        { polling: 50 }, // by itself it makes the browser draw all the time
    );
export const waitForSaved = (page) =>
    page.locator('[data-testid=saved][data-state=saved]').waitFor();

/**
 * What holds a picture, of the elements of a kind: how many there are, the texts of those without one, how many are in
 * sight, and how many of these show one. Waits until nothing in sight is still on its way.
 */
export async function picturesIn(page, selector) {
    const count = () =>
        page.locator(selector).evaluateAll((elements) => {
            const isSeen = (element) => {
                const { left, top, width, height } = element.getBoundingClientRect();
                const [x, y] = [left + width / 2, top + height / 2];
                return x > 0 && y > 0 && element.contains(document.elementFromPoint(x, y));
            };
            const seen = elements.filter(isSeen);
            const images = seen.map((one) => one.querySelector('img')).filter((image) => image !== null);
            return {
                all: elements.length,
                without: elements.filter((one) => !one.querySelector('img')).map((one) => one.textContent),
                seen: seen.length,
                shown: images.filter((image) => image.complete && image.naturalWidth > 0).length,
                coming: images.filter((image) => !image.complete).length + seen.filter((one) => one.querySelector('[data-waiting]')).length,
            };
        });
    return until(async () => {
        const now = await count();
        return now.seen > 0 && now.coming === 0 && now;
    }, 'pictures in sight');
}

/** Ids of the rows in sight, from top to bottom. */
export async function rows(page) {
    const found = await page.locator('[data-node]').evaluateAll((list) =>
        list
            .map((one) => ({ id: one.dataset.node, top: one.getBoundingClientRect().top }))
            .sort((a, b) => a.top - b.top)
            .map(({ id }) => id),
    );
    return found;
}

/** Pixels of the picture alone, without what lies over it: pills, grid, hands, outlines, the ring of a click, the focus. */
export async function pixels(page) {
    const style = await page.addStyleTag({
        content: `.view > :not(.view-picture), .view-picture > :not(canvas), .view-grid, .view-hands, .view-outlines,
            .view-picture::after,
            .notices { visibility: hidden !important; }`,
    });
    const box = await picture(page).boundingBox();
    const image = decodePng(await page.screenshot({ clip: box }));
    await style.evaluate((element) => element.remove());
    return { ...image, box };
}

/** Greatest difference of a channel; the alpha of either is left aside. */
export function difference(a, b) {
    assert.deepEqual([a.width, a.height], [b.width, b.height]);
    let most = 0;
    for (let i = 0; i < a.width * a.height; i += 1) {
        for (let c = 0; c < 3; c += 1) {
            const x = a.pixels[i * a.channels + c];
            const y = b.pixels[i * b.channels + c];
            most = Math.max(most, Math.abs(x - y));
        }
    }
    return most;
}

/**
 * The pixels when looks are the same. The page tells of a frame before the browser has put it on the
 * screen: what has to be the newest to a step is asked for by `until`, or is `drawnPixels`.
 */
export async function stillPixels(page) {
    let last = await pixels(page);
    return until(
        async () => {
            const before = last;
            last = await pixels(page);
            return difference(last, before) === 0 && last;
        },
        'a still picture',
    );
}

/** The pixels once they are those that the server draws of the document. */
export async function drawnPixels(page, stage, id) {
    const { width, height } = await pixels(page);
    const answer = await fetch(`${stage.daemon.url}/v1/scenes/${id}/image.png?width=${width}&height=${height}`);
    assert.equal(answer.status, 200);
    const image = decodePng(Buffer.from(await answer.arrayBuffer()));
    return pixelsLike(page, image, 0, 'the pixels of image.png on the screen');
}

/** Waits until no channel of the pixels is further than `room` from an image; answers them. */
export const pixelsLike = (page, image, room, what) =>
    until(
        async () => {
            const now = await pixels(page);
            return difference(now, image) <= room && now;
        },
        what,
    );

/** Waits for what the browser itself says of a refused request, which the console then is free of. */
export async function forgetProblem(page, pattern) {
    await until(() => page.problems.some((text) => pattern.test(text)), `${pattern} in the console`);
    page.problems = page.problems.filter((text) => !pattern.test(text));
}

/** Waits until the picture differs from `before`; answers the new pixels. */
export const pictureChanged = (page, before, what) =>
    until(
        async () => {
            const now = await pixels(page);
            return difference(now, before) > 8 && now;
        },
        what,
    );

/**
 * Waits until the server's document satisfies `holds`. A document leaves out what is empty or a
 * default: an expression about a part that is not there yet is not true yet.
 */
export async function documentWhen(stage, id, holds, what) {
    let last;
    const asked = async () => {
        const document = JSON.parse(await stage.document(id));
        try {
            return holds(document) && document;
        } catch (problem) {
            last = problem;
            return false;
        }
    };
    try {
        return await until(asked, what);
    } catch (problem) {
        problem.cause ??= last;
        throw problem;
    }
}

export function nodeIn(document, id, node = document.root) {
    if (node.id === id) {
        return node;
    }
    for (const child of node.children ?? []) {
        const found = nodeIn(document, id, child);
        if (found) {
            return found;
        }
    }
    return null;
}

/** Presses and drags from the middle of an element; `leave` keeps the button down. */
export async function dragBy(page, locator, dx, dy, { steps = 12, leave = false } = {}) {
    const box = await locator.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y + dy, { steps });
    if (!leave) {
        await page.mouse.up();
    }
}

/** Takes hold of something that the browser drags, brings it to a point of the window and holds it there. */
export async function carryTo(page, locator, { x, y }) {
    await locator.hover();
    await page.mouse.down();
    await page.mouse.move(x - 6, y, { steps: 3 });
    await page.mouse.move(x, y);
}

/** The same, and lets it go. */
export async function carry(page, locator, point) {
    await carryTo(page, locator, point);
    await page.mouse.up();
}

export const readDownload = async (download) => fs.promises.readFile(await download.path(), 'utf8');
