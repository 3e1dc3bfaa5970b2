// SPDX-License-Identifier: MIT
// The time of day is set forth and back while clients edit and watch (support/drivers/clock_driver.c):
// nobody is cut off and nothing is cut short, and what has a limit of time still ends.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import net from 'node:net';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { ask, counter, makeDirectory, removeDirectory, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const HOUR = 3600;
const JUMPS = [5 * HOUR, -7 * HOUR, 0, 24 * 365 * HOUR, -24 * 365 * HOUR, 90, -90, 0].map(BigInt);
const RADIUS = '/nodes/ball/params/radius';
const ALL = process.env.CLOCK_ALL ? { CLOCK_ALL: '1' } : {}; // set: the test must fail

let daemon;
let folder;
let file;
before(async () => {
    folder = makeDirectory();
    file = path.join(folder, 'offset');
    setClock(0n);
    daemon = await startDaemon({ driver: ['clock', 'null'], tileMs: 20, environment: { CLOCK_FILE: file, ...ALL } });
    await ask(daemon, 'POST', '/v1/scenes?id=s', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
});
after(async () => {
    await daemon?.stop();
    removeDirectory(folder);
});

// The daemon has the file mapped: it is written, not replaced.
function setClock(seconds) {
    const bytes = Buffer.alloc(8);
    bytes.writeBigInt64LE(seconds);
    const fd = fs.openSync(file, fs.existsSync(file) ? 'r+' : 'w');
    fs.writeSync(fd, bytes, 0, 8, 0);
    fs.closeSync(fd);
}

const modified = async () => (await ask(daemon, 'GET', '/v1/scenes')).scenes[0].modified;

test('edits, frames, pictures and idle connections go on', async () => {
    const [author, watcher, idle] = [await Live.open(daemon, 's'), await Live.open(daemon, 's'), await Live.open(daemon, 's')];
    const agent = new http.Agent({ keepAlive: true, maxSockets: 1 });
    const sockets = new Set();
    const get = () =>
        new Promise((done, fail) => {
            const request = http.get(`${daemon.url}/healthz`, { agent }, (answer) => answer.resume().on('end', () => done(answer)));
            request.on('socket', (socket) => sockets.add(socket)).on('error', fail);
        });
    watcher.look();
    await watcher.nextFrame();
    const times = new Set();
    for (const [i, jump] of JUMPS.entries()) {
        const picture = fetch(`${daemon.url}/v1/scenes/s/image.png?width=${400 + i}&height=300`);
        await until(async () => (await counter(daemon, 'render_queue')) > 0, 'the order');
        setClock(jump);
        const edit = author.set(RADIUS, 1 + i / 10);
        const { revision } = await author.next('applied', { edit, durable: true });
        await watcher.nextFrame((frame) => frame.lossless && frame.revision === revision);
        assert.equal((await picture).status, 200);
        assert.equal((await get()).statusCode, 200);
        times.add(JSON.stringify(await modified()));
    }
    assert.equal(times.size, JUMPS.length, 'the clock of the daemon is the one that jumps');
    assert.equal(sockets.size, 1, 'a connection at rest is kept');
    for (const live of [author, watcher, idle]) {
        assert.equal(live.closed, false);
        assert.equal(live.find('notice', {}) ?? null, null);
    }
    assert.equal(await counter(daemon, 'worker_restarts_total'), 0);
    agent.destroy();
    await Promise.all([author.close(), watcher.close(), idle.close()]);
});

test('a request that is never finished is ended although the clock was set back', async () => {
    setClock(0n);
    const socket = net.connect(daemon.port, '127.0.0.1');
    let text = '';
    let closed = false;
    socket.on('data', (bytes) => (text += bytes)).on('close', () => (closed = true)).on('error', () => {});
    socket.write('GET / HTTP/1.1\r\nHost: ');
    await until(async () => (await fetch(`${daemon.url}/healthz`)).ok, 'the daemon to have read it');
    setClock(BigInt(-7 * HOUR));
    await until(() => closed, 'its end');
    assert.match(text, /^HTTP\/1\.1 408 /);
});
