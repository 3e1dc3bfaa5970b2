// SPDX-License-Identifier: MIT
// A scene is made, looked at, edited and deleted, again and again: what the daemon and its render
// process hold stays the same.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ask, counter, memoryOf, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const ROUNDS = Number(process.env.FIELDCAST_ROUNDS ?? 150);
const WARM_ROUNDS = Math.min(500, ROUNDS / 2);
const GROWTH = 2 << 20; // bytes, however many rounds
// AddressSanitizer keeps freed memory by thread, and stacks that were left.
const KEEP_LITTLE = 'detect_stack_use_after_return=0:thread_local_quarantine_size_kb=16:verify_asan_link_order=0';
const RADIUS = '/nodes/ball/params/radius';
const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

let daemon;
before(async () => {
    daemon = await startDaemon({
        driver: 'null',
        environment: { ASAN_OPTIONS: `${process.env.ASAN_OPTIONS ?? ''}:${KEEP_LITTLE}` },
    });
});
after(() => daemon.stop());

async function round(i) {
    await ask(daemon, 'POST', `/v1/scenes?id=round-${i}`, ball);
    const live = await Live.open(daemon, `round-${i}`);
    live.look();
    await live.nextFrame();
    const { revision } = await live.next('applied', { edit: live.set(RADIUS, 0.5), durable: true });
    await live.nextFrame((frame) => frame.revision === revision);
    await live.next('applied', { edit: live.step('undo'), durable: true });
    await live.close();
    await ask(daemon, 'DELETE', `/v1/scenes/round-${i}`);
}

const held = () => ({ daemon: memoryOf(daemon.pid), worker: memoryOf(daemon.worker()) });

test(`${ROUNDS} scenes made, looked at, edited and deleted leave nothing behind`, async (t) => {
    const worker = daemon.worker();
    let warm;
    for (let i = 0; i < ROUNDS; i += 1) {
        if (i === WARM_ROUNDS) {
            warm = held();
        }
        await round(i);
    }
    for (const name of ['sessions', 'rooms', 'scenes', 'render_queue', 'documents_waiting']) {
        await until(async () => (await counter(daemon, name)) === 0, `${name} to be 0`);
    }
    const now = held();
    const grown = Object.keys(now).map((name) => [name, now[name] - warm[name]]);
    const text = grown.map(([name, bytes]) => `${name} ${(bytes / 1024).toFixed(0)} KiB`).join(', ');
    t.diagnostic(`more than after ${WARM_ROUNDS} rounds: ${text}, of ${(now.daemon >> 20)} and ${now.worker >> 20} MiB`);
    assert.ok(grown.every(([, bytes]) => bytes < GROWTH), text);
    assert.equal(daemon.worker(), worker, 'the same render process');
});
