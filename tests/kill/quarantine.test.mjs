// SPDX-License-Identifier: MIT
// A driver that hangs, crashes or eats memory over the code of one scene: its author is told, it is
// shown as it was before, and others see at most a short pause.
import assert from 'node:assert/strict';
import path from 'node:path';
import { after, before, test } from 'node:test';
import {
    ask,
    counter,
    driverEnvironment,
    makeDirectory,
    program,
    removeDirectory,
    startDaemon,
    until,
} from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const driver = path.join(path.dirname(program), 'tests/kill/hostile_driver.so');
const CODE = '/primitives/blob/code';
const ball = (radius) => `float sdf(vec3 p) { return length(p) - ${radius} * blow; }`;
const GOOD = ball('1.0');
const HANG = ball('31337.5');
const CRASH = ball('31338.5');
const EAT = ball('31339.5');
const CRASH_LATER = ball('31340.5');
const SLEEP_LATER = ball('31346.5');

const scene = (code) => ({
    format: 'fieldcast/1',
    lights: [{ id: 'sun', type: 'directional' }],
    primitives: { blob: { params: [{ name: 'blow', type: 'float', default: 1 }], code } },
    root: { id: 'root', type: 'union', children: [{ id: 'b', type: 'field', params: { primitive: 'blob' } }] },
});

/** With the driver in front of one that draws nothing: nobody looks at a pixel here. */
function start(options) {
    const { LD_PRELOAD, ...environment } = driverEnvironment('null');
    return startDaemon({ ...options, environment: { ...environment, LD_PRELOAD: `${driver} ${LD_PRELOAD}` } });
}

let daemon;
let viewer; // of a scene that has nothing to do with it
before(async () => {
    daemon = await start({ args: ['--worker-memory', '512'] });
    await ask(daemon, 'POST', '/v1/scenes?id=other', {
        format: 'fieldcast/1',
        root: { id: 'ball', type: 'sphere' },
    });
    viewer = await Live.open(daemon, 'other');
    viewer.look();
    await viewer.nextFrame((frame) => frame.lossless);
});
after(async () => {
    await viewer?.close();
    await daemon?.stop();
});

/** The other scene is edited and its picture follows. */
async function othersGoOn() {
    const edit = viewer.set('/nodes/ball/params/radius', 0.3 + Math.random());
    const { revision } = await viewer.next('applied', { edit });
    await viewer.nextFrame((frame) => frame.lossless && frame.revision === revision);
    assert.equal(viewer.closed, false);
    assert.ok(!viewer.find('notice', { level: 'error' }), 'others hear of no error');
}

async function open(id, code = GOOD) {
    await ask(daemon, 'POST', `/v1/scenes?id=${id}`, scene(code));
    const live = await Live.open(daemon, id);
    live.look();
    return live;
}

const isOver = (live, from) => live.next('notice', { code: 'compiled', place: CODE }, from);

// A crash has a sure cause; who aborts for want of memory may not have taken it.
for (const [what, workers, code, ...whys] of [
    ['hangs', 2, HANG, 'too_slow'],
    ['crashes', 1, CRASH, 'crashed'],
    ['eats memory', 2, EAT, 'crashed', 'too_slow'], // whichever comes first
]) {
    test(`a compiler that ${what}`, async (t) => {
        const live = await open(what.replace(' ', '-'));
        await live.nextFrame((frame) => frame.lossless && frame.revision === 1);
        const restarts = await counter(daemon, 'worker_restarts_total');
        const asked = Date.now();
        live.set(CODE, code);
        const notice = await live.next('notice', { level: 'error' });
        t.diagnostic(`told after ${notice.at - asked} ms`);
        const why = notice.code;
        assert.ok(whys.includes(why), why);
        assert.equal(notice.place, CODE);
        assert.equal(notice.line, undefined);
        assert.match(notice.message, /The last picture stays/);

        // The next worker has the state before.
        const from = live.frames.length;
        live.look({ width: 80, height: 48 });
        const frame = await live.nextFrame((one) => one.viewWidth === 80, from);
        assert.equal(frame.revision, 1);
        assert.equal(frame.stale, true);
        await othersGoOn();

        // Who comes later is told; a number changes nothing; a picture of it is refused.
        const late = await Live.open(daemon, live.welcome.scene);
        assert.equal((await late.next('notice', { code: why })).place, CODE);
        await late.close();
        const messages = live.messages.length;
        const edit = live.set('/nodes/b/params/blow', 0.5);
        await live.next('applied', { edit, durable: true });
        await until(async () => {
            const answer = await fetch(`${daemon.url}/v1/scenes/${live.welcome.scene}/image.png?width=8&height=8`);
            const problem = await answer.json();
            assert.equal(answer.status, 503);
            assert.equal(problem.code, why);
            return problem.place === CODE;
        }, 'the refusal');
        assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + workers, 'no more workers');
        assert.ok(!live.find('notice', { code: why }, messages), 'told once');

        // Edited, it is drawn again.
        const cured = live.set(CODE, ball('0.5'));
        await isOver(live, messages);
        const { revision } = await live.next('applied', { edit: cured });
        await live.nextFrame((one) => one.lossless && one.revision === revision);
        await live.close();
    });
}

test('undo takes it back too, and a document put in place is no other road', async () => {
    const live = await open('undone');
    await live.nextFrame((frame) => frame.lossless);
    live.set(CODE, CRASH);
    await live.next('notice', { code: 'crashed' });
    live.step('undo');
    await isOver(live, 0);
    await live.nextFrame((frame) => frame.lossless && frame.revision === 3);

    const from = live.messages.length;
    const frames = live.frames.length;
    await ask(daemon, 'PUT', '/v1/scenes/undone', scene(`${CRASH} /* again */`));
    assert.equal((await live.next('notice', { level: 'error' }, from)).code, 'crashed');
    live.look({ width: 80, height: 48 });
    const frame = await live.nextFrame((one) => one.viewWidth === 80, frames);
    assert.equal(frame.revision, 3);
    await live.close();
});

test('without a state before, the device shows nothing until it is edited', async () => {
    const live = await open('from-the-start', `${CRASH} // from the start`);
    const notice = await live.next('notice', { code: 'crashed' });
    assert.match(notice.message, /not shown/);
    assert.ok(live.frames.every((frame) => !frame.lossless)); // the engine may, before it is compiled
    const edit = live.set(CODE, GOOD);
    await isOver(live, 0);
    const { revision } = await live.next('applied', { edit });
    await live.nextFrame((frame) => frame.lossless && frame.revision === revision);
    await live.close();
});

test('a document sent along with an order is answered', async () => {
    for (const [code, why] of [
        [CRASH, 'crashed'],
        [HANG, 'too_slow'],
    ]) {
        const answer = await fetch(`${daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'content-type': 'application/json' },
            body: JSON.stringify({ scene: scene(`${code} /* inline */`), width: 8, height: 8 }),
        });
        assert.equal(answer.status, 503);
        const problem = await answer.json();
        assert.equal(problem.code, why);
        assert.equal(problem.place, CODE);
    }
    await othersGoOn();
});

test('code that crashes while it draws is suspended', async () => {
    const restarts = await counter(daemon, 'worker_restarts_total');
    const live = await open('later', CRASH_LATER);
    await live.next('notice', { code: 'scene_left_out' });
    assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + 1, 'one worker only');
    await othersGoOn();
    const edit = live.set(CODE, GOOD);
    const { revision } = await live.next('applied', { edit });
    await live.nextFrame((frame) => frame.lossless && frame.revision === revision);
    await live.close();
});

test('a drawing thread that waits for nothing is found, although pings are answered', async () => {
    const live = await open('asleep', SLEEP_LATER);
    await live.next('notice', { code: 'scene_left_out' });
    await othersGoOn();
    await live.close();
});

for (const [what, workers] of [
    ['crash', 1],
    ['hang', 2],
]) {
    test(`a document that makes its reader ${what} is left out, others are drawn`, async () => {
        const children = Array.from({ length: 400 }, (_, i) => ({ id: `${what}-while-read-${i}`, type: 'sphere' }));
        const restarts = await counter(daemon, 'worker_restarts_total');
        await ask(daemon, 'POST', `/v1/scenes?id=read-${what}`, { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
        const live = await Live.open(daemon, `read-${what}`);
        live.look();
        await othersGoOn();
        await live.next('notice', { code: 'scene_left_out' });
        assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + workers, 'no more workers');
        assert.equal(live.frames.length, 0);
        await othersGoOn();
        await ask(daemon, 'PUT', `/v1/scenes/read-${what}`, scene(GOOD));
        await live.nextFrame((frame) => frame.lossless && frame.revision === 2);
        await live.close();
    });
}

/** A picture of the root, drawn by the engine. */
async function thumbnailOf(live) {
    live.say({ type: 'thumbnails', nodes: ['root'] });
    return (await until(() => live.thumbnails[0], 'the thumbnail')).png;
}

test('stored code is kept but not compiled where code is off', async () => {
    const data = makeDirectory();
    let other = await start({ data });
    await ask(other, 'POST', '/v1/scenes?id=kept', scene(CRASH));
    const before = await Live.open(other, 'kept');
    const drawn = await thumbnailOf(before);
    await before.close();
    await other.stop();
    other = await start({ data, args: ['--code', 'off'] });
    const live = await Live.open(other, 'kept');
    const notice = await live.next('notice', { code: 'code_off' });
    assert.equal(notice.level, 'warning');
    assert.equal(notice.place, CODE);
    const { document } = await live.next('document');
    assert.equal(document.primitives.blob.code, CRASH);
    live.look();
    await live.nextFrame((frame) => frame.lossless);
    assert.ok(!(await thumbnailOf(live)).equals(drawn), 'the engine that draws thumbnails gets no code either');
    live.set(CODE, GOOD);
    assert.equal((await live.next('rejected')).code, 'forbidden');
    // What takes code away comes back by undo, still without being compiled.
    live.set(CODE, '');
    live.step('undo');
    const { revision } = await live.next('changed', { edit: live.edit });
    await live.nextFrame((frame) => frame.lossless && frame.revision === revision);
    assert.equal(await counter(other, 'worker_restarts_total'), 0);
    await live.close();
    await other.stop();
    removeDirectory(data);
});
