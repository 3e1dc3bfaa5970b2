// SPDX-License-Identifier: MIT
// Bases over REST: begun, looked at while they are made, cancelled. No clock decides.
import assert from 'node:assert/strict';
import http from 'node:http';
import { after, before, test } from 'node:test';
import { algebraOf, isAlgebra } from '../support/algebra.mjs';
import { startDaemon, until } from '../support/daemon.mjs';

// Seven cyclic roots over the rationals: longer than all that this file does meanwhile.
const letters = [...'abcdfgh'];
const cyclic = letters.map((_, n) =>
    n < 6
        ? letters.map((_, i) => Array.from({ length: n + 1 }, (_, k) => letters[(i + k) % 7]).join('*')).join('+')
        : `${letters.join('*')}-1`,
);
const LONG = { generators: cyclic.join('\n') };
const SHORT = { generators: 'x^2+y^2+z^2-1\nx^2-y+z^2\nx=z', order: 'lex' };

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
});
after(() => daemon.stop());

const send = (method, path, body) =>
    fetch(`${daemon.url}/v1/groebner${path}`, {
        method,
        ...(body && { headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) }),
    });

/** Asks for a short one at another address of this machine. */
const sendFrom = (localAddress) =>
    new Promise((done, fail) => {
        const headers = { 'content-type': 'application/json' };
        const request = http.request(`${daemon.url}/v1/groebner`, { method: 'POST', headers, localAddress }, (answer) => {
            let text = '';
            answer.on('data', (bytes) => (text += bytes));
            answer.on('end', () => done({ status: answer.statusCode, json: JSON.parse(text) }));
        });
        request.on('error', fail);
        request.end(JSON.stringify(SHORT));
    });

async function beginFrom(localAddress) {
    const { status, json } = await sendFrom(localAddress);
    assert.equal(status, 202);
    return json.id;
}

async function begin(asked) {
    const response = await send('POST', '', asked);
    const { id } = await response.json();
    assert.equal(response.status, 202);
    assert.equal(response.headers.get('location'), `/v1/groebner/${id}`);
    assert.match(id, /^[0-9a-f]{32}$/);
    return id;
}

const look = async (id, from = 0) => (await send('GET', `/${id}?from=${from}`)).json();

async function ended(id) {
    let seen;
    await until(async () => !['waiting', 'running'].includes((seen = await look(id)).state), 'the end of a basis');
    return seen;
}

test('a basis, its steps in pieces, and its answer', async () => {
    const id = await begin(SHORT);
    const { state, steps, next, answer } = await ended(id);
    assert.equal(state, 'done');
    assert.deepEqual(answer.basis.map(({ text }) => text), ['4*z^4 + 2*z^2 - 1', 'y - 2*z^2', 'x - z']);
    assert.equal(steps.length, answer.counts.made);
    assert.equal(next, steps.length);
    assert.deepEqual((await look(id, 12)).steps, steps.slice(12));
    assert.deepEqual((await look(id, next + 5)).steps, []);
});

test('what is wrong in a polynomial fails, with its place; what is wrong in the question is refused', async () => {
    const { state, error } = await ended(await begin({ generators: 'x\ny*(' }));
    assert.equal(state, 'failed');
    assert.deepEqual([error.code, error.place, error.line, error.column > 1], ['invalid', '/generators', 2, true]);
    for (const [asked, place] of [
        [{ ...SHORT, order: 'lexi' }, '/order'],
        [{ ...SHORT, eliminate: -1 }, '/eliminate'],
        [{ ...SHORT, other: 1 }, '/other'],
        [{ ...SHORT, generators: 7 }, '/generators'],
    ]) {
        const response = await send('POST', '', asked);
        const told = await response.json();
        assert.deepEqual([response.status, told.place], [422, place]);
    }
});

test('steps are told while it is made; cancelling ends the process, and the next one begins', async () => {
    const id = await begin(LONG);
    let next = 0;
    for (let round = 0; round < 3; round++) {
        const from = next;
        await until(async () => (next = (await look(id, from)).next) > from, 'more steps');
    }
    const [child] = algebraOf(daemon);
    const waiting = await begin(SHORT);
    assert.equal((await look(waiting)).state, 'waiting');
    assert.equal((await look(id, next)).state, 'running');
    assert.equal((await send('DELETE', `/${id}`)).status, 204);
    await until(() => !isAlgebra(child), 'the end of the process');
    const cancelled = await look(id);
    assert.equal(cancelled.state, 'cancelled');
    assert.ok(cancelled.steps.length >= next && !cancelled.answer && !cancelled.error);
    assert.equal((await ended(waiting)).state, 'done');
});

test('one that is cancelled before its turn is never made', async () => {
    const first = await begin(LONG);
    await until(async () => (await look(first)).state === 'running', 'the first one');
    const second = await begin(SHORT);
    await send('DELETE', `/${second}`);
    await send('DELETE', `/${first}`);
    assert.equal((await ended(await begin(SHORT))).state, 'done');
    const { state, steps } = await look(second);
    assert.deepEqual([state, steps], ['cancelled', []]);
});

test('ids that nobody has, and numbers that are none', async () => {
    assert.equal((await send('GET', '/0123')).status, 404);
    assert.equal((await send('DELETE', '/0123')).status, 404);
    const id = await begin(SHORT);
    for (const query of ['from=x', 'from=-1', 'from=', 'until=3']) {
        assert.equal((await send('GET', `/${id}?${query}`)).status, 422, query);
    }
});

test('sixteen are kept: those that wait before those that are over', async () => {
    const long = await begin(LONG);
    await until(async () => (await look(long)).state === 'running', 'the long one');
    const waiting = [];
    while (waiting.length < 15) {
        waiting.push(await beginFrom(`127.0.0.${2 + (waiting.length % 5)}`));
    }
    const refused = await sendFrom('127.0.0.9');
    assert.equal(refused.status, 503);
    assert.match(refused.json.detail, /16 questions are being answered \(algebra_kept\)/);
    await send('DELETE', `/${long}`);
    for (const id of waiting) {
        assert.equal((await ended(id)).state, 'done');
    }
    const next = await begin(SHORT);
    assert.equal((await send('GET', `/${long}`)).status, 404);
    assert.equal((await ended(waiting[0])).state, 'done');
    assert.equal((await ended(next)).state, 'done');
});

test('a client has a quarter of them: it loses its own oldest, and nobody else loses any', async () => {
    const others = await beginFrom('127.0.0.2');
    const own = [];
    while (own.length < 20) {
        own.push(await begin(SHORT));
        await ended(own.at(-1));
    }
    assert.equal((await ended(others)).state, 'done');
    assert.deepEqual(
        await Promise.all(own.map(async (id) => (await send('GET', `/${id}`)).status)),
        own.map((_, i) => (i < 16 ? 404 : 200)),
    );
    const long = await begin(LONG);
    for (let i = 0; i < 3; i++) {
        await begin(SHORT);
    }
    const refused = await send('POST', '', SHORT);
    assert.deepEqual([refused.status, refused.headers.get('retry-after')], [429, '1']);
    assert.match((await refused.json()).detail, /4 questions are being answered for this client \(algebra_share\)/);
    await send('DELETE', `/${long}`);
});

test('it ends with the server', async () => {
    const other = await startDaemon({ driver: 'null' });
    const response = await fetch(`${other.url}/v1/groebner`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify(LONG),
    });
    assert.equal(response.status, 202);
    await until(() => algebraOf(other).length === 1, 'the process of the algebra');
    const [child] = algebraOf(other);
    await other.stop();
    assert.equal(isAlgebra(child), false);
});
