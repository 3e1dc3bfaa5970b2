// SPDX-License-Identifier: MIT
// Depths: how far the pixels of a moving view are, behind the picture's bytes, for those clients alone
// that want to know.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';
import { after, before, test } from 'node:test';
import { ask, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { readNpy } from '../support/npy.mjs';

const CAMERA = { position: [1, 2, 6], target: [0, 0, 0] };
const VALUES = 'camera.position=1,2,6&camera.target=0,0,0';
const ball = (id, x, radius = 1) => ({ id, type: 'sphere', params: { radius }, transform: { translation: [x, 0, 0] } });
const DOCUMENT = {
    format: 'fieldcast/1',
    environment: { floor: true, floor_height: -1.2 },
    root: { id: 'root', type: 'union', children: [ball('left', -1.2), ball('right', 1.4, 0.7)] },
};

let daemon;
before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
});
after(() => daemon.stop());

/** {picture, side, across, down, nearest, depths}, as protocol/README.md tells. */
function readDepths({ payload, width, height }) {
    const end = payload.length - 10;
    const start = end - payload.readUInt32LE(end + 6);
    const side = payload.readUInt16LE(end + 4);
    const [across, down] = [width, height].map((pixels) => Math.ceil(pixels / side));
    const plain = zlib.inflateSync(payload.subarray(start, end));
    assert.equal(plain.length, across * down);
    const depths = new Uint8Array(plain.length);
    for (let i = 0; i < depths.length; i += 1) {
        const at = (dx, dy) => ((i % across) + dx < 0 ? 0 : (depths[i + dx + dy * across] ?? 0));
        depths[i] = plain[i] + at(-1, 0) + at(0, -1) - at(-1, -1);
    }
    return { picture: payload.subarray(0, start), side, across, down, nearest: payload.readFloatLE(end), depths };
}

const settled = (live, seq) => live.nextFrame((frame) => frame.lossless && frame.seq === seq);

async function distancesOf({ width, height }) {
    const answer = await fetch(`${daemon.url}/v1/scenes/s/image.npy?aov=depth&width=${width}&height=${height}&${VALUES}`);
    return readNpy(Buffer.from(await answer.arrayBuffer())).values;
}

/** Blocks whose depth is none of what is up to four pixels around them; those at the border know more. */
function countWrong({ side, across, depths, nearest }, values, { width, height }) {
    let wrong = 0;
    for (const [i, depth] of depths.entries()) {
        const [left, top] = [side * (i % across), side * Math.floor(i / across)];
        if (left < 4 || top < 4 || left + side + 4 > width || top + side + 4 > height) {
            continue;
        }
        const around = [];
        for (let y = top - 4; y < top + side + 4; y += 1) {
            for (let x = left - 4; x < left + side + 4; x += 1) {
                around.push((255 * nearest) / values[y * width + x]);
            }
        }
        wrong += depth < Math.min(...around) - 0.51 || depth > Math.max(...around) + 0.51;
    }
    return wrong;
}

for (const [width, height, side] of [[96, 64, 1], [640, 360, 4]]) {
    test(`blocks of ${side} pixels to a side have the depths of the output of that name`, async () => {
        const live = await Live.open(daemon, 's');
        const seq = live.look({ width, height, camera: CAMERA, quality: 'sharp', depths: true });
        const frame = await live.nextFrame(({ depths }) => depths);
        assert.deepEqual([frame.seq, frame.codec, frame.still], [seq, 'jpeg', false]);
        const told = readDepths(frame);
        assert.deepEqual([...told.picture.subarray(0, 2), ...told.picture.subarray(-2)], [0xff, 0xd8, 0xff, 0xd9]);
        if (frame.width === width) {
            assert.equal(told.side, side);
        }
        const values = await distancesOf(frame);
        const least = values.reduce((a, b) => Math.min(a, b));
        assert.ok(Math.abs(told.nearest / least - 1) < 0.02, `${told.nearest}, not ${least}`);
        assert.ok(told.depths.includes(0) && told.depths.includes(255));
        assert.ok(new Set(told.depths).size > 60, `${new Set(told.depths).size} depths`);
        const wrong = countWrong(told, values, frame);
        assert.ok(wrong <= told.depths.length / 200, `${wrong} of ${told.depths.length}`);
        const bytes = frame.bytes - told.picture.length;
        console.log(`depths of ${told.across} x ${told.down}: ${bytes} bytes`);
        assert.ok(bytes < 6000, `${bytes} bytes`);
        await live.close();
    });
}

test('a picture at rest has none, nor has one of another output, nor one for who does not ask', async () => {
    const live = await Live.open(daemon, 's');
    const size = { width: 96, height: 64 };
    await settled(live, live.look({ ...size, depths: true }));
    assert.ok(live.frames[0].depths);
    assert.deepEqual(live.frames.filter(({ still, depths }) => still && depths), []);
    const from = live.frames.length;
    await settled(live, live.look({ ...size, camera: CAMERA }));
    await settled(live, live.look({ ...size, camera: CAMERA, aov: 'normal', depths: true }));
    assert.deepEqual(live.frames.slice(from).filter(({ depths }) => depths), []);
    await live.close();
});

test('who asks for them later has them with the next picture, and causes none', async () => {
    const live = await Live.open(daemon, 's');
    const size = { width: 96, height: 64 };
    await settled(live, live.look(size));
    const from = live.frames.length;
    live.look({ ...size, depths: true });
    await settled(live, live.look({ ...size, camera: CAMERA, depths: true }));
    assert.deepEqual(live.frames.slice(from).filter(({ seq }) => seq === 2), []);
    assert.ok(live.frames[from].depths);
    await live.close();
});
