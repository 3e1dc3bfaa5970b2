// SPDX-License-Identifier: MIT
// The library over time: what was acknowledged survives kill -9, its limits hold from both sides, its
// pictures show what it holds, and a scene keeps its copy. Single requests are in library.test.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { ask, makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';

const FORMAT = 'fieldcast-library/1';
const KILLED = -2; // before a call (support/drivers/disk_driver.h)
const WRITES = 4; // by which one life gets further than the one before
const document = (name, root) => ({ format: 'fieldcast/1', name, root });
const entry = (name, root = { type: 'sphere' }) => ({ kind: 'model', document: document(name, root) });
const file = (entries) => ({ format: FORMAT, entries });
const ids = async (daemon) => (await ask(daemon, 'GET', '/v1/library')).entries.map(({ id }) => id);

/** Status and body of a request that may be refused. */
async function answerOf(daemon, method, path, body) {
    const answer = await fetch(daemon.url + path, {
        method,
        ...(body && { body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' } }),
    });
    const text = await answer.text();
    return { status: answer.status, headers: answer.headers, body: text ? JSON.parse(text) : null };
}

const many = (count, of) => Array.from({ length: count }, (_, i) => of(i));

test('what was acknowledged is there after kill -9', async () => {
    const data = makeDirectory();
    const expected = new Set();
    for (let life = 0; life < 4; life += 1) {
        const daemon = await startDaemon({ data, ready: false });
        assert.deepEqual(new Set(await ids(daemon)), expected);
        for (let i = 0; i < 5; i += 1) {
            await ask(daemon, 'PUT', `/v1/library/e-${life}-${i}`, entry(`Entry ${i} of ${life}`));
            expected.add(`e-${life}-${i}`);
        }
        await ask(daemon, 'DELETE', `/v1/library/e-${life}-0`);
        expected.delete(`e-${life}-0`);
        await ask(daemon, 'POST', '/v1/library', file([{ id: `f-${life}`, ...entry('F') }, { id: `g-${life}`, ...entry('G') }]));
        expected.add(`f-${life}`).add(`g-${life}`);
        await daemon.kill();
    }
    const daemon = await startDaemon({ data, ready: false });
    assert.deepEqual(new Set(await ids(daemon)), expected);
    const read = await ask(daemon, 'GET', '/v1/library/e-2-3');
    assert.equal(read.document.name, 'Entry 3 of 2');
    await daemon.stop();
    removeDirectory(data);
});

test('of a file that the daemon was killed over while it was written, nothing is there', async (t) => {
    const data = makeDirectory();
    const names = many(200, (i) => `x-${i}`);
    await (await startDaemon({ data, ready: false })).stop();
    let answer = null;
    let lives = 0;
    for (; !answer; lives += 1) {
        const fault = `${data}/scenes.sqlite-wal write ${1 + lives * WRITES} ${KILLED}`;
        const daemon = await startDaemon({ data, ready: false, driver: ['disk', 'null'], environment: { DISK_FAULT: fault } });
        assert.deepEqual(await ids(daemon), []);
        answer = await answerOf(daemon, 'POST', '/v1/library', file(names.map((id) => ({ id, ...entry(id) })))).catch(() => null);
        await daemon.kill();
    }
    t.diagnostic(`killed ${lives - 1} times`);
    assert.ok(lives > 3, `${lives} lives`);
    assert.equal(answer.status, 201);
    const daemon = await startDaemon({ data, ready: false });
    assert.deepEqual(new Set(await ids(daemon)), new Set(names));
    await daemon.stop();
    removeDirectory(data);
});

describe('limits', () => {
    let daemon;
    before(async () => (daemon = await startDaemon({ ready: false })));
    after(() => daemon.stop());

    const limits = async () => {
        const { limits: rows } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
        return (name) => rows.find((row) => row.name === name).value;
    };
    const empty = async () => {
        for (const id of await ids(daemon)) {
            await ask(daemon, 'DELETE', `/v1/library/${id}`);
        }
    };

    test('nodes of an entry', async () => {
        const most = (await limits())('library_nodes');
        const flat = (count) => ({ type: 'union', children: many(count - 1, () => ({ type: 'sphere' })) });
        assert.equal((await answerOf(daemon, 'PUT', '/v1/library/most', entry('Most', flat(most)))).status, 201);
        const refused = await answerOf(daemon, 'PUT', '/v1/library/more', entry('More', flat(most + 1)));
        assert.equal(refused.status, 422);
        assert.equal(refused.body.code, 'limit');
        assert.match(refused.body.detail, new RegExp(`${most + 1}.*${most}`));
        assert.deepEqual(await ids(daemon), ['most']);
        await empty();
    });

    test('entries', async (t) => {
        const most = (await limits())('library_entries');
        const full = file(many(most, (i) => ({ id: `n-${i}`, ...entry('N') })));
        const long = await answerOf(daemon, 'POST', '/v1/library', file([...full.entries, entry('M')]));
        assert.equal(long.body.place, '/entries');
        assert.deepEqual(await ids(daemon), []);
        assert.equal((await answerOf(daemon, 'POST', '/v1/library', full)).status, 201);
        const refused = await answerOf(daemon, 'PUT', '/v1/library/one', entry('One more'));
        assert.equal(refused.status, 507);
        assert.equal(refused.body.place, '/v1/library');
        assert.match(refused.body.detail, new RegExp(`${most + 1} entries.*${most} entries`));
        assert.equal((await answerOf(daemon, 'POST', '/v1/library', file([entry('One more')]))).status, 507);
        assert.equal((await answerOf(daemon, 'PUT', '/v1/library/n-0', entry('Another'))).status, 200, 'one in the place of one');
        await ask(daemon, 'DELETE', '/v1/library/n-1');
        assert.equal((await answerOf(daemon, 'PUT', '/v1/library/one', entry('One more'))).status, 201);
        assert.equal((await ids(daemon)).length, most);
        // A full library can be moved elsewhere.
        const all = await ask(daemon, 'GET', '/v1/library.json');
        const other = await startDaemon({ ready: false });
        t.after(() => other.stop());
        assert.equal((await answerOf(other, 'POST', '/v1/library', all)).status, 201);
        assert.deepEqual(await ask(other, 'GET', '/v1/library.json'), all);
        await empty();
    });

    test('bytes of all documents', async () => {
        const most = (await limits())('library_bytes');
        const children = many(4000, (i) => ({ type: 'sphere', name: `${'n'.repeat(100)}-${i}` }));
        let answer;
        let kept = 0;
        for (; kept < 100; kept += 1) {
            answer = await answerOf(daemon, 'PUT', `/v1/library/l-${kept}`, entry('Large', { type: 'union', children }));
            if (answer.status !== 201) {
                break;
            }
        }
        assert.equal(answer.status, 507);
        const said = /of (\d+) bytes .* (\d+) bytes/.exec(answer.body.detail);
        assert.ok(Number(said[1]) > most && Number(said[2]) === most, answer.body.detail);
        assert.ok((Number(said[1]) / (kept + 1)) * kept <= most, 'no room was left for one more');
        assert.equal((await ids(daemon)).length, kept);
        const all = await fetch(`${daemon.url}/v1/library.json`);
        assert.ok((await all.arrayBuffer()).byteLength < 2 * most);
    });
});

describe('pictures and copies', () => {
    let daemon;
    before(async () => (daemon = await startDaemon()));
    after(() => daemon.stop());

    const red = { shader: 'unlit', properties: { color: [1, 0, 0] } };
    const ball = { type: 'sphere', material: 'red' };
    const withRed = (name, kind) => ({ kind, document: { ...document(name, ball), materials: { red } } });
    const middle = async (id) => {
        const answer = await fetch(`${daemon.url}/v1/library/${id}/picture.png?width=24`);
        assert.equal(answer.status, 200);
        const { width, height, channels, pixels } = decodePng(Buffer.from(await answer.arrayBuffer()));
        const at = (x, y) => [...pixels.subarray((y * width + x) * channels, (y * width + x + 1) * channels)];
        return { width, height, center: at(width >> 1, height >> 1), corner: at(0, 0) };
    };

    test('a picture shows the entry before nothing', async () => {
        await ask(daemon, 'PUT', '/v1/library/ball', withRed('Ball', 'model'));
        const { width, height, center, corner } = await middle('ball');
        assert.deepEqual([width, height], [24, 16]);
        assert.ok(center[0] > 200 && center[1] < 60 && center[2] < 60 && center[3] === 255, String(center));
        assert.equal(corner[3], 0);
    });

    test('it has a tag, and changes with its entry', async () => {
        const first = await fetch(`${daemon.url}/v1/library/ball/picture.png`);
        const headers = { 'If-None-Match': first.headers.get('ETag') };
        assert.equal((await fetch(`${daemon.url}/v1/library/ball/picture.png`, { headers })).status, 304);
        const green = { ...withRed('Ball', 'model') };
        green.document.materials = { red: { ...red, properties: { color: [0, 1, 0] } } };
        await ask(daemon, 'PUT', '/v1/library/ball', green);
        assert.equal((await fetch(`${daemon.url}/v1/library/ball/picture.png`, { headers })).status, 200);
        assert.ok((await middle('ball')).center[1] > 200);
    });

    test('an entry that the client has is not sent again until it changes', async () => {
        const at = `${daemon.url}/v1/library/tagged`;
        await ask(daemon, 'PUT', '/v1/library/tagged', withRed('Tagged', 'model'));
        const tag = (await fetch(at)).headers.get('ETag');
        const asked = (...tags) => fetch(at, { headers: { 'If-None-Match': tags.join(', ') } });
        for (const known of [await asked(tag), await asked('"other"', `W/${tag}`)]) {
            assert.deepEqual([known.status, known.headers.get('ETag'), await known.text()], [304, tag, '']);
        }
        await ask(daemon, 'PUT', '/v1/library/tagged', withRed('Changed', 'model'));
        const changed = await asked(tag);
        assert.equal(changed.status, 200);
        assert.notEqual(changed.headers.get('ETag'), tag);
        assert.equal((await changed.json()).document.name, 'Changed');
        await ask(daemon, 'DELETE', '/v1/library/tagged');
    });

    test('a scene keeps what it took when the entry goes', async () => {
        const { document: copy } = await ask(daemon, 'GET', '/v1/library/ball');
        await ask(daemon, 'POST', '/v1/scenes?id=taker', copy);
        await ask(daemon, 'DELETE', '/v1/library/ball');
        assert.deepEqual(await ask(daemon, 'GET', '/v1/scenes/taker'), copy);
    });

    test('without code none is taken, and the rest is', async (t) => {
        const other = await startDaemon({ ready: false, args: ['--code', 'off'] });
        t.after(() => other.stop());
        const code = { type: 'field', params: { code: 'float sdf(vec3 p) { return length(p) - 1.0; }' } };
        const refused = await answerOf(other, 'PUT', '/v1/library/code', { kind: 'primitive', document: document('Code', code) });
        assert.equal(refused.status, 403);
        const inFile = await answerOf(other, 'POST', '/v1/library', file([entry('Plain'), entry('Code', code)]));
        assert.equal(inFile.status, 403);
        assert.deepEqual(await ids(other), []);
        assert.equal((await answerOf(other, 'PUT', '/v1/library/plain', entry('Plain'))).status, 201);
    });

    test('with a token nobody gets in without it', async (t) => {
        const data = makeDirectory();
        const { writeFileSync } = await import('node:fs');
        writeFileSync(`${data}/token`, 'secret-of-this-test\n');
        const other = await startDaemon({ ready: false, args: ['--token-file', `${data}/token`] });
        t.after(async () => {
            await other.stop();
            removeDirectory(data);
        });
        for (const [method, path] of [
            ['GET', '/v1/library'],
            ['GET', '/v1/library.json'],
            ['POST', '/v1/library'],
            ['GET', '/v1/library/x'],
            ['PUT', '/v1/library/x'],
            ['DELETE', '/v1/library/x'],
            ['GET', '/v1/library/x/picture.png'],
        ]) {
            const body = method === 'PUT' || method === 'POST' ? entry('X') : null;
            assert.equal((await answerOf(other, method, path, body)).status, 401, `${method} ${path}`);
        }
    });
});
