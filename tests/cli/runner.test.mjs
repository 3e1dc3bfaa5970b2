// SPDX-License-Identifier: MIT
// The test runner can fail: broken suites in a scratch tree are told from good ones.
import assert from 'node:assert';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { sleep } from '../support/daemon.mjs';
import { Patience } from '../support/patience.mjs';
import { countTap } from '../support/tap.mjs';

const tests = path.dirname(path.dirname(new URL(import.meta.url).pathname));

function numbers(text) {
    const { passed, failed, skipped, faults } = countTap(text);
    return [passed, failed, skipped.length, faults.length];
}

test('flat results are counted', () => {
    assert.deepEqual(numbers('1..3\nok 1 - a\nnot ok 2 - b\nok 3 - c # SKIP no GPU\n'), [1, 1, 1, 0]);
});

test('parents and describe() are not counted', () => {
    const text = [
        '    ok 1 - child',
        '        not ok 1 - grandchild',
        '    not ok 2 - in',
        'not ok 1 - parent',
        'ok 2 - empty',
        "  type: 'suite'",
        '    ok 1 - child',
        'not ok 3 - parent that fails by itself',
        '1..3',
    ].join('\n');
    assert.deepEqual(numbers(text), [2, 2, 0, 0]);
});

test('a broken plan is a fault', () => {
    assert.deepEqual(numbers('1..2\nok 1 - a\n'), [1, 0, 0, 1]);
});

function run(args, env) {
    const child = spawn(process.execPath, args, { env: { ...process.env, ...env } });
    let out = '';
    child.stdout.on('data', (chunk) => (out += chunk));
    return new Promise((done) => child.on('close', (status) => done({ status, out })));
}

// Runs a tree with one suite, a script.
async function runSuite(script, { file = 'run.sh', env = {} } = {}) {
    const tree = fs.mkdtempSync(path.join(os.tmpdir(), 'fieldcast-runner-'));
    try {
        fs.mkdirSync(path.join(tree, 'tests/x'), { recursive: true });
        fs.cpSync(path.join(tests, 'support'), path.join(tree, 'tests/support'), { recursive: true });
        fs.copyFileSync(path.join(tests, 'run.mjs'), path.join(tree, 'tests/run.mjs'));
        fs.writeFileSync(path.join(tree, 'tests/x', file), script);
        const { status, out } = await run([path.join(tree, 'tests/run.mjs'), tree], env);
        return { status, last: out.trimEnd().split('\n').pop(), fault: /hung, [^,]*/.exec(out)?.[0] };
    } finally {
        fs.rmSync(tree, { recursive: true, force: true });
    }
}

for (const [name, script, status, last] of [
    ['a good suite passes', 'echo 1..1; echo ok 1 - a', 0, '1 passed, 0 failed'],
    ['a failed test fails', 'echo not ok 1 - a; exit 1', 1, '0 passed, 1 failed'],
    ['no test at all fails', 'true', 1, '0 passed, 1 failed'],
    ['a crash fails', 'echo ok 1 - a; kill -SEGV $$', 1, '1 passed, 1 failed'],
    ['a status without a reason fails', 'echo ok 1 - a; exit 3', 1, '1 passed, 1 failed'],
    ['a data race fails', 'echo ok 1 - a; echo race >"${TSAN_OPTIONS#*log_path=}.1"', 1, '1 passed, 1 failed'],
    ['a process left behind fails', 'echo ok 1 - a; sleep 600 &', 1, '1 passed, 1 failed'],
]) {
    test(name, async () => assert.deepEqual(await runSuite(script), { status, last, fault: undefined }));
}

// A suite that uses so many seconds of the processor, and says so whenever `word` of them are used.
const busy = (cpuSeconds, word) => `
function used() {
    for (let end = performance.now() + 5; performance.now() < end; ) {}
    const { user, system } = process.cpuUsage();
    return (user + system) / 1e6;
}
for (let told = 0, now = 0; now < ${cpuSeconds}; now = used()) {
    if (now > told + ${word}) {
        told = now;
        console.log('# busy');
    }
}
console.log('ok 1 - a');`;

test('a suite that sleeps for ever is ended', async () => {
    const env = { TEST_IDLE_SECONDS: '2' };
    assert.deepEqual(await runSuite('echo ok 1 - a; sleep 100000', { env }), {
        status: 1,
        last: '1 passed, 1 failed',
        fault: 'hung, silent and idle for 2 s',
    });
});

test('so is one that is stopped', async () => {
    const env = { TEST_IDLE_SECONDS: '2' };
    const { last, fault } = await runSuite('echo ok 1 - a; kill -STOP $$', { env });
    assert.deepEqual([last, fault], ['1 passed, 1 failed', 'hung, silent and idle for 2 s']);
});

test('so is what it started in a group of its own', async () => {
    const env = { TEST_IDLE_SECONDS: '2' };
    const tag = `1${process.pid}00000`; // seconds that nobody else sleeps
    await runSuite(`echo ok 1 - a; setsid sleep ${tag}`, { env });
    const alive = fs.readdirSync('/proc').filter((pid) => {
        try {
            return fs.readFileSync(`/proc/${pid}/cmdline`, 'utf8').includes(tag);
        } catch {
            return false;
        }
    });
    assert.deepEqual(alive, []);
});

test('a suite that is busy without a word is ended', async () => {
    const env = { TEST_IDLE_SECONDS: '100', TEST_BUSY_SECONDS: '1' };
    const { last, fault } = await runSuite(busy(1000, 1000), { file: 'run.mjs', env });
    assert.deepEqual([last, fault], ['0 passed, 2 failed', 'hung, silent for 1 s of processor time']);
});

test('what was used before a word counts as told, what was used after it does not', () => {
    let seconds = 0;
    const list = () => [{ pid: 0, seconds }];
    const patience = new Patience(list, { idleSeconds: 100, busySeconds: 10, periodMs: 0 });
    const isOver = (used) => {
        seconds += used;
        return patience.isOver();
    };
    assert.equal(isOver(9), false);
    patience.heard();
    assert.equal(isOver(11), false);
    assert.equal(isOver(9), false);
    assert.equal(isOver(2), 'silent for 10 s of processor time');
});

test('one that is busy for longer than it may be idle, and one that says so, are not', async () => {
    const quiet = { file: 'run.mjs', env: { TEST_IDLE_SECONDS: '1', TEST_BUSY_SECONDS: '60' } };
    assert.equal((await runSuite(busy(2, 1000), quiet)).last, '1 passed, 0 failed');
    const telling = { file: 'run.mjs', env: { TEST_IDLE_SECONDS: '60', TEST_BUSY_SECONDS: '1' } };
    assert.equal((await runSuite(busy(2, 0.25), telling)).last, '1 passed, 0 failed');
});

test('one that gets hardly any processor is not', async () => {
    const here = ['-c', '0', 'sh', '-c'];
    const work = 'i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done';
    // Each in a session of its own, because Linux may share out processors by session.
    const loops = Array.from({ length: 12 }, () => spawn('taskset', [...here, 'while :; do :; done'], { detached: true }));
    const script = `echo 1..1; taskset ${here.join(' ')} '${work}'; echo ok 1 - a`;
    const result = runSuite(script, { env: { TEST_IDLE_SECONDS: '1' } });
    await sleep(4000);
    loops.forEach((loop) => loop.kill('SIGKILL'));
    assert.equal((await result).last, '1 passed, 0 failed');
});
