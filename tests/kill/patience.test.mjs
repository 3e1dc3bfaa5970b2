// SPDX-License-Identifier: MIT
// Slow is not broken: what uses the processor is left alone however long it takes, what is still is
// replaced, and code that takes too long to compile gets a second try, then its reason, then another
// try when somebody asks for it.
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, afterEach, test } from 'node:test';
import {
    ask,
    counter,
    cpuSecondsOf,
    driverEnvironment,
    logged,
    makeDirectory,
    program,
    removeDirectory,
    sleep,
    startDaemon,
    until,
} from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const driver = path.join(path.dirname(program), 'tests/kill/hostile_driver.so');
const { LD_PRELOAD: nothing, ...nothingElse } = driverEnvironment('null');
const CODE = '/primitives/blob/code';
const ball = (radius) => `float sdf(vec3 p) { return length(p) - ${radius} * blow; }`;
const GOOD = ball('1.0');
const HANG = ball('31337.5');
const CRASH = ball('31338.5');
const HANG_ONCE = ball('31341.5');
const HANG_TWICE = ball('31342.5');
const DRAW_SLOWLY = ball('31344.5'); // 10 ms for each 8 × 8 pixels in each pass
const DRAW_HARDLY = ball('31345.5'); // 250 ms
const DRAW_HARDLY_LATE = ball('31347.5'); // compiled when the engine has drawn for a while
const DRAW_AT_LENGTH = ball('31348.5'); // 500 ms

const scene = (code) => ({
    format: 'fieldcast/1',
    lights: [{ id: 'sun', type: 'directional' }],
    primitives: { blob: { params: [{ name: 'blow', type: 'float', default: 1 }], code } },
    root: { id: 'root', type: 'union', children: [{ id: 'b', type: 'field', params: { primitive: 'blob' } }] },
});

const folder = makeDirectory();
const daemons = [];
let started = 0;
// What hangs in a process goes on for as long as its daemon does.
afterEach(() => Promise.all(daemons.splice(0).map((daemon) => daemon.stop())));
after(() => removeDirectory(folder));

/** With the driver in front of one that draws nothing: nobody looks at a pixel here. */
async function start(...args) {
    process.env.LD_PRELOAD = `${driver} ${nothing}`;
    started += 1;
    process.env.HOSTILE_COUNT = path.join(folder, `count-${started}`);
    Object.assign(process.env, nothingElse);
    const daemon = await startDaemon({ args: ['--cache', folder, ...args] });
    delete process.env.LD_PRELOAD;
    daemons.push(daemon);
    return daemon;
}

async function open(daemon, id, code, view) {
    await ask(daemon, 'POST', `/v1/scenes?id=${id}`, scene(code));
    const live = await Live.open(daemon, id);
    live.look(view);
    return live;
}

const SOON_MS = 400; // what compiling may take at least: what hangs uses all of it
const SOON = ['--code-time', String(SOON_MS)];
const SMALL = { width: 12, height: 8 };

/** Leaves a process the time of one processor that loops do not want, which is none. */
function starve(pid) {
    const processor = /^Cpus_allowed_list:\s+(\d+)/m.exec(fs.readFileSync(`/proc/${pid}/status`, 'utf8'))[1];
    const loop = ['-c', processor, 'sh', '-c', 'while :; do :; done'];
    const loops = Array.from({ length: 8 }, () => spawn('taskset', loop, { stdio: 'ignore' }));
    const endLoops = () => loops.forEach((one) => one.kill('SIGKILL'));
    after(endLoops);
    execFileSync('taskset', ['-a', '-p', '-c', processor, String(pid)]);
    execFileSync('chrt', ['-a', '-i', '-p', '0', String(pid)]);
    return {
        end() {
            endLoops();
            spawnSync('chrt', ['-a', '-o', '-p', '0', String(pid)]); // of one that has ended, nothing
        },
    };
}

/** The longest that a thread of it has waited for a processor. */
const waitedMs = (pid) =>
    Math.max(
        ...fs.readdirSync(`/proc/${pid}/task`).map((task) => {
            const text = fs.readFileSync(`/proc/${pid}/task/${task}/schedstat`, 'utf8');
            return Number(text.split(' ')[1]) / 1e6;
        }),
    );

const restarts = (daemon) => counter(daemon, 'worker_restarts_total');
const errors = (live) => live.messages.filter((m) => m.type === 'notice' && m.level === 'error');

test('a tile that is long at work is no hung process', async (t) => {
    const daemon = await start('--worker-silence', '100');
    const live = await open(daemon, 'slow', DRAW_SLOWLY, { width: 32, height: 24 });
    const frame = await live.nextFrame((one) => one.lossless); // the device's
    t.diagnostic(`a picture of ${frame.width} × ${frame.height} after ${frame.at - live.messages[0].at} ms`);
    assert.equal(await restarts(daemon), 0);
    assert.deepEqual(errors(live), []);
    await live.close();
});

test('a scene whose tiles took too long for one process is drawn by the next in the smallest', async () => {
    const daemon = await start('--worker-busy', '200');
    const live = await open(daemon, 'smaller', DRAW_SLOWLY, { width: 48, height: 32 });
    await live.nextFrame((frame) => frame.lossless);
    assert.ok((await restarts(daemon)) >= 1);
    assert.deepEqual(errors(live), []);
    await live.close();
});

test('a process that is stopped is replaced', async () => {
    const daemon = await start('--worker-silence', '500');
    const pid = daemon.worker();
    process.kill(pid, 'SIGSTOP');
    await until(() => daemon.worker() && daemon.worker() !== pid, 'another worker');
    await logged(daemon, /silent and still for/);
});

test('a process that waits for a processor is not', async () => {
    const daemon = await start('--worker-silence', '500');
    const pid = daemon.worker();
    await ask(daemon, 'POST', '/v1/scenes?id=s', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    const live = await Live.open(daemon, 's');
    const starved = starve(pid);
    live.look();
    await until(() => waitedMs(pid) > 3000, 'three seconds without a processor');
    starved.end();
    await live.nextFrame((frame) => frame.seq === live.seq && frame.lossless);
    assert.equal(daemon.worker(), pid);
    await live.close();
});

test('the end does not wait for a process that dies slowly', async () => {
    const daemon = await start();
    const starved = starve(daemon.worker());
    const { status } = await daemon.kill('SIGTERM');
    starved.end();
    assert.equal(status, 0, daemon.errors);
});

test('code that compiles in a second try leaves no word', async () => {
    const daemon = await start(...SOON);
    const live = await open(daemon, 'once', HANG_ONCE);
    await live.nextFrame((frame) => frame.lossless);
    assert.equal(await restarts(daemon), 1);
    assert.deepEqual(live.messages.filter((m) => m.type === 'notice'), []);
    await live.close();
});

test('too slow twice is told with measure and limit, and tried again when asked', async () => {
    const daemon = await start(...SOON);
    const live = await open(daemon, 'twice', GOOD);
    await live.nextFrame((frame) => frame.lossless);
    live.set(CODE, HANG_TWICE);
    const notice = await live.next('notice', { level: 'error' });
    assert.equal(notice.code, 'too_slow');
    assert.equal(notice.place, CODE);
    assert.equal(notice.line, undefined);
    assert.ok(notice.measured > notice.limit && notice.limit >= 5 * SOON_MS, `${notice.measured} of ${notice.limit}`);
    assert.match(notice.message, /^This code took over [\d.]+ s to compile here \(limit [\d.]+ s\)\. The last picture stays\.$/);
    assert.equal(await restarts(daemon), 2);

    const refused = await fetch(`${daemon.url}/v1/scenes/twice/image.png?width=8&height=8`);
    const problem = await refused.json();
    assert.equal(refused.status, 503);
    assert.equal(problem.code, 'too_slow');
    assert.equal(problem.measured, notice.measured);
    assert.equal(problem.limit, notice.limit);

    live.say({ type: 'retry', place: '/nodes/nobody' });
    assert.equal((await live.next('notice', { code: 'not_found' })).place, '/place');
    live.look({ width: 80, height: 48 });
    live.say({ type: 'retry', place: CODE });
    assert.equal((await live.next('notice', { code: 'retrying' })).place, CODE);
    await live.nextFrame((frame) => frame.lossless && frame.revision === 2);
    assert.equal(await restarts(daemon), 2);
    assert.equal(errors(live).length, 2);
    await live.close();
});

test('while one scene compiles, it is seen, and others are edited, looked at, picked in and read', async () => {
    const daemon = await start('--code-time', '60000');
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    const other = await Live.open(daemon, 'other');
    const hung = await open(daemon, 'hang', HANG);
    await hung.next('compiling');
    await hung.nextFrame(); // by the engine
    for (let i = 1; i <= 5; i += 1) {
        other.look({ camera: { position: [i, 1, 5] } });
        other.set('/nodes/ball/params/radius', 1 + i / 10);
        await other.nextFrame((frame) => frame.seq === other.seq && frame.revision === i + 1);
        other.say({ type: 'pick', pick: i, seq: other.seq, x: 8, y: 6 });
        await other.next('picked', { pick: i });
        const picture = await fetch(`${daemon.url}/v1/scenes/other/image.png?width=8&height=8`);
        assert.equal(picture.status, 200);
        await picture.arrayBuffer();
    }
    assert.deepEqual(errors(hung), []);
    assert.ok(hung.frames.every((frame) => !frame.lossless && !frame.stale));
    assert.equal(await restarts(daemon), 0);
    await Promise.all([hung, other].map((one) => one.close()));
});

test('no measure and no limit are told of a crash, and a retry that fails is told again', async () => {
    const daemon = await start();
    const live = await open(daemon, 'crash', CRASH);
    const notice = await live.next('notice', { level: 'error' });
    assert.equal(notice.code, 'crashed');
    assert.equal(notice.place, CODE);
    assert.deepEqual([notice.line, notice.measured, notice.limit], [undefined, undefined, undefined]);
    const from = live.messages.length;
    live.say({ type: 'retry' });
    assert.equal((await live.next('notice', { code: 'retrying' }, from)).place, CODE);
    assert.equal((await live.next('notice', { level: 'error' }, from)).code, 'crashed');
    await live.close();
});

test('who has nothing to do with it hears no word of a crash', async () => {
    const daemon = await start(...SOON);
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    const still = await Live.open(daemon, 'other');
    const moving = await Live.open(daemon, 'other');
    still.look();
    await still.nextFrame((frame) => frame.lossless);
    const live = await open(daemon, 'hang', HANG);
    moving.look();
    await moving.nextFrame();
    let going = true;
    const done = (async () => {
        for (let i = 0; going; i += 1) {
            moving.look({ camera: { position: [Math.sin(i), 1, 5] } });
            await sleep(25);
        }
    })();
    await live.next('notice', { code: 'too_slow' });
    going = false;
    await done;
    for (const one of [still, moving]) {
        const told = one.messages.filter((m) => m.type === 'notice');
        assert.ok(told.every((m) => m.level === 'info'), JSON.stringify(told));
        assert.ok(told.every((m) => !/ended|crash/.test(m.message)), JSON.stringify(told));
    }
    await Promise.all([still, moving, live].map((one) => one.close()));
});

test('a scene whose smallest part takes too long is suspended with its measure', async () => {
    const daemon = await start('--tile-time', '250');
    const live = await open(daemon, 'heavy', DRAW_HARDLY, SMALL);
    const notice = await live.next('notice', { code: 'scene_left_out' });
    assert.ok(notice.measured > 250 && notice.limit === 250, `${notice.measured} of ${notice.limit}`);
    assert.equal(notice.place, '/nodes/root');
    assert.equal(notice.reason, 'too_slow');
    const refused = await fetch(`${daemon.url}/v1/scenes/heavy/image.png?width=8&height=8`);
    assert.equal((await refused.json()).code, 'too_slow');
    assert.equal(await restarts(daemon), 0);
    const late = await Live.open(daemon, 'heavy');
    const again = await late.next('notice', { code: 'scene_left_out' });
    assert.deepEqual([again.limit, again.reason], [250, 'too_slow']);
    await late.close();
    const spent = cpuSecondsOf(daemon.worker());
    await sleep(1000);
    assert.ok(cpuSecondsOf(daemon.worker()) - spent < 0.5, 'it is not drawn again');

    live.say({ type: 'retry', place: '/nodes/root' });
    await live.next('notice', { code: 'retrying' });
    await live.nextFrame();
    await live.close();
});

test('a scene whose first pictures were drawn while it was compiled is suspended by the last', async () => {
    const daemon = await start('--tile-time', '250');
    const live = await open(daemon, 'late', DRAW_HARDLY_LATE, SMALL);
    const notice = await live.next('notice', { code: 'scene_left_out' });
    assert.deepEqual([notice.limit, notice.reason], [250, 'too_slow']);
    await live.close();
});

test('a scene that is too heavy for the engine is suspended, and others are drawn', async () => {
    const daemon = await startDaemon({ args: ['--cache', folder, '--stage', 'engine', '--tile-time', '10'] });
    daemons.push(daemon);
    const wave = 'for (int i = 0; i < 250; i++) s += sin(p.x * float(i) + s) * cos(p.y * float(i));';
    const heavy = scene(`float sdf(vec3 p) { float s = 0.0; ${wave} return length(p) - blow + 1e-9 * s; }`);
    heavy.root.children = Array.from({ length: 100 }, () => ({ type: 'field', params: { primitive: 'blob' } }));
    await ask(daemon, 'POST', '/v1/scenes?id=heavy', heavy);
    const live = await Live.open(daemon, 'heavy');
    live.look({ width: 16, height: 16 });
    const notice = await live.next('notice', { code: 'scene_left_out' });
    assert.ok(notice.measured > 10 && notice.limit === 10, `${notice.measured} of ${notice.limit}`);
    const light = await open(daemon, 'light', GOOD, SMALL);
    await light.nextFrame();
    assert.equal(await restarts(daemon), 0);
    await Promise.all([live.close(), light.close()]);
});

test('a scene that keeps two processes at work for too long is suspended too', async () => {
    const daemon = await start('--worker-busy', '400');
    const live = await open(daemon, 'busy', DRAW_AT_LENGTH, SMALL);
    const notice = await live.next('notice', { code: 'scene_left_out' });
    assert.ok(notice.measured > 400 && notice.limit === 400, `${notice.measured} of ${notice.limit}`);
    // A start may take more than so low a bound too.
    assert.ok((await restarts(daemon)) >= 2);
    live.say({ type: 'retry' });
    await live.nextFrame();
    await live.close();
});
