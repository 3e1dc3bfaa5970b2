// SPDX-License-Identifier: MIT
// Orbiting in chromium, on loopback: pictures a second, how large they are, the time from a view to
// the picture of it, and the time to a picture in full size when the hand rests. CPU of each process
// in processors. Prints one JSON object.
// ORBIT_SCENES: examples, by commas. ORBIT_SECONDS: of each drag.
import fs from 'node:fs';
import { ask, startDaemon } from '../support/daemon.mjs';
import { openStage, picture, settled } from '../e2e/stage.mjs';
import { descendantsOf } from '../support/patience.mjs';

const USUAL = 'first-steps,csg,primitives,snowman,temple,snail';
const SCENES = (process.env.ORBIT_SCENES ?? USUAL).split(',');
const SECONDS = Number(process.env.ORBIT_SECONDS ?? 4);
const WINDOW = { width: 1858, height: 793 }; // its picture is about 1280×720
const TICKS = 100; // of the kernel's clock, a second

const round = (x) => Math.round(x * 10) / 10;
const percentile = (values, share) => {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? null;
};

/** Keeps what the page's own thread of the connection tells, with its time. */
function listenIn() {
    window.told = [];
    window.Worker = class extends window.Worker {
        constructor(...args) {
            super(...args);
            this.addEventListener('message', ({ data }) => {
                if (data.kind === 'frame' || data.kind === 'statistics') {
                    window.told.push({ at: performance.now(), ...data });
                }
            });
        }
    };
}

/** Processor time of all below a process in seconds, by what they are. */
function cpuOf(root) {
    const seconds = {};
    for (const { pid } of descendantsOf(root)) {
        try {
            const stat = fs.readFileSync(`/proc/${pid}/stat`, 'utf8');
            const command = fs.readFileSync(`/proc/${pid}/cmdline`, 'utf8');
            const end = stat.lastIndexOf(')');
            const kind = /--type=([a-z-]+)/.exec(command)?.[1] ?? stat.slice(stat.indexOf('(') + 1, end);
            const fields = stat.slice(end + 2).split(' ');
            seconds[kind] = (seconds[kind] ?? 0) + (Number(fields[11]) + Number(fields[12])) / TICKS;
        } catch {
            // It has ended.
        }
    }
    return seconds;
}

const shares = (before, after, seconds) =>
    Object.fromEntries(
        Object.entries(after).map(([kind, s]) => [kind, round((s - (before[kind] ?? 0)) / seconds)]),
    );

async function drag(page) {
    const box = await picture(page).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    const start = performance.now();
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 0; performance.now() - start < SECONDS * 1000; i += 1) {
        const due = start + (i * 1000) / 60;
        await page.mouse.move(x + 200 * Math.sin(i / 40), y + 20 * Math.sin(i / 25));
        await new Promise((done) => setTimeout(done, Math.max(0, due - performance.now())));
    }
    await page.mouse.up();
}

async function measure(stage, name) {
    await ask(stage.daemon, 'POST', `/v1/scenes?id=${name}`, { from: `example:${name}` });
    const context = await stage.browser.newContext({ viewport: WINDOW, reducedMotion: 'reduce' });
    await context.addInitScript(listenIn);
    const page = await context.newPage();
    page.setDefaultTimeout(0);
    await page.goto(`${stage.daemon.url}/s/${name}`);
    await settled(page);
    await drag(page); // what is known of the scene's cost
    await settled(page);
    const from = await page.evaluate(() => performance.now());
    const before = cpuOf(process.pid);
    await drag(page);
    const after = cpuOf(process.pid);
    const until = await page.evaluate(() => performance.now());
    await settled(page);
    const told = (await page.evaluate(() => window.told)).filter(({ at }) => at >= from);
    await context.close();
    const frames = told.filter(({ kind }) => kind === 'frame');
    const moving = frames.filter(({ at }) => at <= until);
    const times = told.filter(({ kind, at }) => kind === 'statistics' && at <= until + 600);
    const still = frames.find(({ at, frame }) => at > until && frame.scale === 1 && !frame.outdated);
    const last = times.at(-1)?.statistics;
    return {
        scene: name,
        pictures_per_second: round((moving.length * 1000) / (until - from)),
        width: percentile(moving.map(({ frame }) => frame.width), 0.5),
        photon_ms: [round(last?.photonP50), round(last?.photonP95)],
        stages_ms: last?.stages.map(round),
        still_ms: still ? Math.round(still.at - until) : null,
        cpu: shares(before, after, (until - from) / 1000),
    };
}

const stage = await openStage({ whole: true });
try {
    const runs = [];
    for (const name of SCENES) {
        runs.push(await measure(stage, name));
        console.error(JSON.stringify(runs.at(-1)));
    }
    console.log(JSON.stringify({ runs }));
} finally {
    await stage.close();
}
