// SPDX-License-Identifier: MIT
// Guides: which node each pixel of a view at rest shows, and how far it is, for those clients alone that want to know.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { ask, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { readNpy } from '../support/npy.mjs';

const SIZE = { width: 96, height: 64 };
const CAMERA = { position: [1, 2, 6], target: [0, 0, 0] };
const ball = (id, x, radius = 1) => ({ id, type: 'sphere', params: { radius }, transform: { translation: [x, 0, 0] } });
const DOCUMENT = {
    format: 'fieldcast/1',
    environment: { floor: true, floor_height: -1.2 },
    models: { lamp: { id: 'part', type: 'torus' } },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'bitten', type: 'difference', children: [ball('body', -1.2), ball('bite', -0.6, 0.7)] },
            { id: 'soft', type: 'smooth_union', params: { k: 0.5 }, children: [ball('left', 0.8, 0.6), ball('right', 1.6, 0.6)] },
            { id: 'instance', type: 'model', params: { model: 'lamp' }, transform: { translation: [0, 1.4, 0] } },
        ],
    },
};

let daemon;
before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
});
after(() => daemon.stop());

const STEP = 4;

/** The distances of every fourth pixel of every fourth row, as protocol/README.md tells. */
function readDepths(bytes, nearest, farthest, width) {
    const count = bytes.length / 2;
    const depths = new Uint16Array(count);
    for (let i = 0; i < count; i += 1) {
        const folded = bytes[i] + 256 * bytes[count + i];
        const at = (dx, dy) => ((i % width) + dx < 0 ? 0 : (depths[i + dx + dy * width] ?? 0));
        depths[i] = at(-1, 0) + at(0, -1) - at(-1, -1) + (folded % 2 ? -(folded + 1) / 2 : folded / 2);
    }
    return Array.from(depths, (depth) => (depth === 0 ? Infinity : farthest * (nearest / farthest) ** ((depth - 1) / 65534)));
}

/** {ids, indices, distances}: of indices 0 is no node, else the index into `ids` plus one. */
function readGuide({ payload, width, height }) {
    const ids = [];
    let at = 2;
    for (let count = payload.readUInt16LE(0); count > 0; count -= 1) {
        const end = at + 1 + payload[at];
        ids.push(payload.subarray(at + 1, end).toString());
        at = end;
    }
    const [nearest, farthest] = [payload.readFloatLE(at), payload.readFloatLE(at + 4)];
    const bytes = zlib.inflateSync(payload.subarray(at + 8));
    const [across, down] = [width, height].map((side) => Math.ceil(side / STEP));
    assert.equal(bytes.length, 2 * (width * height + across * down));
    const distances = readDepths(bytes.subarray(2 * width * height), nearest, farthest, across);
    const indices = Array.from({ length: width * height }, (_, i) => bytes.readUInt16LE(2 * i));
    assert.ok(indices.every((index) => index <= ids.length));
    return { ids, indices, distances, across, nodeAt: (x, y) => ids[indices[y * width + x] - 1] ?? null };
}

const guideOf = (live, seq, from = 0) => live.nextFrame((frame) => frame.codec === 'guide' && frame.seq === seq, from);
const settled = (live, seq, from = 0) => live.nextFrame((frame) => frame.lossless && frame.seq === seq, from);

test('a guide has the ids of the output of that name, and names what a pick names', async () => {
    const live = await Live.open(daemon, 's');
    const seq = live.look({ ...SIZE, camera: CAMERA, guides: true });
    const frame = await guideOf(live, seq);
    const guide = readGuide(frame);
    assert.deepEqual([frame.width, frame.height, frame.still, frame.lossless], [96, 64, true, false]);
    const last = await settled(live, seq);
    assert.deepEqual([frame.revision, frame.viewWidth, frame.viewHeight], [last.revision, 96, 64]);
    const answer = await fetch(
        `${daemon.url}/v1/scenes/s/image.npy?aov=id&width=96&height=64&camera.position=1,2,6&camera.target=0,0,0`,
    );
    const { values } = readNpy(Buffer.from(await answer.arrayBuffer()));
    const byNumber = new Map();
    for (const [i, number] of values.entries()) {
        const id = guide.ids[guide.indices[i] - 1] ?? null;
        assert.equal(byNumber.get(number) ?? id, id, `pixel ${i} has the number ${number}`);
        byNumber.set(number, id);
    }
    assert.equal(byNumber.get(0), null);
    const seen = [...byNumber.values()].filter((id) => id !== null);
    assert.equal(new Set(seen).size, seen.length, 'one number a node');
    assert.deepEqual(seen.sort(), [...guide.ids].sort());
    assert.deepEqual(['bite', 'body', 'instance', 'left', 'right'].filter((id) => !guide.ids.includes(id)), []);
    // Inside of a part: at its edge a pixel and a pick may differ.
    let compared = 0;
    for (let i = 0; i < 1200; i += 1) {
        const [x, y] = [2 + ((i * 37) % 92), 2 + ((i * 23) % 60)];
        const node = guide.nodeAt(x, y);
        const around = [-1, 0, 1].flatMap((dx) => [-1, 0, 1].map((dy) => guide.nodeAt(x + dx, y + dy)));
        if (node === null || around.some((other) => other !== node)) {
            continue;
        }
        live.say({ type: 'pick', pick: i + 1, x: x + 0.5, y: y + 0.5, seq });
        assert.equal((await live.next('picked', { pick: i + 1 })).node, node, `at ${x}, ${y}`);
        compared += 1;
    }
    assert.ok(compared >= 60, `${compared} pixels`);
    await live.close();
});

test('the distances of a guide are those of the output of that name, and of a pick', async () => {
    const live = await Live.open(daemon, 's');
    const seq = live.look({ ...SIZE, camera: CAMERA, guides: true });
    const frame = await guideOf(live, seq);
    const { distances, across } = readGuide(frame);
    await settled(live, seq);
    const answer = await fetch(
        `${daemon.url}/v1/scenes/s/image.npy?aov=depth&width=96&height=64&camera.position=1,2,6&camera.target=0,0,0`,
    );
    const { values } = readNpy(Buffer.from(await answer.arrayBuffer()));
    const [hit, missed] = [distances.filter(Number.isFinite), distances.filter((far) => far === Infinity)];
    assert.ok(hit.length > 150 && missed.length > 30, `${hit.length} hit, ${missed.length} missed`);
    /* A half step of the logarithm, and what floats make of it. */
    const room = Math.log(Math.max(...hit) / Math.min(...hit)) / 65534 / 2 + 1e-5;
    const seldom = [];
    for (const [i, far] of distances.entries()) {
        const [x, y] = [STEP * (i % across), STEP * Math.floor(i / across)];
        const wanted = values[y * 96 + x];
        assert.equal(Number.isFinite(far), Number.isFinite(wanted), `at ${x}, ${y}`);
        if (!Number.isFinite(far)) {
            continue;
        }
        assert.ok(Math.abs(Math.log(far / wanted)) <= room, `${far}, not ${wanted}, at ${x}, ${y}`);
        live.say({ type: 'pick', pick: i + 1, x: x + 0.5, y: y + 0.5, seq });
        const { distance } = await live.next('picked', { pick: i + 1 });
        if (distance === null || Math.abs(Math.log(far / distance)) > 2e-3) {
            seldom.push({ x, y, far, distance });
        }
    }
    assert.ok(seldom.length <= hit.length / 50, `${JSON.stringify(seldom)}: an edge may run through a pixel`);
    await live.close();
});

test('who does not ask gets none, and who stops asking no more', async () => {
    const live = await Live.open(daemon, 's');
    await settled(live, live.look({ ...SIZE }));
    assert.equal(live.frames.filter(({ codec }) => codec === 'guide').length, 0);
    const asked = live.look({ ...SIZE, guides: true });
    await settled(live, asked);
    assert.equal(live.frames.filter(({ codec }) => codec === 'guide').length, 1);
    await settled(live, live.look({ ...SIZE, camera: CAMERA }));
    assert.equal(live.frames.filter(({ codec }) => codec === 'guide').length, 1);
    await live.close();
});

test('an edit is followed by a guide of the new revision', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=edited', DOCUMENT);
    const live = await Live.open(daemon, 'edited');
    const seq = live.look({ ...SIZE, camera: CAMERA, guides: true });
    const before = await guideOf(live, seq);
    const from = live.frames.length;
    live.set('/nodes/body/visible', false);
    const after = await live.nextFrame((frame) => frame.codec === 'guide' && frame.revision > before.revision, from);
    assert.ok(readGuide(before).ids.includes('body'));
    assert.ok(!readGuide(after).ids.includes('body'));
    await live.close();
});

test('of isolated nodes no other is named', async () => {
    const live = await Live.open(daemon, 's');
    const seq = live.look({ ...SIZE, camera: CAMERA, guides: true, isolate: ['soft'] });
    assert.deepEqual(readGuide(await guideOf(live, seq)).ids.sort(), ['left', 'right']);
    await live.close();
});

test('the guide of a large view is smaller than that, and small in bytes', async () => {
    const live = await Live.open(daemon, 's');
    const seq = live.look({ width: 2048, height: 1024, camera: CAMERA, guides: true });
    const frame = await guideOf(live, seq);
    assert.deepEqual([frame.viewWidth, frame.viewHeight], [2048, 1024]);
    assert.ok(frame.width * frame.height <= 1048576 * 1.01 && frame.width * frame.height > 1000000);
    assert.equal(Math.round(frame.width / 2048 * 1024), frame.height);
    assert.ok(frame.bytes < 60000, `${frame.bytes} bytes`);
    console.log(`a guide of ${frame.width} x ${frame.height}: ${frame.bytes} bytes`);
    await live.close();
});
