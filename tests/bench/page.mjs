// SPDX-License-Identifier: MIT
// What the page itself costs, in chromium on loopback: tasks of over 50 ms while the view turns; of a
// graph of 1,000 cards the time from one animation frame to the next while it is panned, how soon 30
// cards have pictures, and how many come while the view turns; and the heap behind a collection of
// garbage while a user looks around and edits for some minutes. Prints one JSON object.
// PAGE_SECONDS: of each drag. PAGE_MINUTES: of looking around and editing.
import { until } from '../support/daemon.mjs';
import { field, openStage, picture, row, settled } from '../e2e/stage.mjs';

const SECONDS = Number(process.env.PAGE_SECONDS ?? 10);
const MINUTES = Number(process.env.PAGE_MINUTES ?? 10);
const CARDS = 1000;
const GROUP = 25;
const SEEN_CARDS = 30;

const round = (x) => Math.round(x * 10) / 10;
const percentile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))] ?? null;

/** Long tasks, pictures of nodes and animation frames, with their times. */
function listenIn() {
    window.told = { tasks: [], thumbnails: [], frames: [] };
    new PerformanceObserver((list) => window.told.tasks.push(...list.getEntries().map(({ startTime: at, duration: ms }) => ({ at, ms })))).observe({ type: 'longtask' });
    window.Worker = class extends window.Worker {
        constructor(...args) {
            super(...args);
            this.addEventListener('message', ({ data }) => data.kind === 'thumbnails' && window.told.thumbnails.push({ at: performance.now() }));
        }
    };
    const frame = (at) => {
        window.told.frames.push(at);
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
}

/** Drags at 60 moves a second around the middle of an element; answers what the page told meanwhile. */
async function drag(page, element, seconds) {
    const box = await element.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + 0.8 * box.height];
    await page.mouse.move(x, y);
    await page.mouse.down();
    const from = await page.evaluate(() => performance.now());
    const start = performance.now();
    for (let i = 0; performance.now() - start < seconds * 1000; i += 1) {
        await page.mouse.move(x + 200 * Math.sin(i / 40), y + 30 * Math.sin(i / 25));
        await new Promise((done) => setTimeout(done, Math.max(0, start + (i * 1000) / 60 - performance.now())));
    }
    const told = await page.evaluate((since) => {
        const late = ({ at }) => at >= since;
        const { tasks, thumbnails, frames } = window.told;
        return { tasks: tasks.filter(late), thumbnails: thumbnails.filter(late).length, frames: frames.filter((at) => at >= since) };
    }, from);
    await page.mouse.up();
    return { ...told, apart: told.frames.slice(1).map((at, i) => at - told.frames[i]) };
}

const tasksOf = ({ tasks }) => ({ count: tasks.length, longest_ms: round(Math.max(0, ...tasks.map(({ ms }) => ms))) });

async function open(stage, id, size) {
    const page = await stage.page({ scene: id, ...size });
    await page.addInitScript(listenIn);
    await page.reload();
    await settled(page);
    return page;
}

async function orbiting(stage) {
    const page = await open(stage, await stage.scene(), { width: 1440, height: 900 });
    const told = await drag(page, picture(page), SECONDS);
    await page.context().close();
    return { long_tasks: tasksOf(told), frame_ms: { median: round(percentile(told.apart, 0.5)), p95: round(percentile(told.apart, 0.95)) } };
}

const cardsDocument = {
    format: 'fieldcast/1',
    name: 'Cards',
    root: {
        id: 'root',
        type: 'union',
        children: Array.from({ length: CARDS / GROUP }, (_, i) => ({
            id: `group-${i}`,
            type: 'union',
            children: Array.from({ length: GROUP - 1 }, (__, k) => ({
                id: `ball-${i}-${k}`,
                type: 'sphere',
                params: { radius: 0.05 },
                transform: { translation: [(i % 8) / 4 - 1, k / 12 - 1, Math.floor(i / 8) / 4 - 0.5] },
            })),
        })),
    },
};

/** How long until each card in sight has its picture, after so many are. */
async function fill(page) {
    const cards = page.locator('[data-card]');
    const pictures = page.locator('[data-card] .thumbnail img');
    await page.locator('.react-flow__pane').hover();
    while ((await cards.count()) < SEEN_CARDS) {
        await page.mouse.wheel(0, 60);
        await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    }
    const start = performance.now();
    await until(async () => (await pictures.count()) >= (await cards.count()), 'pictures of all cards');
    return { cards: await cards.count(), ms: round(performance.now() - start) };
}

async function graph(stage) {
    const page = await open(stage, await stage.scene(cardsDocument), { width: 1440, height: 1000 });
    await page.keyboard.press('Alt+1');
    const thumbnails = await fill(page);
    await settled(page);
    const panned = await drag(page, page.locator('.react-flow__pane'), SECONDS);
    await settled(page);
    const turned = await drag(page, picture(page), SECONDS);
    await page.context().close();
    return {
        cards: CARDS,
        thumbnails,
        panned: { long_tasks: tasksOf(panned), frame_ms: { median: round(percentile(panned.apart, 0.5)), p95: round(percentile(panned.apart, 0.95)) } },
        thumbnails_while_the_view_turns: turned.thumbnails,
    };
}

/** Mebibytes that are in use when nothing is left to collect. */
async function heapOf(session) {
    await session.send('HeapProfiler.collectGarbage');
    return round((await session.send('Runtime.getHeapUsage')).usedSize / 2 ** 20);
}

async function working(stage) {
    const page = await open(stage, await stage.scene(), { width: 1440, height: 900 });
    const session = await page.context().newCDPSession(page);
    const heap = [];
    const start = performance.now();
    await row(page, 'ball').click();
    for (let i = 0; performance.now() - start < 60_000 * MINUTES; i += 1) {
        await page.evaluate(() => {
            window.told = { tasks: [], thumbnails: [], frames: [] };
        });
        await drag(page, picture(page), 5);
        await field(page, 'radius').fill(String(0.5 + (i % 10) / 20));
        await page.keyboard.press('Enter');
        await settled(page);
        heap.push({ minute: round((performance.now() - start) / 60_000), mib: await heapOf(session) });
    }
    await page.context().close();
    return heap;
}

const stage = await openStage({ whole: process.env.PAGE_WHOLE === 'yes' });
const results = { orbiting: await orbiting(stage), graph: await graph(stage), heap: MINUTES > 0 ? await working(stage) : [] };
console.log(JSON.stringify(results, null, 2));
await stage.close();
