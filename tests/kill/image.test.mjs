// SPDX-License-Identifier: MIT
// Pictures of environments that are small files and large work, or end whoever reads them: others
// go on meanwhile.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, test } from 'node:test';
import {
    ask,
    counter,
    driverEnvironment,
    logged,
    makeDirectory,
    memoryOf,
    program,
    removeDirectory,
    sleep,
    startDaemon,
    until,
} from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { blankPng } from '../support/png.mjs';

const hostile = path.join(path.dirname(program), 'tests/kill/hostile_driver.so');
const SIDE = 5792; // its square is the most pixels that a file may have
const ROUNDS = 4;
const CALM_ROUNDS = 40;
const PLACE = '/environment/image';
const MIB = 1 << 20;

const scene = (image, rotation = 0) => ({
    format: 'fieldcast/1',
    environment: image ? { type: 'image', image, rotation } : {},
    root: { id: 'ball', type: 'sphere' },
});

const counts = makeDirectory();
after(() => removeDirectory(counts));

let daemon;
let viewer;

async function upload(width, height = width) {
    const body = blankPng(width, height);
    const answer = await fetch(`${daemon.url}/v1/assets`, {
        method: 'POST',
        body,
        headers: { 'content-type': 'image/png' },
    });
    assert.ok(answer.ok, await answer.clone().text());
    return { ...(await answer.json()), bytes: body.length };
}

const draw = (document) =>
    fetch(`${daemon.url}/v1/render`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify({ scene: document, width: 16, height: 16 }),
    });

async function start(driver, args = []) {
    const { LD_PRELOAD, ...environment } = driverEnvironment('null');
    Object.assign(process.env, environment);
    process.env.LD_PRELOAD = driver ? `${driver} ${LD_PRELOAD}` : LD_PRELOAD;
    process.env.HOSTILE_COUNT = path.join(counts, 'processes');
    daemon = await startDaemon({ tileMs: 5, args: ['--cache', counts, ...args] });
    delete process.env.LD_PRELOAD;
    await ask(daemon, 'POST', '/v1/scenes?id=other', scene());
    viewer = await Live.open(daemon, 'other');
    viewer.look();
    await viewer.nextFrame((frame) => frame.lossless);
}

async function stop() {
    await viewer?.close();
    await daemon?.stop();
}

/** The viewer moves until `done` is true; its frames in a second. */
async function framesWhile(done) {
    const from = viewer.frames.length;
    const begun = Date.now();
    for (let i = 0; !(await done(i)); i += 1) {
        viewer.look({ camera: { position: [Math.sin(i / 20), 1, 5] } });
        await sleep(25);
    }
    return (1000 * (viewer.frames.length - from)) / (Date.now() - begun);
}

test('a small file of a large picture', async (t) => {
    await start();
    t.after(stop);
    const { id, bytes } = await upload(SIDE);
    assert.ok(bytes < 200_000);
    const restarts = await counter(daemon, 'worker_restarts_total');
    const memory = memoryOf(daemon.worker());
    const calm = await framesWhile((i) => i === CALM_ROUNDS);
    let most = memory;
    let rounds = 0;
    const posts = (async () => {
        for (; rounds < ROUNDS; rounds += 1) {
            const answer = await draw(scene(id, rounds));
            assert.equal(answer.status, 200);
            await answer.arrayBuffer();
        }
    })();
    const busy = await framesWhile((i) => {
        most = Math.max(most, memoryOf(daemon.worker()));
        return rounds === ROUNDS && i >= CALM_ROUNDS;
    });
    await posts;
    const after = await framesWhile((i) => i === CALM_ROUNDS);
    t.diagnostic(
        `${bytes} bytes; frames a second ${calm.toFixed(1)} before, ${busy.toFixed(1)} during, ` +
            `${after.toFixed(1)} after; ` +
            `${((most - memory) / MIB).toFixed(0)} MiB more`,
    );
    // Other work on the machine may have begun, or ended, in between.
    const alone = Math.min(calm, after);
    assert.ok(busy > alone / 2, `${busy} of ${alone} frames a second`);
    assert.equal(await counter(daemon, 'worker_restarts_total'), restarts, 'no restart');
    // 64 MiB of halves, the sums of two rows, what the file itself takes, and as much again.
    assert.ok(most - memory < 160 * MIB, `${(most - memory) / MIB} MiB`);
});

test('the render process may take so much memory as is said, beyond what it has begun with', async (t) => {
    const most = () => /^Max address space +(\S+) +(\S+)/m.exec(fs.readFileSync(`/proc/${daemon.worker()}/limits`, 'utf8')).slice(1);
    await start(undefined, ['--worker-memory', '300']);
    t.after(stop);
    const [soft, hard] = most();
    const peak = 1024 * Number(/^VmPeak:\s+(\d+)/m.exec(fs.readFileSync(`/proc/${daemon.worker()}/status`, 'utf8'))[1]);
    assert.equal(soft, hard);
    assert.ok(Number(soft) > 300 * MIB && Number(soft) <= peak + 300 * MIB, `${soft} bytes, ${peak} at most so far`);
    await stop();
    await start();
    assert.deepEqual(most(), ['unlimited', 'unlimited']);
});

test('a small file of a large picture, where the render process has little memory', async (t) => {
    await start(undefined, ['--worker-memory', '64']);
    t.after(stop);
    const { id } = await upload(SIDE);
    // The first of its buffers is as large as all that may be taken, so it is the reader that fails, and is blamed.
    const answer = await draw(scene(id));
    assert.equal(answer.status, 200, await answer.text());
    await logged(daemon, /is not read again: crashed/);
    assert.equal(await counter(daemon, 'worker_restarts_total'), 2, 'it is refused after its second try');
    for (const next of [scene(), scene(id, 30)]) {
        assert.equal((await draw(next)).status, 200, 'the next picture');
    }
    assert.equal((await fetch(`${daemon.url}/healthz`)).status, 200);
    assert.equal(await counter(daemon, 'worker_restarts_total'), 2, 'it is not read again');
});

test('pictures that end whoever reads them', async (t) => {
    await start(hostile);
    t.after(stop);
    const CRASH = 33;
    const HANG_ONCE = 35;
    const what = 'crashes';
    const code = 'crashed';

    await t.test('one that crashes the reader is refused, and may be tried again', async () => {
        const restarts = await counter(daemon, 'worker_restarts_total');
        const { id } = await upload(CRASH);
        await ask(daemon, 'POST', `/v1/scenes?id=${what}`, scene(id));
        const live = await Live.open(daemon, what);
        live.look();
        const notice = await live.next('notice', { code });
        assert.equal(notice.place, PLACE);
        assert.equal(notice.level, 'error');
        assert.match(notice.message, /The sky is drawn without it/);
        await live.nextFrame((frame) => frame.lossless); // all but its sky
        assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + 1);

        // Whoever else names it is told at once, and who comes later; an edit changes nothing.
        await ask(daemon, 'POST', `/v1/scenes?id=${what}-too`, scene(id, 30));
        const second = await Live.open(daemon, `${what}-too`);
        second.look();
        assert.equal((await second.next('notice', { code })).place, PLACE);
        await second.nextFrame((frame) => frame.lossless);
        await second.close();
        assert.equal((await draw(scene(id, 60))).status, 200);
        const from = live.messages.length;
        const edit = live.set('/nodes/ball/params/radius', 0.7);
        const { revision } = await live.next('applied', { edit });
        await live.nextFrame((frame) => frame.lossless && frame.revision === revision);
        const late = await Live.open(daemon, what);
        assert.equal((await late.next('notice', { code })).place, PLACE);
        await late.close();
        assert.ok(!live.find('notice', { place: PLACE }, from), 'told once');
        assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + 1);

        // It is tried again when somebody asks for it.
        live.say({ type: 'retry', place: PLACE });
        await until(async () => (await counter(daemon, 'worker_restarts_total')) > restarts + 1, 'the retry');
        await live.next('notice', { code }, from);
        await live.close();
    });

    await t.test('one that takes too long gets a second try, and is told to nobody', async () => {
        const restarts = await counter(daemon, 'worker_restarts_total');
        const { id } = await upload(HANG_ONCE);
        await ask(daemon, 'POST', '/v1/scenes?id=hangs', scene(id));
        const live = await Live.open(daemon, 'hangs');
        live.look();
        await live.nextFrame((frame) => frame.lossless);
        assert.equal(await counter(daemon, 'worker_restarts_total'), restarts + 1);
        assert.ok(!live.find('notice', { level: 'error' }));
        await logged(daemon, /scene hangs, revision 1, took too long; it is tried again/);
        await live.close();
    });

    await t.test('others hear of no error and go on', async () => {
        const edit = viewer.set('/nodes/ball/params/radius', 0.4);
        const { revision } = await viewer.next('applied', { edit });
        await viewer.nextFrame((frame) => frame.lossless && frame.revision === revision);
        assert.ok(!viewer.find('notice', { level: 'error' }));
    });
});
