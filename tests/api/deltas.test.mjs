// SPDX-License-Identifier: MIT
// Deltas: after an edit of something small a client that takes them gets the squares of the picture
// that have changed, and what it puts together is the whole picture.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ask, sleep, startDaemon, until } from '../support/daemon.mjs';
import { Composer, readDelta } from '../support/deltas.mjs';
import { Live } from '../support/live.mjs';
import { decodePng } from '../support/png.mjs';

const SIZE = { width: 330, height: 250 }; // no whole squares
const MOST = 0.3; // of the bytes of whole frames
const SIDE = 32;
const MOVED = '/nodes/s500/transform/translation';

const spheres = Array.from({ length: 1000 }, (_, i) => ({
    id: `s${i}`,
    type: 'sphere',
    transform: { translation: [((i % SIDE) / SIDE - 0.5) * 6, 0, (Math.floor(i / SIDE) / SIDE - 0.5) * 6], scale: 2 / SIDE },
}));
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: [0, 3, 6], target: [0, 0, 0] },
    lights: [{ id: 'sun', type: 'directional', direction: [-0.5, -1, -0.3] }],
    root: { id: 'root', type: 'union', children: [{ id: 'floor', type: 'plane' }, ...spheres] },
};

let daemon;
before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
});
after(() => daemon.stop());

const isFinal = (frame, revision) => frame.lossless && !frame.stale && frame.revision >= revision;

/** A client that puts together what it gets: `live.shown` is the last lossless picture. */
async function open() {
    const live = await Live.open(daemon, 's');
    const composer = new Composer();
    live.onFrame = (frame) => {
        if (frame.codec !== 'guide') {
            const picture = composer.take(frame);
            live.shown = frame.lossless ? { ...frame, picture: { ...picture, pixels: Buffer.from(picture.pixels) } } : live.shown;
        }
    };
    return live;
}

/** Once the last picture of a revision is there. */
const settled = (live, revision) =>
    until(() => live.shown?.seq === live.seq && isFinal(live.shown, revision) && live.shown, `the last picture of ${revision}`);

/** Moves a shape a little; answers the revision. */
async function move(live, places, at = MOVED) {
    const from = live.messages.length;
    places.forEach((x) => live.set(at, [x, 0.02, 0.1]));
    return (await live.next('applied', { edit: live.edit }, from)).revision;
}

const wholePicture = async ({ width, height }) =>
    decodePng(Buffer.from(await (await fetch(`${daemon.url}/v1/scenes/s/image.png?width=${width}&height=${height}`)).arrayBuffer()));

/** Which pixels differ, few of them. */
function assertSame(got, want, what) {
    assert.deepEqual([got.width, got.height, got.channels], [want.width, want.height, want.channels]);
    const wrong = [];
    for (let i = 0; i < want.pixels.length; i += want.channels) {
        if (got.pixels.compare(want.pixels, i, i + want.channels, i, i + want.channels) !== 0) {
            wrong.push([(i / want.channels) % want.width, Math.floor(i / want.channels / want.width)]);
        }
    }
    assert.equal(wrong.length, 0, `${what}: ${wrong.length} pixels, ${JSON.stringify(wrong.slice(0, 9))}`);
}

const bytesOf = (frames) => frames.reduce((sum, { bytes }) => sum + bytes, 0);

test('a move of one of 1,000 shapes sends little, and the picture put together is the whole one', async () => {
    const [live, whole] = [await open(), await open()];
    live.look({ ...SIZE, deltas: true });
    whole.look(SIZE);
    await Promise.all([settled(live, 1), settled(whole, 1)]);
    // The first edit of a view finds a moving picture of another size, or none.
    await settled(live, await move(live, [0.4]));
    await settled(whole, live.shown.revision);
    const [from, wholeFrom] = [live.frames.length, whole.frames.length];
    const revision = await move(live, [0.41]);
    const [got, want] = await Promise.all([settled(live, revision), settled(whole, revision)]);
    const rest = await wholePicture(SIZE);
    assertSame(want.picture, rest, 'the whole frame');
    assertSame(got.picture, rest, 'the difference');
    // A moving picture may have got another size by now.
    assert.deepEqual(live.frames.slice(from).filter(({ still, delta }) => still && !delta), []);
    assert.ok(got.delta && readDelta(got.payload).squares.length > 0);
    for (const [kind, pick] of [['still', ({ still, lossless }) => still && !lossless], ['lossless', ({ lossless }) => lossless]]) {
        const [part, all] = [live.frames.slice(from), whole.frames.slice(wholeFrom)].map((frames) => bytesOf(frames.filter(pick)));
        console.log(`${kind}: ${part} of ${all} bytes`);
        assert.ok(part <= MOST * all, `${kind}: ${part} of ${all} bytes`);
    }
    await Promise.all([live.close(), whole.close()]);
});

test('who does not ask gets whole pictures alone, of no chain', async () => {
    const live = await open();
    live.look(SIZE);
    await settled(live, 1);
    await settled(live, await move(live, [0.42, 0.43]));
    assert.deepEqual(live.frames.filter(({ delta, chain, link }) => delta || chain || link), []);
    await live.close();
});

test('another view, another size and another output begin with whole pictures', async () => {
    const live = await open();
    const views = [SIZE, { ...SIZE, camera: { position: [1, 3, 6] } }, { width: 120, height: 90 }, { width: 120, height: 90, aov: 'normal' }];
    for (const view of views) {
        const from = live.frames.length;
        live.look({ ...view, deltas: true });
        await settled(live, 1);
        assert.deepEqual(live.frames.slice(from).filter(({ delta }) => delta), []);
        const { number } = live.shown;
        await settled(live, await move(live, [0.4 + from / 1000]));
        assert.ok(live.frames.some((frame) => frame.delta && frame.number > number), 'a difference after the edit');
    }
    await live.close();
});

test('an edit that nobody sees sends next to nothing', async () => {
    const live = await open();
    live.look({ ...SIZE, deltas: true });
    await settled(live, 1);
    await settled(live, await move(live, [0.4], '/nodes/s1/transform/translation'));
    const from = live.frames.length;
    const applied = await live.next('applied', { edit: live.set('/nodes/s1/name', 'first') }, live.messages.length);
    await settled(live, applied.revision);
    const still = live.frames.slice(from).filter((frame) => frame.still);
    assert.deepEqual(new Set(still.map(({ bytes }) => bytes)), new Set([2]));
    await live.close();
});

test('a client that reads now and then puts together the right picture', async () => {
    const large = { width: 800, height: 600 };
    const live = await open();
    live.look({ ...large, deltas: true });
    await settled(live, 1);
    for (let turn = 0; turn < 4; turn += 1) {
        live.stopReading();
        for (let i = 0; i < 8; i += 1) {
            live.set('/camera/position', [(turn * 8 + i) / 50, 3, 6]); // changes all, and is no view
            live.set(MOVED, [0.4 + i / 100, 0.1, 0.1]);
            live.acknowledge(live.frames.at(-1).number + i); // blindly
            await sleep(60 * i);
        }
        const newest = live.frames.at(-1).number;
        live.goOnReading();
        await until(() => live.frames.at(-1).number > newest, 'another frame');
    }
    const got = await settled(live, await move(live, [0.5]));
    assertSame(got.picture, await wholePicture(large), 'the picture');
    assert.ok(live.frames.some(({ delta }) => delta));
    await live.close();
});

test('a new render process begins with whole pictures', async () => {
    const live = await open();
    live.look({ ...SIZE, deltas: true });
    await settled(live, 1);
    await settled(live, await move(live, [0.3]));
    const worker = daemon.worker();
    process.kill(worker, 'SIGKILL');
    await until(() => daemon.worker() && daemon.worker() !== worker, 'another worker');
    const from = live.frames.length;
    const revision = await move(live, [0.31]);
    const got = await settled(live, revision);
    assert.ok(live.frames.slice(from).some(({ delta }) => !delta));
    assertSame(got.picture, await wholePicture(SIZE), 'the picture');
    const next = await settled(live, await move(live, [0.32]));
    assert.ok(next.delta);
    assertSame(next.picture, await wholePicture(SIZE), 'the picture');
    await live.close();
});

test('the poster is the whole picture though the frame was none', async () => {
    const live = await open();
    live.look({ ...SIZE, deltas: true });
    await settled(live, 1);
    await settled(live, await move(live, [0.35]));
    const first = live.frames.findLast(({ still, lossless, codec }) => still && !lossless && codec === 'jpeg');
    assert.ok(first.delta);
    const poster = Buffer.from(await (await fetch(`${daemon.url}/v1/scenes/s/poster.jpg`)).arrayBuffer());
    assert.deepEqual([...poster.subarray(0, 2), ...poster.subarray(-2)], [0xff, 0xd8, 0xff, 0xd9]);
    const whole = await open();
    whole.look(SIZE);
    const { payload } = await whole.nextFrame(({ still, lossless, codec }) => still && !lossless && codec === 'jpeg');
    assert.deepEqual(poster, payload);
    await Promise.all([live.close(), whole.close()]);
});
