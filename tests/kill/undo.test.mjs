// SPDX-License-Identifier: MIT
// What an author can undo is there again after the daemon was killed.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { ask, makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const RADIUS = '/nodes/ball/params/radius';
const DOCUMENT = {
    format: 'fieldcast/1',
    root: { id: 'root', type: 'union', children: [{ id: 'ball', type: 'sphere' }, { id: 'other', type: 'sphere' }] },
};
const client = 'the-author';
const data = makeDirectory();
after(() => removeDirectory(data));

const start = () => startDaemon({ data, ready: false });
const document = (daemon) => ask(daemon, 'GET', '/v1/scenes/s');
const radius = async (daemon) => (await document(daemon)).root.children[0].params?.radius;

/** Undoes or redoes, and waits until it is committed. */
async function step(live, type) {
    const edit = live.step(type);
    return live.next('applied', { edit, durable: true });
}

test('steps, their names and what was undone come back', async () => {
    let daemon = await start();
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
    let live = await Live.open(daemon, 's', { client });
    live.set(RADIUS, 1, { label: 'grow' });
    for (let i = 0; i < 5; i += 1) {
        live.set(RADIUS, 2 + i, { group: 'drag', label: 'drag the radius' });
    }
    live.change([{ op: 'remove', at: '/nodes/other' }], { label: 'delete other' });
    await live.next('applied', { edit: live.edit, durable: true });
    await step(live, 'undo');
    await daemon.kill();

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(live.welcome.undo, 2);
    assert.equal(live.welcome.redo, 1);
    assert.deepEqual(live.welcome.undo_labels, ['drag the radius', 'grow']);
    assert.deepEqual(live.welcome.redo_labels, ['delete other']);
    assert.equal(await radius(daemon), 6);
    await step(live, 'undo');
    assert.equal(await radius(daemon), 1);
    await step(live, 'undo');
    assert.equal(await radius(daemon), undefined);
    await step(live, 'redo');
    await step(live, 'redo');
    await daemon.kill();

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(await radius(daemon), 6);
    await step(live, 'redo');
    assert.equal((await document(daemon)).root.children.length, 1);
    const none = live.step('redo');
    assert.equal((await live.next('rejected', { edit: none })).code, 'not_found');
    await daemon.stop();
});

test('steps from before a snapshot come back, those of a replaced document do not', async () => {
    let daemon = await start();
    let live = await Live.open(daemon, 's', { client });
    const steps = live.welcome.undo;
    for (let i = 0; i < 300; i += 1) {
        live.set(RADIUS, 1 + i / 1000);
    }
    await live.next('applied', { edit: live.edit, durable: true });
    await daemon.stop(); // writes a snapshot, as every 256 edits do

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(live.welcome.undo, steps + 300);
    await step(live, 'undo');
    assert.equal(await radius(daemon), 1.298);
    await ask(daemon, 'PUT', '/v1/scenes/s', DOCUMENT);
    await daemon.kill();

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(live.welcome.undo, 0);
    assert.equal(live.welcome.redo, 0);
    live.set(RADIUS, 3);
    await live.next('applied', { edit: live.edit, durable: true });
    await daemon.kill();

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(live.welcome.undo, 1);
    await daemon.stop();
});
