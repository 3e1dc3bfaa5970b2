// SPDX-License-Identifier: MIT
// Memory that runs out while the daemon answers requests and live connections (support/drivers/memory_driver.c):
// of each act some of the allocations fail, each in a life of its own. The daemon goes on, or ends by abort, as
// protocol/memory.h says, or by a commit that fails; an edit that was told durable is there.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { ask, makeDirectory, removeDirectory, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const LIVES = Number(process.env.MEMORY_LIVES ?? 12); // allocations that fail, of each act
const STORE_EXIT_STATUS = 74; // a commit that fails
const NEVER = 1n << 62n;
const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

let folder;
let file;
let daemon = null;
let durable = 0;
before(() => {
    folder = makeDirectory();
    file = path.join(folder, 'memory');
    fs.writeFileSync(file, Buffer.alloc(24));
});
after(async () => {
    const end = await daemon?.kill('SIGTERM'); // the last allocation may fail only now
    removeDirectory(folder);
    assert.ok(!end || end.status === 0 || isForMemory(end), JSON.stringify(end));
});

/** How it ends where memory runs out. */
const isForMemory = ({ signal, status }) => signal === 'SIGABRT' || status === STORE_EXIT_STATUS;

// The daemon has the file mapped: it is written, not replaced.
function write(...numbers) {
    const bytes = Buffer.alloc(24);
    numbers.forEach((number, i) => bytes.writeBigInt64LE(BigInt(number), 8 * i));
    const fd = fs.openSync(file, 'r+');
    fs.writeSync(fd, bytes, 0, 24, 0);
    fs.closeSync(fd);
}
const allocations = () => Number(fs.readFileSync(file).readBigInt64LE(8));

async function start() {
    write(0, 0, NEVER);
    const environment = { MEMORY_FILE: file };
    daemon = await startDaemon({ data: path.join(folder, 'data'), driver: ['memory', 'null'], environment });
    daemon.exited.then(() => (daemon = null));
    const { scenes } = await ask(daemon, 'GET', '/v1/scenes');
    const revision = scenes.find(({ id }) => id === 's')?.revision ?? 0;
    assert.ok(revision >= durable, `revision ${durable} was told durable, ${revision} is there`);
    if (revision === 0) {
        await ask(daemon, 'PUT', '/v1/scenes/s', ball);
    }
}

const json = { 'content-type': 'application/json' };
const picture = (i) => JSON.stringify({ scene: 's', width: 16, height: 16, camera: { fov: 20 + i / 1000 } });

/** What a client does; each answer must be there or the daemon gone. */
const ACTS = {
    'a document read and written': async () => {
        await (await fetch(`${daemon.url}/v1/scenes/s`)).text();
        await (await fetch(`${daemon.url}/v1/scenes/other`, { method: 'PUT', headers: json, body: JSON.stringify(ball) })).text();
    },
    'a picture': async (i) => {
        await (await fetch(`${daemon.url}/v1/render`, { method: 'POST', headers: json, body: picture(i) })).arrayBuffer();
    },
    'a live connection that edits and looks': async (i) => {
        const live = await Live.open(daemon, 's');
        const edit = live.set('/nodes/ball/params/radius', 1 + i / 1000);
        const { type, revision } = await live.next('applied', { edit, durable: true });
        durable = type === 'closed' ? durable : revision;
        live.look({ camera: { position: [i, 1, 5] } });
        await until(() => live.frames.length || live.closed, 'a frame');
        await live.close();
    },
};

/** The act is over, or the daemon has ended; gives how. A connection alone may be lost, too. */
async function during(act, i, nth) {
    const { exited, pid, url } = daemon;
    const isThere = () => until(async () => !daemon || (await fetch(`${url}/healthz`).catch(() => null))?.ok, 'an answer or the end');
    write(pid, 0, nth);
    await Promise.race([act(i).catch(isThere), exited]);
    if (nth !== NEVER) {
        // Where an act makes fewer than it did, an answer makes the rest.
        await until(async () => (await isThere()) && (!daemon || allocations() >= nth), `allocation ${nth}`);
    }
    return daemon ? null : exited;
}

/** The same with an allocation that is known to have failed: a daemon may end only now by the one of the life before. */
async function failing(act, i, nth) {
    for (let tries = 0; tries < 2; tries += 1) {
        if (!daemon) {
            await start();
            await act(900 + i); // what is loaded once
        }
        const end = await during(act, i, nth);
        assert.ok(end === null || isForMemory(end), `allocation ${nth}: ${JSON.stringify(end)}`);
        if (allocations() >= nth) {
            return end;
        }
    }
    return assert.fail(`allocation ${nth} was not reached`);
}

for (const [name, act] of Object.entries(ACTS)) {
    test(name, async (t) => {
        let ends = 0;
        if (daemon) {
            await during(act, 900, NEVER); // it may end by an allocation of the act before
        }
        if (!daemon) {
            await start();
            await act(900);
        }
        assert.equal(await during(act, 800, NEVER), null);
        const count = allocations();
        assert.ok(count > LIVES, `${count} allocations`);
        for (let i = 1; i <= LIVES; i += 1) {
            ends += (await failing(act, i, Math.ceil((count * i) / (LIVES + 1)))) !== null;
        }
        t.diagnostic(`${count} allocations, ${ends} of ${LIVES} that failed ended the daemon`);
    });
}
