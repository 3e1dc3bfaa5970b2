// SPDX-License-Identifier: MIT
// A click is answered by the front itself: a worker that stands still, or is gone, does not matter.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ask, standStill, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const DOCUMENT = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };
const VIEW = { width: 100, height: 100, camera: { position: [0, 0, 6], target: [0, 0, 0] } };

let daemon;
before(async () => {
    daemon = await startDaemon({ args: ['--worker-silence', '4000'] });
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
});
after(() => daemon.stop());

async function pick(live, number, x = 50) {
    live.say({ type: 'pick', pick: number, x, y: 50, seq: live.seq });
    return live.next('picked', { pick: number });
}

test('the worker is stopped', async () => {
    const live = await Live.open(daemon, 's');
    live.look(VIEW);
    await live.nextFrame();
    await standStill(daemon.worker());
    const edit = live.set('/nodes/ball/params/radius', 2);
    const hit = await pick(live, 1);
    assert.equal(live.find('notice'), undefined, 'before the worker is missed');
    const applied = await live.next('applied', { edit });
    assert.deepEqual([hit.node, hit.revision], ['ball', applied.revision]);
    assert.ok(Math.abs(hit.distance - 4) < 1e-2, 'the newest state, at which no picture is');
    assert.equal((await pick(live, 2, 1)).node, null);
    assert.equal(live.find('notice'), undefined);
    await live.next('notice', { code: 'worker_restarting' });
    await live.close();
});

test('there was no worker yet', async () => {
    const other = await startDaemon({ ready: false });
    await ask(other, 'POST', '/v1/scenes?id=s', DOCUMENT);
    await standStill(other.worker());
    const live = await Live.open(other, 's');
    live.look(VIEW);
    assert.equal((await pick(live, 1)).node, 'ball');
    assert.equal(live.frames.length, 0);
    assert.equal(live.find('notice'), undefined);
    await live.close();
    await other.stop();
});
