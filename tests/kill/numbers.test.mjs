// SPDX-License-Identifier: MIT
// The number of an edit that was not applied is never told applied: neither before nor after the
// daemon was killed, nor when memory has let go of it.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { ask, makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const RADIUS = '/nodes/ball/params/radius';
const DOCUMENT = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };
const LOG = 2048; // edits in memory
const client = 'the-author';
const data = makeDirectory();
after(() => removeDirectory(data));

const start = () => startDaemon({ data, driver: 'null', ready: false });
const set = (value) => [{ op: 'set', at: RADIUS, value }];

async function assertConflict(live, edit, type = 'edit') {
    const from = live.messages.length;
    live.say(type === 'edit' ? { type, edit, ops: set(77) } : { type, edit });
    const said = await live.next('rejected', { edit }, from);
    assert.deepEqual([said.code, said.place], ['conflict', '/edit'], `${type} ${edit}`);
    assert.equal(live.find('applied', { edit }), undefined);
}

async function assertKnown(live, edit, revision) {
    const from = live.messages.length;
    live.say({ type: 'edit', edit, ops: set(77) });
    const said = await live.next('applied', { edit }, from);
    assert.deepEqual([said.revision, said.durable], [revision, true], `edit ${edit}`);
}

/** 1 and 2 are applied, 3 is refused, the next is 1002. */
async function edit(live) {
    live.set(RADIUS, 1.25);
    live.set(RADIUS, 1.5);
    await live.next('rejected', { edit: live.set(RADIUS, -1) });
    live.edit = 1001;
    await live.next('applied', { edit: live.set(RADIUS, 1.75), durable: true });
}

async function assertAnswers(live) {
    for (const [number, revision] of [[1, 2], [2, 3], [1002, 4]]) {
        await assertKnown(live, number, revision);
    }
    for (const number of [3, 4, 700, 1001]) {
        await assertConflict(live, number);
    }
    await assertConflict(live, 4, 'undo');
    await assertConflict(live, 4, 'redo');
}

test('numbers that were left out, before and after kill -9', async () => {
    let daemon = await start();
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
    let live = await Live.open(daemon, 's', { client });
    await edit(live);
    await assertAnswers(live);
    await daemon.kill();

    daemon = await start();
    live = await Live.open(daemon, 's', { client });
    assert.equal(live.welcome.last_edit, 1002);
    await assertAnswers(live);
    const document = await ask(daemon, 'GET', '/v1/scenes/s');
    assert.equal(document.root.params.radius, 1.75);
    const { revision } = await live.next('applied', { edit: live.set(RADIUS, 2), durable: true });
    assert.equal(revision, 5);
    await daemon.stop();
});

test('numbers that memory has let go of', async () => {
    const daemon = await start();
    const live = await Live.open(daemon, 's', { client });
    const first = live.edit + 2;
    live.edit += 1; // one is left out
    for (let i = 0; i < LOG + 100; i += 1) {
        live.set(RADIUS, 1 + i / 10000);
    }
    const { revision } = await live.next('applied', { edit: live.edit, durable: true });
    await assertKnown(live, first, revision - LOG - 99);
    await assertConflict(live, first - 1);
    await assertConflict(live, 3);
    await assertKnown(live, 1, 2);
    const before = await ask(daemon, 'GET', '/v1/scenes/s');
    assert.equal(before.root.params.radius, 1 + (LOG + 99) / 10000);
    await daemon.stop();
});

test('numbers of a scene that was put in the place of another', async () => {
    const daemon = await start();
    await ask(daemon, 'PUT', '/v1/scenes/s', DOCUMENT);
    const live = await Live.open(daemon, 's', { client });
    await assertKnown(live, 1, 2);
    await assertConflict(live, 3);
    await ask(daemon, 'DELETE', '/v1/scenes/s');
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
    const anew = await Live.open(daemon, 's', { client });
    assert.equal(anew.welcome.last_edit, 0);
    anew.edit = 9;
    await anew.next('applied', { edit: anew.set(RADIUS, 3), durable: true });
    await assertConflict(anew, 1);
    await daemon.stop();
});
