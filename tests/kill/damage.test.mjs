// SPDX-License-Identifier: MIT
// A database of which pages are lost: it is said at the start, what can be read is served.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import {
    ask,
    counter,
    logged,
    makeDirectory,
    program,
    removeDirectory,
    startDaemon,
} from '../support/daemon.mjs';

const PAGE = 4096;
const data = makeDirectory();
const file = path.join(data, 'scenes.sqlite');
const marked = (mark) => ({ format: 'fieldcast/1', name: mark.repeat(20), root: { type: 'sphere' } });

const doctor = () =>
    new Promise((done) => {
        execFile(program, ['doctor', '--port', '0', '--data', data], (error, stdout) => done({ status: error?.code ?? 0, stdout }));
    });

/** Zeros instead of every page that holds the document's text. */
function losePages(mark) {
    const bytes = fs.readFileSync(file);
    let lost = 0;
    for (let at = 2 * PAGE; at < bytes.length; at += PAGE) {
        const page = bytes.subarray(at, at + PAGE);
        if (page.includes(mark) && page.includes('"format"')) {
            page.fill(0);
            lost += 1;
        }
    }
    fs.writeFileSync(file, bytes);
    return lost;
}

let daemon;
before(async () => {
    daemon = await startDaemon({ data, driver: 'null', ready: false });
    // More than one page of documents, so that not all are lost together.
    for (let i = 0; i < 40; i += 1) {
        await ask(daemon, 'POST', `/v1/scenes?id=fine-${i}`, marked('fine'));
    }
    await ask(daemon, 'POST', '/v1/scenes?id=lost', marked('lost'));
    await daemon.kill('SIGTERM');
});
after(async () => {
    await daemon.stop();
    removeDirectory(data);
});

test('a whole one is said to be whole', async () => {
    const { stdout } = await doctor();
    assert.match(stdout, /^ok +scenes +no damage is found$/m);
});

test('a damaged one is told by the log, by readiness, by doctor, and counted', async () => {
    assert.ok(losePages('lostlost') > 0);
    daemon = await startDaemon({ data, driver: 'null', ready: false });
    await logged(daemon, /scenes\.sqlite is damaged: /);
    const ready = await fetch(`${daemon.url}/readyz`);
    assert.equal(ready.status, 503);
    assert.match((await ready.json()).detail, /the database is damaged: /);
    assert.equal((await fetch(`${daemon.url}/healthz`)).status, 200);
    assert.equal(await counter(daemon, 'scene_reads_failed_total'), 0);
    assert.equal((await fetch(`${daemon.url}/v1/scenes/lost`)).status, 500);
    assert.equal(await counter(daemon, 'scene_reads_failed_total'), 1);
    assert.equal((await fetch(`${daemon.url}/v1/scenes/fine-0`)).status, 200);
    const { status, stdout } = await doctor();
    assert.notEqual(status, 0);
    assert.match(stdout, /^FAIL +scenes +\S+scenes\.sqlite: damaged: /m);
});
