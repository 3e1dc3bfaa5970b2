// SPDX-License-Identifier: MIT
// A driver in the wrong hands (support/drivers/escape_driver.c) tries to get out of the render process.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import {
    ask,
    childrenOf,
    counter,
    driverEnvironment,
    logged,
    makeDirectory,
    program,
    removeDirectory,
    startDaemon,
    until,
} from '../support/daemon.mjs';

const { EPERM, EACCES } = os.constants.errno;
const ACTS = 27;
// LeakSanitizer starts a process at the end of another, which ends with it, so there that is not refused.
const LOOKS_FOR_LEAKS = fs.readFileSync(program).includes('__asan_init');
const MAY = LOOKS_FOR_LEAKS ? ['start a process', 'outlive the parent'] : [];
const DOCUMENT = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

let cache;
before(() => (cache = makeDirectory()));
after(() => removeDirectory(cache));

// Without capabilities of its own the daemon is as open to its child as any user's is.
const AS_USER = process.getuid() === 0 ? 'exec setpriv --bounding-set -all --inh-caps -all "$0" "$@"' : '';

/** What each act came to, by name and thread, after a picture; and the daemon's own words. */
async function tryAll(args, environment = {}) {
    const data = makeDirectory();
    const report = path.join(cache, `report${args.join('')}`);
    fs.writeFileSync(path.join(data, 'secret'), 'kept');
    fs.writeFileSync(path.join(data, 'spare'), '');
    const daemon = await startDaemon({
        driver: ['escape', 'null'],
        args: ['--cache', cache, ...args],
        limits: AS_USER,
        data,
        environment: { ESCAPE_REPORT: report, ESCAPE_DATA: data, ...environment },
    });
    try {
        await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
        const pid = daemon.worker();
        const picture = await fetch(`${daemon.url}/v1/scenes/s/image.png?width=16&height=16`);
        assert.equal(picture.status, 200, daemon.errors);
        assert.equal(daemon.worker(), pid, 'it is still the same render process');
        return await read(daemon, data, report);
    } finally {
        await daemon.stop();
        removeDirectory(data);
    }
}

async function read(daemon, data, report) {
    const files = await counter(daemon, 'worker_files_confined');
    const calls = await counter(daemon, 'worker_calls_confined');
    const lines = fs.readFileSync(report, 'utf8').trim().split('\n');
    const acts = lines.map((line) => line.split('\t')).map(([thread, act, error]) => ({ thread, act, error: Number(error) }));
    const secret = fs.readFileSync(path.join(data, 'secret'), 'utf8');
    const left = fs.readdirSync(data);
    assert.equal(acts.length, 2 * ACTS);
    return { acts, files, calls, secret, left, errors: daemon.errors };
}

const isRefused = ({ error }) => error === EPERM || error === EACCES;
const told = (acts) => acts.map(({ thread, act, error }) => `${thread}: ${act}: ${error}`);

for (const word of ['auto', 'strict']) {
    test(`--confine ${word}: all that a driver tries is refused, on every thread`, async () => {
        const { acts, files, calls, secret, left, errors } = await tryAll(['--confine', word]);
        assert.deepEqual(told(acts.filter((one) => !isRefused(one) && !MAY.includes(one.act))), []);
        assert.equal(secret, 'kept');
        assert.ok(!left.includes('new'));
        assert.deepEqual([files, calls], [1, 1]);
        assert.match(errors, /confined: files, system calls/);
    });
}

test('--confine off: the same acts succeed', async () => {
    const { acts, files, calls, secret, errors } = await tryAll(['--confine', 'off']);
    const yama = '/proc/sys/kernel/yama/ptrace_scope';
    const traced = !fs.existsSync(yama) || fs.readFileSync(yama, 'utf8').trim() === '0';
    const others = acts.filter(({ act }) => traced || !/^(trace|read|open) the parent$/.test(act));
    assert.deepEqual(told(others.filter(({ error }) => error !== 0)), []);
    assert.equal(secret, '');
    assert.deepEqual([files, calls], [0, 0]);
    assert.match(errors, /confined: nothing; --confine is off/);
});

test('where the kernel has no Landlock the rest holds, and it is told', async () => {
    const { acts, files, calls, errors } = await tryAll([], { ESCAPE_WITHOUT: 'landlock' });
    const refused = new Set(acts.filter(isRefused).map(({ act }) => act));
    for (const act of ['make a socket', 'become a program', 'cut a file by its name', 'signal the parent']) {
        assert.ok(refused.has(act), act);
    }
    assert.ok(!refused.has('write a file'));
    assert.deepEqual([files, calls], [0, 1]);
    assert.match(errors, /confined: system calls alone; files: the kernel has no Landlock/);
});

test('where the kernel has no seccomp the rest holds, and it is told', async () => {
    const { acts, files, calls, errors } = await tryAll(['--confine', 'auto', '--code', 'on'], { ESCAPE_WITHOUT: 'seccomp' });
    const refused = new Set(acts.filter(isRefused).map(({ act }) => act));
    for (const act of ['write a file', 'read a file', 'trace the parent', "read the parent's environment"]) {
        assert.ok(refused.has(act), act);
    }
    assert.ok(!refused.has('make a socket'));
    assert.deepEqual([files, calls], [1, 0]);
    assert.match(errors, /confined: files alone; system calls: /);
});

for (const part of ['landlock', 'seccomp']) {
    test(`--confine strict ends where the kernel has no ${part}`, async () => {
        const daemon = await startDaemon({
            driver: ['escape', 'null'],
            args: ['--confine', 'strict', '--cache', cache],
            environment: { ESCAPE_WITHOUT: part },
            ready: false,
        });
        await daemon.exited;
        await logged(daemon, /the render process cannot be confined: /);
        await daemon.stop(1);
    });
}

const doctor = (args, environment = {}) =>
    spawnSync(program, ['doctor', '--port', '0', '--cache', cache, '--data', path.join(cache, 'none'), ...args], {
        env: { ...process.env, ...driverEnvironment('escape', 'null'), ...environment },
        encoding: 'utf8',
    });

test('doctor tells what is in force, and why not', () => {
    const good = doctor([]);
    assert.equal(good.status, 0, good.stdout);
    assert.match(good.stdout, /^ok {4}confinement .*writes to its cache alone/m);
    assert.match(doctor(['--confine', 'off']).stdout, /^warn {2}confinement +off \(--confine\)/m);
    const without = doctor([], { ESCAPE_WITHOUT: 'landlock' });
    assert.equal(without.status, 0);
    assert.match(without.stdout, /^warn {2}confinement +files: the kernel has no Landlock: /m);
    const strict = doctor(['--confine', 'strict'], { ESCAPE_WITHOUT: 'landlock' });
    assert.equal(strict.status, 1);
    assert.match(strict.stdout, /^FAIL {2}confinement +files: the kernel has no Landlock: /m);
});

/** A render process whose front goes as soon as it is ready, and which is killed while it ends. */
async function killAtEnd() {
    const child = spawn(program, ['worker', '--cache', cache], {
        env: { ...process.env, ...driverEnvironment('null') },
        stdio: ['ignore', 'ignore', 'pipe', 'pipe', 'pipe'],
    });
    let closed = false; // all that hold its stderr have ended
    child.on('close', () => (closed = true));
    const [, , stderr, ...sockets] = child.stdio;
    stderr.resume();
    await once(sockets[0], 'data');
    sockets.forEach((socket) => socket.destroy());
    let left = [];
    while (LOOKS_FOR_LEAKS && left.length === 0 && child.exitCode === null) {
        left = childrenOf(child.pid);
        await new Promise(setImmediate);
    }
    child.kill('SIGKILL');
    try {
        await until(() => closed, 'whatever the render process started to end');
    } finally {
        left.filter(() => !closed).forEach((pid) => process.kill(pid, 'SIGKILL'));
    }
    return left.length;
}

test('a render process that is killed while it ends leaves no process behind', async () => {
    let looked = 0;
    for (let i = 0; i < 5; i += 1) {
        looked += await killAtEnd();
    }
    assert.ok(!LOOKS_FOR_LEAKS || looked > 0, 'it was killed while it was looked at');
});
