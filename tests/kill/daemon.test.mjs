// SPDX-License-Identifier: MIT
// The daemon is killed again and again in the middle of editing. Whatever it told durable must be
// there afterwards, in order, once.
//
// Each edit of a client adds a node with the edit's number and removes the one 100 before, and so
// applies only if every edit before it was applied once: a lost or doubled edit would stop the
// chain, and the nodes that are there show the newest hundred.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { ask, driverEnvironment, makeDirectory, removeDirectory, sleep, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { spawn } from 'node:child_process';
import { program } from '../support/daemon.mjs';

const KILLS = Number(process.env.FIELDCAST_KILLS ?? 25);
const CLIENTS = ['editor-one', 'editor-two', 'editor-three', 'editor-four'];
const WINDOW = 100;
const data = makeDirectory();
after(() => removeDirectory(data));

/** The same numbers in every run (Mulberry32, T. Ettinger). */
function randomNumbers(seed) {
    let state = seed;
    return () => {
        state = (state + 0x6d2b79f5) | 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

const nodeId = (client, n) => `${client}.${n}`;

function operations(client, n) {
    const add = {
        op: 'insert',
        into: `/nodes/${client}`,
        before: null,
        value: { id: nodeId(client, n), type: 'sphere', params: { radius: 1 + n / 1000 } },
    };
    const remove = { op: 'remove', at: `/nodes/${nodeId(client, n - WINDOW)}` };
    return n > WINDOW ? [add, remove] : [add];
}

const told = Object.fromEntries(CLIENTS.map((client) => [client, 0])); // newest told durable
const sent = Object.fromEntries(CLIENTS.map((client) => [client, 0]));
const sum = { told: 0, sent: 0, kept: 0 };

/** Edits until the connection ends; remembers what was told. */
async function edit(daemon, client, random) {
    const live = await Live.open(daemon, 's', { client });
    while (!live.closed) {
        const n = live.change(operations(client, live.edit + 1));
        sent[client] = Math.max(sent[client], n);
        await sleep(random() * 4);
    }
    const durable = live.messages.filter((m) => m.type === 'applied' && m.durable).map((m) => m.edit);
    const rejected = live.messages.filter((m) => m.type === 'rejected');
    assert.deepEqual(rejected, [], 'every edit continues the chain');
    told[client] = Math.max(told[client], ...durable);
    sum.told += new Set(durable).size;
}

/** What is there after a restart. */
async function check(daemon) {
    const document = await ask(daemon, 'GET', '/v1/scenes/s');
    const { revision } = (await ask(daemon, 'GET', '/v1/scenes')).scenes[0];
    let edits = 0;
    for (const client of CLIENTS) {
        const live = await Live.open(daemon, 's', { client });
        const last = live.welcome.last_edit;
        assert.ok(last >= told[client], `${client}: ${told[client]} was told durable, ${last} is there`);
        assert.ok(last <= sent[client], `${client}: ${last} is there, ${sent[client]} was sent`);
        const nodes = document.root.children.find((node) => node.id === client).children ?? [];
        const first = Math.max(1, last - WINDOW + 1);
        const expected = Array.from({ length: last - first + 1 }, (_, i) => nodeId(client, first + i));
        assert.deepEqual(nodes.map((node) => node.id), expected, `${client}: in order, once`);
        if (last > 0) {
            live.say({ type: 'edit', edit: last, ops: operations(client, last) });
            assert.equal((await live.next('applied', { edit: last })).durable, true);
        }
        edits += last;
        await live.close();
    }
    assert.equal(revision, 1 + edits, 'a revision for each edit, and none besides');
    sum.kept = edits;
}

/** Killed while it starts; it may not get as far as to make the file. */
async function killInStart(random) {
    const env = { ...process.env, ...driverEnvironment('null') };
    const child = spawn(program, ['serve', '--port', '0', '--data', data], { env, stdio: 'ignore' });
    const gone = new Promise((done) => child.on('exit', done));
    await sleep(random() * 60);
    child.kill('SIGKILL');
    await gone;
}

test(`kill -9 ${KILLS} times in the middle of editing`, async (t) => {
    const random = randomNumbers(20240229);
    const first = await startDaemon({ data, ready: false, driver: 'null' });
    await ask(first, 'POST', '/v1/scenes?id=s', {
        format: 'fieldcast/1',
        root: {
            id: 'root',
            type: 'union',
            children: CLIENTS.map((id) => ({ id, type: 'group' })),
        },
    });
    await first.kill();
    for (let i = 1; i <= KILLS; i += 1) {
        if (i % 5 === 0) {
            await killInStart(random);
        }
        const daemon = await startDaemon({ data, ready: false, driver: 'null' });
        await check(daemon);
        const editors = CLIENTS.map((client) => edit(daemon, client, random));
        await sleep(20 + random() * 400);
        await daemon.kill();
        await Promise.all(editors);
    }
    const last = await startDaemon({ data, ready: false, driver: 'null' });
    await check(last);
    await last.stop();
    sum.sent = CLIENTS.reduce((n, client) => n + sent[client], 0);
    assert.ok(sum.told > KILLS, 'editing went on between the kills');
    t.diagnostic(`${KILLS} kills, ${sum.told} edits told durable, ${sum.kept} kept, none lost, none twice`);
});
