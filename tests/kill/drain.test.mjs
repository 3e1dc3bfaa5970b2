// SPDX-License-Identifier: MIT
// SIGTERM: no edit that was applied is lost, everybody is told, and the end comes soon.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { after, test } from 'node:test';
import {
    ask,
    counter,
    logged,
    makeDirectory,
    removeDirectory,
    sleep,
    startDaemon,
    until,
} from '../support/daemon.mjs';
import { encodeMessage, Live } from '../support/live.mjs';

const data = makeDirectory();
after(() => removeDirectory(data));
const DRAIN_STILL_S = 8; // server/drain_limit.h
const PICTURES = 16; // as many as one client may have in the queue
const DOCUMENT = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

test('SIGTERM in the middle of editing', async (t) => {
    const daemon = await startDaemon({ data, driver: 'null', tileMs: 5 });
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
    const clients = await Promise.all(Array.from({ length: 8 }, () => Live.open(daemon, 's')));
    const stuck = await Live.open(daemon, 's');
    stuck.stopReading();
    const idle = net.connect(daemon.port, '127.0.0.1');
    idle.on('error', () => {});
    const pictures = Array.from({ length: PICTURES }, (_, i) => fetch(`${daemon.url}/v1/scenes/s/image.png?width=${3500 + i}&height=3500&samples=4`));
    await until(async () => (await counter(daemon, 'render_queue')) >= PICTURES, 'the orders');
    const editing = clients.map(async (live) => {
        for (let i = 0; !live.closed; i += 1) {
            live.set('/nodes/ball/params/radius', 1 + (i % 100) / 100);
            await sleep(2);
        }
    });
    await sleep(300);
    const start = Date.now();
    const { status } = await daemon.kill('SIGTERM');
    const took = Date.now() - start;
    await Promise.all(editing);
    assert.equal(status, 0, daemon.errors);
    assert.deepEqual((await Promise.all(pictures)).map((one) => one.status), Array(PICTURES).fill(503));
    let applied = 0;
    for (const live of clients) {
        const bye = live.messages.at(-1);
        assert.deepEqual([bye.type, bye.reason, bye.retry_ms], ['bye', 'shutting_down', 1000]);
        assert.equal(live.closeCode, 1001);
        const numbers = (durable) =>
            new Set(live.messages.filter((m) => m.type === 'applied' && m.durable === durable).map((m) => m.edit));
        assert.deepEqual([...numbers(true)], [...numbers(false)], 'what was applied was told durable');
        applied += numbers(true).size;
    }
    assert.ok(applied > 0);
    stuck.socket.destroy();
    idle.destroy();
    const again = await startDaemon({ data, ready: false, driver: 'null' });
    assert.equal((await ask(again, 'GET', '/v1/scenes')).scenes[0].revision, 1 + applied);
    await again.stop();
    t.diagnostic(`ended after ${took} ms, ${applied} edits applied and kept`);
});

// Where a client's bytes are unread when its connection is closed, its kernel hears of a reset, and
// what it was told may never be read.
test('SIGTERM while clients never stop talking', async () => {
    const daemon = await startDaemon({ data, ready: false });
    const clients = await Promise.all(Array.from({ length: 4 }, () => Live.open(daemon, 's', { ack: false })));
    const talk = encodeMessage(1, Buffer.from(`{"type":"ack","frame":0${' '.repeat(60000)}}`));
    const talking = clients.map(async (live) => {
        while (live.closeCode === null && !live.closed) {
            while (live.socket.writableLength < 4 * talk.length) {
                live.socket.write(talk);
            }
            await sleep(1);
        }
        await until(() => live.closed, 'the end of the connection');
    });
    await sleep(100);
    const { status } = await daemon.kill('SIGTERM');
    await Promise.all(talking);
    assert.equal(status, 0, daemon.errors);
    for (const live of clients) {
        assert.deepEqual([live.messages.at(-1).type, live.closeCode, live.error], ['bye', 1001, null]);
    }
});

/** Sends a request whose head is admitted; what is returned sends its body, and waits for the answer. */
async function beginPost(daemon, at, body) {
    const socket = net.connect(daemon.port, '127.0.0.1');
    let answer = '';
    socket.on('data', (bytes) => (answer += bytes));
    socket.on('error', () => {});
    const closed = new Promise((done) => socket.on('close', done));
    const fields = ['Content-Type: application/json', `Content-Length: ${body.length}`, 'Expect: 100-continue', 'Connection: close'];
    socket.write([`POST ${at} HTTP/1.1`, `Host: 127.0.0.1:${daemon.port}`, ...fields, '', ''].join('\r\n'));
    await until(() => answer.includes(' 100 '), 'the head to be admitted');
    return async () => {
        socket.write(body);
        await closed;
        return answer;
    };
}

test('pictures of examples and of documents are answered, also those asked for at the last moment', async () => {
    const daemon = await startDaemon({ data, driver: 'null', tileMs: 5 });
    const stuck = await Live.open(daemon, 's');
    stuck.stopReading(); // for three seconds its answer to the close is awaited
    const pictures = ['snowman', 'chess'].flatMap((example) =>
        [3500, 3600, 3700].map((side) => fetch(`${daemon.url}/v1/examples/${example}/image.png?width=${side}&height=${side}`)),
    );
    await until(async () => (await counter(daemon, 'render_queue')) >= pictures.length, 'the orders');
    const rest = await beginPost(daemon, '/v1/render', JSON.stringify({ scene: DOCUMENT, width: 64, height: 48 }));
    daemon.child.kill('SIGTERM');
    await logged(daemon, /draining/);
    for (const picture of pictures) {
        const answer = await picture;
        assert.equal(answer.status, 503);
        assert.equal((await answer.json()).detail, 'the server is shutting down');
    }
    assert.match(await rest(), /HTTP\/1\.1 503 [^]*the server is shutting down/);
    stuck.socket.destroy();
    assert.equal((await daemon.exited).status, 0, daemon.errors);
});

test('a second signal ends at once', async () => {
    const daemon = await startDaemon({ data, ready: false, driver: 'null' });
    const stuck = await Live.open(daemon, 's');
    stuck.stopReading(); // for three seconds its answer to the close is awaited
    const drains = new Promise((done) => daemon.child.stderr.on('data', () => /draining/.test(daemon.errors) && done()));
    daemon.child.kill('SIGTERM');
    await drains;
    daemon.child.kill('SIGTERM');
    const { status, signal } = await daemon.exited;
    assert.equal(status, 1, `${signal} ${daemon.errors}`);
    assert.doesNotMatch(daemon.errors, /took too long|ended/);
    stuck.socket.destroy();
});

/** A daemon with an edit whose commit makes it wait: for ever (0), or for so many seconds in which it computes. */
async function drainsSlowly(seconds) {
    const file = path.join(data, 'sync');
    const daemon = await startDaemon({ data, ready: false, driver: ['null', 'sync'], environment: { SYNC_FILE: file } });
    await ask(daemon, 'POST', `/v1/scenes?id=waits-${seconds}`, DOCUMENT);
    const live = await Live.open(daemon, `waits-${seconds}`);
    fs.writeFileSync(file, 'x'.repeat(seconds));
    live.set('/name', 'waited');
    await until(() => !fs.existsSync(file), 'the commit that waits');
    daemon.child.kill('SIGTERM');
    return { daemon, ...(await daemon.exited) };
}

test('a drain that hangs is ended, and one that goes on is not, however long it takes', async () => {
    const hung = await drainsSlowly(0);
    assert.equal(hung.status, 1);
    assert.match(hung.daemon.errors, /the drain hangs, ending now/);
    const slow = await drainsSlowly(DRAIN_STILL_S + 2);
    assert.equal(slow.status, 0, slow.daemon.errors);
    const again = await startDaemon({ data, ready: false, driver: 'null' });
    assert.equal((await ask(again, 'GET', `/v1/scenes/waits-${DRAIN_STILL_S + 2}`)).name, 'waited');
    await again.stop();
});

test('a data directory has one daemon', async () => {
    const daemon = await startDaemon({ data, ready: false, driver: 'null' });
    await assert.rejects(startDaemon({ data, ready: false, driver: 'null' }), /another fieldcast uses this directory/);
    await daemon.stop();
});

test('a commit that fails ends the daemon, and nothing is told durable', async () => {
    const daemon = await startDaemon({ data, ready: false, driver: 'null', limits: 'ulimit -f 2000' });
    const live = await Live.open(daemon, 's');
    for (let i = 0; !live.closed && i < 200000; i += 1) {
        live.set('/name', `${'x'.repeat(150)} ${i}`);
        if (i % 50 === 0) {
            await sleep(1);
        }
    }
    const { status, signal } = await daemon.exited;
    assert.equal(status, 74, `${signal} ${daemon.errors.slice(-500)}`);
    await logged(daemon, /error store: /);
    const durable = live.messages.filter((m) => m.type === 'applied' && m.durable).map((m) => m.edit);
    const again = await startDaemon({ data, ready: false, driver: 'null' });
    const back = await Live.open(again, 's', { client: live.client });
    assert.ok(back.welcome.last_edit >= Math.max(...durable));
    assert.ok(durable.length > 0);
    await back.close();
    await again.stop();
});
