// SPDX-License-Identifier: MIT
// What comes of asking for one to five times what the machine can do: by more viewers, and by more
// views of each. Useful is a frame that shows a newer view than the one before it. Ratios are to what
// was delivered at one time: of frames a second, and of frames for each second of the processors that the
// daemon got, which other work on the machine changes little. The capacity is measured before each round,
// and each load lasts until its viewers have some frames each. REST pictures are asked all the while, four
// at a time.
import { ask, cpuSecondsOfAll, sleep, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const VIEW = { width: 480, height: 360 };
const VIEWERS = 4; // at one time
const STEPS = [1, 2, 3, 4, 5];
const SECONDS = Number(process.env.OVERLOAD_SECONDS ?? 5);
const ROUNDS = Number(process.env.OVERLOAD_ROUNDS ?? 2);
const FRAMES = 12; // that viewers have on average, unless it takes too long
const MOST_SECONDS = 20;
const PICTURES = 4;
const SCENES = ['one', 'two'];

const round = (x) => Math.round(x * 100) / 100;
const sum = (values) => values.reduce((all, one) => all + one, 0);
const mean = (values) => sum(values) / Math.max(1, values.length);
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const place = (i) => ({ camera: { position: [5 * Math.sin(i / 20), 1, 5 * Math.cos(i / 20)] } });

const daemon = await startDaemon();
for (const id of SCENES) {
    await ask(daemon, 'POST', `/v1/scenes?id=${id}`, { from: 'example:snowman' });
}

/** A viewer that says views until it is told to stop: every so many ms, or (0) when the last is there. */
async function viewer(index, everyMs) {
    const live = await Live.open(daemon, SCENES[index % SCENES.length]);
    const said = new Map();
    const seen = { frames: 0, ages: [], scales: [] };
    let going = true;
    let newest = 0;
    const look = () => {
        for (const frame of live.frames.splice(0)) {
            if (frame.seq > newest) {
                newest = frame.seq;
                seen.frames += 1;
                seen.ages.push(frame.at - said.get(frame.seq));
                seen.scales.push(frame.width / frame.viewWidth);
            }
        }
    };
    const done = (async () => {
        const start = Date.now();
        for (let i = 0; going; i += 1) {
            const seq = live.look({ ...VIEW, ...place(i + 7 * index) });
            said.set(seq, Date.now());
            if (everyMs > 0) {
                await sleep(Math.max(0, start + (i + 1) * everyMs - Date.now()));
                look();
                continue;
            }
            while (going && newest < seq) {
                await sleep(1);
                look();
            }
        }
    })();
    return {
        begin: () => {
            look();
            Object.assign(seen, { frames: 0, ages: [], scales: [] });
        },
        count: () => seen.frames,
        async end() {
            going = false;
            await done;
            look();
            live.socket.destroy();
            return seen;
        },
    };
}

/** Asks for pictures, some at a time; what the queue says of them is kept. */
function pictures() {
    const got = { pictures: 0, refused: 0, position: 0 };
    let going = true;
    const each = async (k) => {
        for (let i = 0; going; i += 1) {
            const answer = await fetch(`${daemon.url}/v1/scenes/one/image.jpg?width=64&height=48&camera.fov=${30 + ((i * PICTURES + k) % 997) / 50}`);
            await answer.arrayBuffer();
            got.pictures += answer.ok;
            got.refused += answer.status === 429 || answer.status === 503;
            const { own } = await ask(daemon, 'GET', '/v1/queue');
            got.position = Math.max(got.position, ...own.map(({ position }) => position));
        }
    };
    const all = Array.from({ length: PICTURES }, (_, k) => each(k));
    return {
        begin: () => Object.assign(got, { pictures: 0, refused: 0, position: 0 }),
        async end() {
            const { pictures: there } = got;
            going = false;
            await Promise.all(all);
            return { ...got, pictures: there };
        },
    };
}

/** So many viewers, each with so many views a second (0: as quickly as it gets pictures). */
async function load(count, perSecond) {
    const viewers = await Promise.all(Array.from({ length: count }, (_, i) => viewer(i, perSecond > 0 ? 1000 / perSecond : 0)));
    const guest = pictures();
    await sleep(1500); // sizes settle, and newcomers have their first frames
    for (const came = Date.now(); viewers.some((one) => one.count() < 2) && Date.now() < came + 1000 * MOST_SECONDS; ) {
        await sleep(50);
    }
    [...viewers, guest].forEach((one) => one.begin());
    const start = Date.now();
    const before = cpuSecondsOfAll(daemon);
    const elapsed = () => (Date.now() - start) / 1000;
    while (elapsed() < SECONDS || (sum(viewers.map((one) => one.count())) < FRAMES * count && elapsed() < MOST_SECONDS)) {
        await sleep(50);
    }
    const seconds = elapsed();
    const spent = cpuSecondsOfAll(daemon) - before;
    const [rest, ...seen] = await Promise.all([guest, ...viewers].map((one) => one.end()));
    const frames = seen.map((one) => one.frames);
    return {
        asked: count * perSecond,
        useful: sum(frames) / seconds,
        each_second: sum(frames) / spent,
        age: median(seen.flatMap((one) => one.ages)) ?? null,
        scale: mean(seen.flatMap((one) => one.scales)),
        fairness: Math.min(...frames) / Math.max(1, mean(frames)),
        pictures: rest.pictures / seconds,
        refused: rest.refused,
        position: rest.position,
    };
}

const kinds = {
    'more viewers': (times, each) => load(times * VIEWERS, each),
    'more views of each': (times, each) => load(VIEWERS, times * each),
};
const results = { viewers: VIEWERS, capacity: [] };
for (const [kind, run] of Object.entries(kinds)) {
    const runs = STEPS.map(() => []);
    for (let i = 0; i < ROUNDS; i += 1) {
        const capacity = (await load(VIEWERS, 0)).useful;
        results.capacity.push(round(capacity));
        for (const [k, times] of STEPS.entries()) {
            console.error(`overload: ${kind}, ${times} times`);
            runs[k].push(await run(times, capacity / VIEWERS));
        }
    }
    const middle = (k, name) => mean(runs[k].map((one) => one[name]));
    results[kind] = STEPS.map((times, k) => ({
        times,
        asked: round(middle(k, 'asked')),
        useful: round(middle(k, 'useful')),
        ratio: round(middle(k, 'useful') / middle(0, 'useful')),
        ratio_of_processors: round(middle(k, 'each_second') / middle(0, 'each_second')),
        age_ms: Math.round(middle(k, 'age')),
        scale: round(middle(k, 'scale')),
        fairness: round(middle(k, 'fairness')),
        pictures: round(middle(k, 'pictures')),
        refused: sum(runs[k].map((one) => one.refused)),
        position: Math.max(...runs[k].map((one) => one.position)),
    }));
}
console.log(JSON.stringify(results, null, 2));
await daemon.stop();
process.exit(0);
