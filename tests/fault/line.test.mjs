// SPDX-License-Identifier: MIT
// Sockets have the smallest buffers there are, so that writes are short, and every third wait is interrupted by
// a signal (support/drivers/socket_driver.c), in the daemon and in the render process: nothing is lost or changed.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { ask, counter, makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const EDITS = 40;
const NODES = 300;
const RADIUS = '/nodes/ball/params/radius';
const DOCUMENT = {
    format: 'fieldcast/1',
    root: {
        id: 'root',
        type: 'union',
        children: [{ id: 'ball', type: 'sphere' }].concat(Array.from({ length: NODES }, (_, i) => ({ id: `n${i}`, type: 'box', visible: false }))),
    },
};

// In the order of support/drivers/socket_driver.c.
const SITES = ['sockets accepted', 'ends of pairs', 'short sends', 'polls interrupted', 'epolls interrupted'];

let folder;
let file;
let whole;
let torn;
before(async () => {
    folder = makeDirectory();
    file = path.join(folder, 'sites');
    fs.writeFileSync(file, Buffer.alloc(8 * SITES.length));
    whole = await startDaemon({ driver: 'null' });
    torn = await startDaemon({ driver: ['socket', 'null'], environment: { SOCKET_EVERY: '3', SOCKET_FILE: file } });
    for (const daemon of [whole, torn]) {
        await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
    }
});
after(async () => {
    await Promise.all([whole?.stop(), torn?.stop()]);
    removeDirectory(folder);
});

const bytesOf = async (daemon, at) => {
    const answer = await fetch(daemon.url + at);
    assert.equal(answer.status, 200);
    return Buffer.from(await answer.arrayBuffer());
};

test('documents and pictures are the same to the byte', async () => {
    for (const at of ['/v1/scenes/s', '/v1/examples', '/v1/scenes/s/image.png?width=300&height=200', '/v1/scenes/s/image.png?width=64&height=48&aov=color,depth']) {
        const [good, other] = [await bytesOf(whole, at), await bytesOf(torn, at)];
        assert.ok(good.length > 0 && good.equals(other), `${at}: ${good.length} and ${other.length} bytes`);
    }
});

test('edits and frames arrive, each once', async () => {
    const [author, watcher] = [await Live.open(torn, 's'), await Live.open(torn, 's')];
    watcher.look();
    await watcher.nextFrame();
    for (let i = 1; i <= EDITS; i += 1) {
        author.set(RADIUS, 1 + i / 100);
    }
    const { revision } = await author.next('applied', { edit: EDITS, durable: true });
    const durable = author.messages.filter((m) => m.type === 'applied' && m.durable);
    assert.equal(new Set(durable.map((m) => m.edit)).size, EDITS);
    await watcher.nextFrame((frame) => frame.lossless && frame.revision === revision);
    assert.equal(author.closed || watcher.closed, false);
    const { document } = { document: JSON.parse(await bytesOf(torn, '/v1/scenes/s')) };
    assert.ok(JSON.stringify(document).includes(`${1 + EDITS / 100}`));
    assert.equal(await counter(torn, 'worker_restarts_total'), 0);
    await Promise.all([author.close(), watcher.close()]);
});

test('all of this was done to the line', (t) => {
    const bytes = fs.readFileSync(file);
    const counts = SITES.map((site, i) => [site, Number(bytes.readBigInt64LE(8 * i))]);
    t.diagnostic(counts.map(([site, count]) => `${count} ${site}`).join(', '));
    assert.deepEqual(counts.filter(([, count]) => count === 0), []);
});
