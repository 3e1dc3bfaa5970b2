// SPDX-License-Identifier: MIT
// A database of which pages are lost: it is said at the start, what can be read is served.
import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import {
    ask,
    counter,
    logged,
    makeDirectory,
    program,
    removeDirectory,
    startDaemon,
    until,
} from '../support/daemon.mjs';

const PAGE = 4096;
const TURNED_BITS = 8; // of a file of some 25 pages, so that now and then something is left to serve
const data = makeDirectory();
const file = path.join(data, 'scenes.sqlite');
const marked = (mark, id) => ({ format: 'fieldcast/1', name: `${mark.repeat(20)} ${id}`, root: { type: 'sphere' } });

/** Makes a scene for each id. Gives what is read of each while all is well. */
async function make(daemon, mark, ids) {
    const written = new Map();
    for (const id of ids) {
        await ask(daemon, 'POST', `/v1/scenes?id=${id}`, marked(mark, id));
        written.set(id, await ask(daemon, 'GET', `/v1/scenes/${id}`));
    }
    return written;
}

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

/** A copy of the data directory, to be damaged. */
function copyData() {
    const copy = makeDirectory();
    fs.cpSync(data, copy, { recursive: true });
    return copy;
}

/** Numbers that look random, and are the same each time. */
function random(seed) {
    let state = seed;
    return (below) => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor((state / 2 ** 32) * below);
    };
}

/**
 * What comes of a damaged directory: the daemon refuses it with a reason, or it serves what can be read, as it
 * was acknowledged, and says of each other scene why not. It ends by itself in the first case alone.
 */
async function outcome(t, directory, written) {
    const child = spawn(program, ['serve', '--port', '0', '--data', directory, '--device', 'none']);
    t.after(() => child.kill('SIGKILL'));
    let output = '';
    let errors = '';
    child.stdout.on('data', (bytes) => (output += bytes));
    child.stderr.on('data', (bytes) => (errors += bytes));
    let end = null;
    const closed = new Promise((done) => child.on('close', (status, signal) => done((end = { status, signal }))));
    const url = await until(() => /listening on (http:\S+)\//.exec(output)?.[1] ?? (end && 'none'), 'the daemon to listen or to end');
    if (url === 'none') {
        assert.deepEqual(end, { status: 1, signal: null }, errors);
        assert.match(errors, /^fieldcast: \S.*$/m);
        return { refused: errors.trim().split('\n').at(-1) };
    }
    const { scenes } = await (await fetch(`${url}/v1/scenes`)).json();
    const served = { fine: [], unreadable: [] };
    for (const { id } of scenes) {
        const answer = await fetch(`${url}/v1/scenes/${id}`);
        const body = await answer.json();
        if (answer.status === 200) {
            assert.deepEqual(body, written.get(id), id);
            served.fine.push(id);
        } else {
            assert.ok(answer.status === 500 && body.detail, `${id}: ${answer.status} ${JSON.stringify(body)}`);
            served.unreadable.push(id);
        }
    }
    assert.equal(end, null, errors);
    child.kill('SIGTERM');
    await closed;
    assert.deepEqual(end, { status: 0, signal: null }, errors);
    return served;
}

/** Turns bits over, but for those of documents' texts: they have no checksum, and what stands there is served. */
function turnBits(bytes, seed) {
    const next = random(seed);
    const texts = [...bytes.toString('latin1').matchAll(/\{"format".*?\}\}/gs)];
    for (let turned = 0; turned < TURNED_BITS; ) {
        const at = next(bytes.length);
        if (!texts.some(({ index, 0: text }) => at >= index && at < index + text.length)) {
            bytes[at] ^= 1 << next(8);
            turned += 1;
        }
    }
    return bytes;
}

/** Takes bytes of the database, gives other ones. */
const DAMAGES = {
    'garbage': () => Buffer.alloc(20000, 'no database '),
    'the first half of it': (bytes) => bytes.subarray(0, bytes.length >> 1),
    'nothing': () => Buffer.alloc(0),
    'a version of the future': (bytes) => bytes.fill(0xff, 60, 64), // the header's user version
    'another magic': (bytes) => bytes.fill(0, 0, 16),
    ...Object.fromEntries(
        Array.from({ length: 8 }, (_, seed) => [
            `${TURNED_BITS} bits turned over, seed ${seed + 1}`,
            (bytes) => turnBits(bytes, seed + 1),
        ]),
    ),
};

let daemon;
let written;
before(async () => {
    daemon = await startDaemon({ data, driver: 'null', ready: false });
    // More than one page of documents, so that not all are lost together.
    const fine = await make(daemon, 'fine', Array.from({ length: 40 }, (_, i) => `fine-${i}`));
    written = new Map([...fine, ...(await make(daemon, 'lost', ['lost']))]);
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

for (const [what, damage] of Object.entries(DAMAGES)) {
    test(`${what}: refused with a reason, or served as far as it can be read`, async (t) => {
        const copy = copyData();
        const name = path.join(copy, 'scenes.sqlite');
        fs.writeFileSync(name, damage(fs.readFileSync(name)));
        const { refused, fine, unreadable } = await outcome(t, copy, written);
        t.diagnostic(refused ?? `${fine.length} are served, ${unreadable.length} cannot be read`);
        removeDirectory(copy);
    });
}

test('a log of writes that is cut or grown: an older state, or a refusal', async (t) => {
    const live = makeDirectory();
    const writer = await startDaemon({ data: live, driver: 'null', ready: false });
    const ids = Array.from({ length: 20 }, (_, i) => `scene-${i}`);
    const whole = await make(writer, 'fine', ids);
    await writer.kill('SIGKILL');
    const log = fs.readFileSync(path.join(live, 'scenes.sqlite-wal'));
    assert.ok(log.length > 0);
    for (const bytes of [log.subarray(0, log.length >> 1), log.subarray(0, 7), Buffer.concat([log, Buffer.alloc(5000, 7)])]) {
        const copy = makeDirectory();
        fs.cpSync(live, copy, { recursive: true });
        fs.writeFileSync(path.join(copy, 'scenes.sqlite-wal'), bytes);
        const { fine, refused } = await outcome(t, copy, whole);
        assert.ok(refused || isDeepStrictEqual(new Set(fine), new Set(ids.slice(0, fine.length))), `${fine}`);
        t.diagnostic(refused ?? `${fine.length} scenes`);
        removeDirectory(copy);
    }
    await writer.stop();
    removeDirectory(live);
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
