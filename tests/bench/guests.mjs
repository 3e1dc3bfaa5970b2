// SPDX-License-Identifier: MIT
// What a viewer feels of others: how long a view of 128×96 that moves 25 times a second waits for its
// picture, alone and beside each kind of guest, by turns in one run, and how long a picture of 64×48
// takes beside it. The view takes less than half of the machine, so that a fair share is enough for
// it. Milliseconds, and ratios of the medians and of the 99th of a hundred: those of all rounds
// together, and the median of the rounds' own. What misses a target is listed as `missed`, and the exit
// status is 1 then: the 99th of a hundred at most 1.5 times that of the viewer alone (the median of the
// rounds' own), each picture within a second, and at most one worker lost.
//
//   node tests/bench/guests.mjs [WORD]...    guests whose name holds one of the words; none: all
import { execFileSync, spawn } from 'node:child_process';
import { once } from 'node:events';
import http from 'node:http';
import { ask, counter, sleep, startDaemon } from '../support/daemon.mjs';
import { Live, now } from '../support/live.mjs';
import { GUESTS } from './guest.mjs';
import { EVERY_MS, place, VIEW } from './moving.mjs';

const GUEST = new URL('guest.mjs', import.meta.url).pathname;
const SECONDS = Number(process.env.GUEST_SECONDS ?? 4);
const ROUNDS = Number(process.env.GUEST_ROUNDS ?? 5);
const PICTURES = 3; // of 64×48, in each round
const STAGES = ['queue', 'environment', 'march', 'material', 'shadow', 'shade', 'rays', 'volume', 'resolve', 'read', 'encode', 'else'];
const MOST_RATIO = 1.5;
const MOST_PICTURE_MS = 1000;
const MOST_RESTARTS = 1;
const wanted = process.argv.slice(2); // names of guests; none: all

const percentile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const round = (x) => Math.round(x * 100) / 100;

/**
 * The viewer has a machine of its own: it waits for no processor here. A niceness alone does not do that: a
 * kernel that takes no processor between two ticks lets it wait for up to 4 ms. The guests do not inherit it.
 */
const goFirst = () => execFileSync('chrt', ['--reset-on-fork', '--fifo', '--pid', '1', String(process.pid)]);

/** A guest in a process of its own; answers what makes it leave. */
async function come(name) {
    const guest = spawn(process.execPath, [GUEST, String(daemon.port), name], { stdio: ['pipe', 'pipe', 'inherit'] });
    await once(guest.stdout, 'data');
    return async () => {
        guest.stdin.end();
        await once(guest, 'exit');
    };
}

/** Milliseconds from each view to the first picture of it or of a later one, and where they went. */
async function waits(live, seconds) {
    const asked = new Map();
    const pictures = [];
    const end = now() + 1000 * seconds;
    live.frames.length = 0;
    for (let i = 0; now() < end; i += 1) {
        asked.set(live.look({ ...VIEW, ...place(i) }), now());
        await sleep(EVERY_MS);
        for (const frame of live.frames.splice(0)) {
            for (const [seq, at] of asked) {
                if (seq <= frame.seq) {
                    pictures.push({ ms: frame.at - at, stages: frame.stagesUs.map((us) => us / 1000) });
                    asked.delete(seq);
                }
            }
        }
    }
    for (const at of asked.values()) {
        pictures.push({ ms: now() - at, stages: [] }); // at least
    }
    return pictures;
}

const daemon = await startDaemon();
try {
    goFirst();
} catch {
    console.error('guests: without the right to go first, the viewer waits for a processor too');
}
await ask(daemon, 'POST', '/v1/scenes?id=viewed', { from: 'example:first-steps' });
await ask(daemon, 'POST', '/v1/scenes?id=other', { from: 'example:snowman' });
const children = Array.from({ length: 5500 }, (_, i) => ({ id: `n${i}`, type: 'sphere', visible: i === 0 }));
await ask(daemon, 'POST', '/v1/scenes?id=many', { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
const live = await Live.open(daemon, 'viewed');
live.look(VIEW);
await live.nextFrame((frame) => frame.lossless);
await waits(live, 2);

/** The status of an answer to a client at another address. */
const statusOf = (at) =>
    new Promise((done, fail) => {
        http.get(daemon.url + at, { localAddress: '127.0.0.2' }, (answer) => answer.resume().on('end', () => done(answer.statusCode))).on('error', fail);
    });

/** Milliseconds of pictures of 64×48, one after the other. */
async function pictures(round) {
    const times = [];
    for (let i = 0; i < PICTURES; i += 1) {
        const start = Date.now();
        const status = await statusOf(`/v1/scenes/viewed/image.png?width=64&height=48&camera.fov=${20 + i + round / 100}`);
        times.push(status === 200 ? Date.now() - start : Infinity);
    }
    return times;
}

/** Each stage of a frame, alone and beside; what remains is `else`. */
const stagesOf = (both, share) =>
    Object.fromEntries(
        STAGES.map((name, i) => [
            name,
            Object.values(both).map((pictures) =>
                round(percentile(pictures.map(({ ms, stages }) => stages[i] ?? ms - stages.reduce((sum, one) => sum + one, 0)), share)),
            ),
        ]),
    );

const results = {};
let asked = 0;
for (const name of Object.keys(GUESTS).filter((one) => wanted.length === 0 || wanted.some((word) => one.includes(word)))) {
    console.error(`guests: ${name}`);
    const restarts = await counter(daemon, 'worker_restarts_total');
    const rounds = [];
    for (let i = 0; i < ROUNDS; i += 1) {
        const alone = await waits(live, SECONDS);
        const leave = await come(name);
        await sleep(500);
        const beside = await waits(live, SECONDS);
        const small = await pictures((asked += 1));
        await leave();
        await sleep(500);
        rounds.push({ alone, beside, small });
    }
    const all = (what) => rounds.flatMap((one) => one[what]);
    const ms = (pictures) => pictures.map((one) => one.ms);
    const ratio = ({ beside, alone }, share) => percentile(ms(beside), share) / percentile(ms(alone), share);
    const together = { alone: all('alone'), beside: all('beside') };
    const figures = (share) => ({
        alone_ms: round(percentile(ms(together.alone), share)),
        beside_ms: round(percentile(ms(together.beside), share)),
        ratio: round(ratio(together, share)),
        median_ratio: round(percentile(rounds.map((one) => ratio(one, share)), 0.5)),
    });
    results[name] = {
        p50: figures(0.5),
        p99: figures(0.99),
        stages_ms: { p50: stagesOf(together, 0.5), p99: stagesOf(together, 0.99) },
        picture_ms: { median: percentile(all('small'), 0.5), most: Math.max(...all('small')) },
        restarts: (await counter(daemon, 'worker_restarts_total')) - restarts,
    };
    console.error(JSON.stringify(results[name]));
}
const missed = Object.entries(results).flatMap(([name, { p99, picture_ms: picture, restarts }]) => [
    ...(p99.median_ratio > MOST_RATIO ? [`${name}: the 99th of a hundred ${p99.median_ratio} times as long`] : []),
    ...(picture.most > MOST_PICTURE_MS ? [`${name}: a picture of 64×48 after ${picture.most} ms`] : []),
    ...(restarts > MOST_RESTARTS ? [`${name}: ${restarts} workers lost`] : []),
]);
console.log(JSON.stringify({ results, missed }, null, 2));
await live.close();
await daemon.stop();
process.exit(missed.length > 0 ? 1 : 0);
