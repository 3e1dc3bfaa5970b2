// SPDX-License-Identifier: MIT
// Finding an equation takes a process of its own: nobody else waits for it, and it ends with the
// server. No clock decides.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { algebraOf, isAlgebra, SLOW_SURFACE } from '../support/algebra.mjs';
import { ask, startDaemon, until } from '../support/daemon.mjs';

const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

test('others are answered while an equation is sought, and it ends with the server', async () => {
    const daemon = await startDaemon({ driver: 'null' });
    let answered = false;
    const question = fetch(`${daemon.url}/v1/implicitize`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify(SLOW_SURFACE),
    })
        .then((response) => response.status)
        .catch(() => 0)
        .finally(() => (answered = true));
    await until(() => algebraOf(daemon).length === 1, 'the process of the algebra');
    const [child] = algebraOf(daemon);
    await ask(daemon, 'POST', '/v1/scenes?id=other', ball);
    await ask(daemon, 'PATCH', '/v1/scenes/other', [{ op: 'set', at: '/nodes/ball/params/radius', value: 0.7 }]);
    assert.equal((await ask(daemon, 'GET', '/v1/scenes/other')).root.params.radius, 0.7);
    assert.equal(answered, false, 'it was answered before: take a longer equation');
    await daemon.stop();
    assert.ok([0, 503].includes(await question));
    assert.equal(isAlgebra(child), false);
});

test('the process may be killed at any moment: the search fails, the next one and scenes go on', async () => {
    const kills = 100;
    const daemon = await startDaemon({ driver: 'null' });
    const post = (path, asked) =>
        fetch(`${daemon.url}${path}`, {
            method: 'POST',
            headers: { 'content-type': 'application/json' },
            body: JSON.stringify(asked),
        }).then((response) => response.json());
    await ask(daemon, 'POST', '/v1/scenes?id=other', ball);
    for (let i = 0; i < kills; i++) {
        const { id } = await post('/v1/implicitize?wait=no', SLOW_SURFACE);
        await until(() => algebraOf(daemon).length === 1, 'the process of the algebra');
        await new Promise((done) => setTimeout(done, (i * 7) % 50));
        algebraOf(daemon).forEach((pid) => process.kill(pid, 'SIGKILL'));
        let seen;
        await until(
            async () => (seen = await (await fetch(`${daemon.url}/v1/implicitize/${id}`)).json()).state === 'failed',
            'the end of a search',
        );
        assert.match(seen.error.message, /or was ended/);
        const radius = 0.5 + i / 1000;
        await ask(daemon, 'PATCH', '/v1/scenes/other', [{ op: 'set', at: '/nodes/ball/params/radius', value: radius }]);
        assert.equal((await ask(daemon, 'GET', '/v1/scenes/other')).root.params.radius, radius);
    }
    assert.equal((await post('/v1/implicitize', { x: 's', y: 't', z: 's*t' })).equation, 'x*y-z');
    await daemon.stop();
});

test('the patch alone is the root of a scene', async () => {
    const daemon = await startDaemon({ driver: 'null' });
    const { trimmed, equation } = await ask(daemon, 'POST', '/v1/implicitize', { x: 's', y: 't', z: 's*t', s: [-1, 1], t: [0, 1] });
    await ask(daemon, 'PUT', '/v1/scenes/patch', { format: 'fieldcast/1', root: trimmed });
    const { root } = await ask(daemon, 'GET', '/v1/scenes/patch');
    assert.deepEqual(
        [root.type, ...root.children.map(({ type }) => type)],
        ['intersection', 'implicit', 'parametric'],
    );
    assert.equal(root.children[0].params.equation, equation);
    assert.deepEqual(root.children[1].params.surface, { x: 's', y: 't', z: 's*t', s: [-1, 1], t: [0, 1] });
    await daemon.stop();
});

// --- steps ---

const bicubic = { x: 's^3*t^3+s-2t^2+s^2*t', y: '2s^3*t^3+s^3-t+s*t-t^3*s^2', z: 's^3*t^3-t^3+s^2+s*t^2' };
const umbrella = { x: 's*t', y: 's', z: 't^2' };

test('an equation is looked at while it is sought, step by step, and cancelled', async () => {
    const daemon = await startDaemon({ driver: 'null' });
    const send = (method, path, body) =>
        fetch(`${daemon.url}/v1/implicitize${path}`, {
            method,
            ...(body && { headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) }),
        });
    const begin = async (asked) => {
        const response = await send('POST', '?wait=no', asked);
        const { id } = await response.json();
        assert.deepEqual([response.status, response.headers.get('location')], [202, `/v1/implicitize/${id}`]);
        return id;
    };
    const look = async (id, from = 0) => (await send('GET', `/${id}?from=${from}`)).json();
    const ended = async (id) => {
        let seen;
        await until(async () => !['waiting', 'running'].includes((seen = await look(id)).state), 'the end of a search');
        return seen;
    };

    const { state, steps, next, answer } = await ended(await begin({ ...umbrella, s: [-1, 1], t: [-1, 1] }));
    assert.equal(state, 'done');
    assert.equal(answer.equation, (await (await send('POST', '', umbrella)).json()).equation);
    assert.deepEqual(
        steps.map(({ step, count }) => [step, count]),
        [['degree', 3], ['support', 2], ['prime', 1], ['prime', 2], ['exact', 2], ['irreducible', 1], ['coverage', answer.coverage.points]],
    );
    assert.equal(next, steps.length);
    steps.forEach(({ ms, text }, i) => assert.ok(ms >= (steps[i - 1]?.ms ?? 0) && text.length > 0));

    const seen = (await ended(await begin({ ...umbrella, method: 'groebner' }))).steps.map(({ step }) => step);
    assert.deepEqual([seen[0], seen.slice(-2)], ['degree', ['exact', 'irreducible']]);

    const failed = await ended(await begin({ x: 's', y: 't', z: 's +* t' }));
    assert.deepEqual([failed.state, failed.error.place, failed.error.line, failed.error.column], ['failed', 'z', 1, 4]);
    for (const [body, query, place] of [[{ x: 's', y: 't' }, '?wait=no', '/z'], [umbrella, '?wait=2', '?wait'], [umbrella, '?now=1', '?now']]) {
        const response = await send('POST', query, body);
        assert.deepEqual([response.status, (await response.json()).place], [422, place]);
    }

    // The degree is told before the equation is found: the answer is not what brings the steps.
    const long = await begin(SLOW_SURFACE);
    await until(async () => (await look(long)).next > 1, 'the first steps');
    const early = await look(long);
    assert.deepEqual([early.state, early.steps[0].step, early.steps[0].count, early.answer], ['running', 'degree', 18, undefined]);
    const [child] = algebraOf(daemon);
    assert.equal((await send('DELETE', `/${long}`)).status, 204);
    await until(() => !isAlgebra(child), 'the end of the process');
    assert.equal((await look(long)).state, 'cancelled');
    assert.equal((await ended(await begin(bicubic))).answer.certificate.degree, 18);

    // An id is of one kind.
    assert.equal((await fetch(`${daemon.url}/v1/groebner/${long}`)).status, 404);
    assert.equal((await send('GET', '/0123')).status, 404);
    await daemon.stop();
});
