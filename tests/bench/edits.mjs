// SPDX-License-Identifier: MIT
// From the bytes of an edit to those of the first picture that shows it, over a live connection on
// loopback, by kind of edit and size of the scene. Prints one JSON object: milliseconds, and how much
// longer than a picture of another view of the edited scene ("picture_ms", the median; "over_ms", of the
// 95th percentile). Then what one small move sends, as whole pictures and as differences by turns:
// medians of the bytes of each kind of picture, and of the milliseconds until it is there.
import { ask, removeDirectory, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const NODES = [20, 300, 10000];
const TIMES = 20;
const VIEW = { width: 640, height: 360 };

const percentile = (values, share) => {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
};
const round = (x) => Math.round(x * 10) / 10;

const SHAPES = ['sphere', 'box', 'torus', 'capsule'];

/** As many shapes on a floor, in rows. */
function field(nodes) {
    const side = Math.ceil(Math.sqrt(nodes - 2));
    const children = Array.from({ length: nodes - 2 }, (_, i) => ({
        id: `s${i}`,
        type: SHAPES[i % SHAPES.length],
        transform: {
            translation: [((i % side) / side - 0.5) * 6, 0, (Math.floor(i / side) / side - 0.5) * 6],
            scale: 2 / side,
        },
    }));
    return {
        format: 'fieldcast/1',
        camera: { position: [0, 3, 6], target: [0, 0, 0] },
        lights: [{ id: 'sun', type: 'directional', direction: [-0.5, -1, -0.3] }],
        root: { id: 'root', type: 'union', children: [{ id: 'floor', type: 'plane' }, ...children] },
    };
}

/** Milliseconds until a frame passes the test, from `act` on, which sends something. */
async function timed(live, act, passes) {
    const seen = new Promise((done) => {
        live.onFrame = (frame) => passes(frame) && done(performance.now());
    });
    const start = performance.now();
    act();
    const at = await seen;
    live.onFrame = null;
    return at - start;
}

const insert = (i) => ({
    op: 'insert',
    into: '/nodes/root',
    before: null,
    value: { id: `n${i}`, type: 'sphere', transform: { translation: [0, 1, 0], scale: 0.3 } },
});

/** What each kind of edit sends; the first of `turns` comes before the second. */
const KINDS = {
    numeric: (live, i) => live.set('/nodes/s3/transform/translation', [0, 0.1 + i / 40, 0]),
    hide: (live, i) => live.set('/nodes/s4/visible', i % 2 === 1),
    structural: (live, i) => live.change(i % 2 ? [{ op: 'remove', at: `/nodes/n${i - 1}` }] : [insert(i)]),
    undo: (live, i) => live.step(i % 2 ? 'redo' : 'undo'),
};

/** The scene from another place than before. */
function lookElsewhere(live, i, more = {}) {
    const camera = { position: [i / 20, 3, 6] };
    return timed(live, () => live.look({ ...VIEW, camera, ...more }), (frame) => frame.seq === live.seq);
}

async function measureKinds(live) {
    const rows = {};
    let revision = 1;
    const add = (kind, edits, views) => {
        const [picture, p95] = [percentile(views, 0.5), percentile(edits, 0.95)];
        const all = { picture_ms: picture, p50_ms: percentile(edits, 0.5), p95_ms: p95, over_ms: p95 - picture };
        rows[kind] = Object.fromEntries(Object.entries(all).map(([name, ms]) => [name, round(ms)]));
    };

    for (const [kind, send] of Object.entries(KINDS)) {
        const [edits, views] = [[], []];
        for (let i = 0; i < TIMES; i += 1) {
            revision += 1;
            edits.push(await timed(live, () => send(live, i), (frame) => frame.revision >= revision && !frame.stale));
            views.push(await lookElsewhere(live, i));
        }
        add(kind, edits, views);
    }
    const [isolations, views] = [[], []];
    for (let i = 0; i < TIMES; i += 1) {
        const isolate = i % 2 ? [] : ['s5', 's6'];
        isolations.push(await timed(live, () => live.look({ ...VIEW, isolate }), (frame) => frame.seq === live.seq));
        views.push(await lookElsewhere(live, i, { isolate }));
    }
    add('isolate', isolations, views);
    return rows;
}

const MOVED_NODES = 1000;
const STAGES = {
    moving: (frame) => !frame.still,
    still: (frame) => frame.still && !frame.lossless && frame.codec === 'jpeg',
    lossless: (frame) => frame.lossless,
};

/** Moves a shape a little; waits for the last picture. Adds a row for each kind of picture. */
async function moveOnce(client, i) {
    const from = client.live.frames.length;
    client.revision += 1;
    const start = Date.now();
    client.live.set('/nodes/s500/transform/translation', [0.4 + i / 400, 0.1, 0]);
    await client.live.nextFrame((frame) => frame.lossless && frame.revision >= client.revision && !frame.stale, from);
    for (const [stage, passes] of Object.entries(STAGES)) {
        const frame = client.live.frames.slice(from).findLast(passes);
        if (frame) {
            client.rows[stage].push({ bytes: frame.bytes, ms: frame.at - start });
        }
    }
}

/** Two clients, each of a scene of its own, by turns. */
async function measureDeltas(daemon) {
    const clients = [];
    for (const deltas of [false, true]) {
        const id = `moved-${deltas}`;
        await ask(daemon, 'POST', `/v1/scenes?id=${id}`, field(MOVED_NODES));
        const live = await Live.open(daemon, id);
        live.look({ ...VIEW, ...(deltas ? { deltas } : {}) });
        await live.nextFrame((frame) => frame.lossless);
        clients.push({ live, revision: 1, rows: { moving: [], still: [], lossless: [] } });
    }
    for (let i = 0; i <= TIMES; i += 1) {
        for (const client of clients) {
            if (i === 1) {
                client.rows = { moving: [], still: [], lossless: [] }; // the first edit of a view
            }
            await moveOnce(client, i);
        }
    }
    const rows = {};
    for (const stage of Object.keys(STAGES)) {
        const middle = (member) => clients.map(({ rows: all }) => percentile(all[stage].map((row) => row[member]), 0.5));
        const [wholeBytes, bytes] = middle('bytes');
        const [wholeMs, ms] = middle('ms');
        rows[stage] = { whole_bytes: wholeBytes, bytes, part: Math.round((1000 * bytes) / wholeBytes) / 1000, whole_ms: round(wholeMs), ms: round(ms) };
    }
    await Promise.all(clients.map(({ live }) => live.close()));
    return { nodes: MOVED_NODES, ...rows };
}

const daemon = await startDaemon();
try {
    const runs = [];
    for (const nodes of NODES) {
        await ask(daemon, 'POST', `/v1/scenes?id=n${nodes}`, field(nodes));
        const live = await Live.open(daemon, `n${nodes}`);
        live.look(VIEW);
        await live.nextFrame((frame) => frame.lossless && frame.round + 1 >= frame.rounds);
        runs.push({ nodes, ...(await measureKinds(live)) });
        console.error(JSON.stringify(runs.at(-1)));
        await live.close();
    }
    console.log(JSON.stringify({ ...VIEW, runs, deltas: await measureDeltas(daemon) }));
} finally {
    await daemon.stop();
    removeDirectory(daemon.data);
}
