// SPDX-License-Identifier: MIT
// Large documents and edits of very many operations hold up nobody but those who wait for them. No
// clock decides: what matters is who is answered before whom.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { ask, counter, startDaemon, until } from '../support/daemon.mjs';
import { largeDocument } from '../support/large.mjs';
import { Live } from '../support/live.mjs';

const SHARE = 16; // large documents of one client that may wait
const LARGE = 4200; // nodes, a few more than are light
const NODES = 30_000; // of a large document
const MANY = 3000; // operations of a large edit
const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };
const children = Array.from({ length: MANY }, (_, i) => ({ id: `n${i}`, type: 'sphere', visible: i === 0 }));
const many = { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } };
const setAll = (radius) => children.map(({ id }) => ({ op: 'set', at: `/nodes/${id}/params/radius`, value: radius }));

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
    await ask(daemon, 'POST', '/v1/scenes?id=other', ball);
    await ask(daemon, 'POST', '/v1/scenes?id=many', many);
});
after(() => daemon.stop());

const put = (id, body, options = {}) =>
    fetch(`${daemon.url}/v1/scenes/${id}`, { method: 'PUT', headers: { 'content-type': 'application/json' }, body, ...options });

/** A document of more than 64 KiB and few nodes. */
function fatDocument() {
    const code = `float sdf(vec3 p) { return length(p) - 1.0; } /*${'.'.repeat(15000)}*/`;
    const nodes = Array.from({ length: 5 }, (_, i) => ({ id: `n${i}`, type: 'field', visible: i === 0, params: { code } }));
    return JSON.stringify({ format: 'fieldcast/1', root: { id: 'root', type: 'union', children: nodes } });
}

/** What everybody does with another scene: each is one question and its answer. */
async function everydayWork(live) {
    assert.equal((await fetch(`${daemon.url}/healthz`)).status, 200);
    assert.equal((await ask(daemon, 'GET', '/v1/scenes/other')).root.id, 'ball');
    await ask(daemon, 'PATCH', '/v1/scenes/other', [{ op: 'set', at: '/nodes/ball/params/radius', value: 0.7 }]);
    live.look({});
    const pick = live.seq;
    live.say({ type: 'pick', pick, seq: live.seq, x: 10, y: 10 });
    await live.next('picked', { pick });
    await live.next('applied', { edit: live.set('/nodes/ball/params/radius', 0.8) });
    await ask(daemon, 'POST', '/v1/scenes?id=fresh', ball);
    const beside = await Live.open(daemon, 'fresh');
    await beside.next('document');
    await beside.close();
    await ask(daemon, 'DELETE', '/v1/scenes/fresh');
}

test('other scenes are read, picked in, edited and made while a large document is read', async () => {
    const live = await Live.open(daemon, 'other');
    const order = [];
    const body = largeDocument(NODES);
    const large = Promise.all(
        ['a', 'b', 'c'].map((id) =>
            put(id, body).then((answer) => {
                order.push(id);
                return answer.status;
            }),
        ),
    );
    // Bodies are there when the first is being read.
    await everydayWork(live);
    await everydayWork(live);
    order.push('others');
    assert.deepEqual(await large, [201, 201, 201]);
    assert.equal(order.at(-1) === 'others', false, `answered in the order ${order}`);
    await live.close();
});

test('other scenes are edited while a large scene is sent to a viewer, stored and read', async () => {
    const live = await Live.open(daemon, 'other');
    const order = [];
    const large = ['a', 'b', 'c'].flatMap((id) => [
        ask(daemon, 'PATCH', `/v1/scenes/${id}`, [{ op: 'set', at: '/nodes/node-0/params/radius', value: 0.5 }]),
        Live.open(daemon, id).then(async (viewer) => {
            await viewer.next('document');
            await viewer.close();
        }),
        ask(daemon, 'GET', `/v1/scenes/${id}`),
    ]);
    const all = Promise.all(large).then(() => order.push('large'));
    await everydayWork(live);
    order.push('others');
    await all;
    assert.deepEqual(order, ['others', 'large']);
    await live.close();
});

test('everybody is answered while all scenes are searched for the name of a file', async () => {
    const file = Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x01\x02\x03\x04', 'latin1');
    const sent = await fetch(`${daemon.url}/v1/assets`, { method: 'POST', body: file });
    const { id: image } = await sent.json();
    await ask(daemon, 'POST', '/v1/scenes?id=lit', { ...ball, environment: { type: 'image', image } });
    await Promise.all(
        ['a', 'b', 'c'].map((id) => ask(daemon, 'PATCH', `/v1/scenes/${id}`, [{ op: 'set', at: '/nodes/node-0/params/radius', value: 0.25 }])),
    );
    const order = [];
    const removed = fetch(`${daemon.url}/v1/assets/${image}`, { method: 'DELETE' }).then(({ status }) => order.push(status));
    for (let i = 0; i < 3; i += 1) {
        assert.equal((await fetch(`${daemon.url}/healthz`)).status, 200);
        assert.equal((await ask(daemon, 'GET', '/v1/scenes/other')).root.id, 'ball');
    }
    order.push('others');
    await removed;
    assert.deepEqual(order, ['others', 409]);
});

test('everybody is answered while questions of the algebra are read', async () => {
    const { limits } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
    const { value: most } = limits.find(({ name }) => name === 'question_bytes');
    const order = [];
    const body = `{"x":[${'1,'.repeat(most / 2 - 8)}1]}`;
    const post = (at, text) => fetch(`${daemon.url}/v1/${at}`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: text });
    const places = ['implicitize', 'verify', 'groebner'];
    const questions = [...places, ...places, ...places, ...places].map((at) =>
        post(at, body).then((answer) => {
            order.push(at);
            return answer.status;
        }),
    );
    await until(async () => order.length === questions.length || (await counter(daemon, 'documents_waiting')) > 1, 'questions');
    order.push('others');
    assert.deepEqual(new Set(await Promise.all(questions)), new Set([422]));
    assert.equal(order.at(-1) === 'others', false, `answered in the order ${order}`);
    for (const at of places) {
        assert.equal((await post(at, body + ' '.repeat(most))).status, 413, at);
    }
});

test('edits of one client stay in order, whatever each takes', async () => {
    const live = await Live.open(daemon, 'many');
    const edits = [];
    for (let i = 1; i <= 3; i += 1) {
        edits.push(live.change(setAll(i / 10)));
        edits.push(live.set('/nodes/n1/params/radius', 0.9));
    }
    const revisions = [];
    for (const edit of edits) {
        revisions.push((await live.next('applied', { edit })).revision);
    }
    assert.deepEqual(revisions, revisions.map((_, i) => revisions[0] + i));
    const now = (await ask(daemon, 'GET', '/v1/scenes/many')).root.children;
    assert.deepEqual([now[0].params.radius, now[1].params.radius, now[2].params.radius], [0.3, 0.9, 0.3]);
    live.say({ type: 'undo', edit: (live.edit += 1) });
    live.say({ type: 'undo', edit: (live.edit += 1) });
    await live.next('applied', { edit: live.edit });
    const before = (await ask(daemon, 'GET', '/v1/scenes/many')).root.children;
    assert.deepEqual([before[0].params.radius, before[1].params.radius], [0.2, 0.9]);
    await live.close();
});

/** How often a small edit of another scene is applied before each of these, sent just before it. */
async function timesFirst(scene, client, acts) {
    let first = 0;
    for (const act of acts) {
        const author = await Live.open(daemon, scene, { client }); // who has just worked much is not read at once
        await author.next('document');
        const other = await Live.open(daemon, 'other');
        const before = await counter(daemon, 'edits_total');
        const edit = act(author);
        await other.next('applied', { edit: other.set('/nodes/ball/params/radius', 0.5 + first / 10) });
        first += (await counter(daemon, 'edits_total')) === before + 1;
        await author.next('applied', { edit });
        await Promise.all([author.close(), other.close()]);
    }
    return first;
}

const undo = (author) => author.step('undo');
const redo = (author) => author.step('redo');

test('a small edit does not wait while a step of many operations is taken back or done again', async (t) => {
    const client = 'author-of-much';
    const author = await Live.open(daemon, 'many', { client });
    await author.next('applied', { edit: author.change(setAll(0.95)) });
    await author.close();
    const first = await timesFirst('many', client, [undo, redo, undo, redo, undo]);
    t.diagnostic(`the small edit was first ${first} times of 5`);
    assert.ok(first >= 3, `first ${first} times`);
    const { root } = await ask(daemon, 'GET', '/v1/scenes/many');
    assert.ok(root.children.every(({ params }) => params?.radius !== 0.95));
});

test('a small edit does not wait while one operation removes or inserts many nodes', async (t) => {
    const document = JSON.parse(largeDocument(NODES));
    document.root = { id: 'all', type: 'union', children: [document.root] };
    await ask(daemon, 'POST', '/v1/scenes?id=whole', document);
    const remove = (author) => author.change([{ op: 'remove', at: '/nodes/root' }]);
    const first = await timesFirst('whole', 'author-of-one', [remove, undo, redo, undo, redo]);
    t.diagnostic(`the small edit was first ${first} times of 5`);
    assert.ok(first >= 3, `first ${first} times`);
    assert.deepEqual((await ask(daemon, 'GET', '/v1/scenes/whole')).root.children ?? [], []);
    await ask(daemon, 'DELETE', '/v1/scenes/whole');
});

test('all or none of many operations are applied', async () => {
    const live = await Live.open(daemon, 'many');
    const { revision } = live.welcome;
    const edit = live.change([...setAll(0.7), { op: 'remove', at: '/nodes/nobody' }]);
    const refused = await live.next('rejected', { edit });
    assert.equal(refused.place, '/nodes/nobody');
    const applied = await live.next('applied', { edit: live.set('/nodes/n1/params/radius', 0.4) });
    assert.equal(applied.revision, revision + 1);
    await live.close();
});

test('two clients who send many operations to one scene each get a revision of their own', async () => {
    const both = await Promise.all([Live.open(daemon, 'many'), Live.open(daemon, 'many')]);
    const all = both.flatMap((live, i) => Array.from({ length: 3 }, () => [live, live.change(setAll(0.2 + i / 10))]));
    const revisions = [];
    for (const [live, edit] of all) {
        revisions.push((await live.next('applied', { edit })).revision);
    }
    assert.equal(new Set(revisions).size, all.length);
    await Promise.all(both.map((live) => live.close()));
});

test('an edit that was received is applied, though its client has left', async () => {
    const live = await Live.open(daemon, 'many');
    const { revision } = live.welcome;
    live.change(setAll(0.6));
    const seen = await Live.open(daemon, 'many');
    await until(() => seen.messages.some((m) => m.type === 'changed') || live.find('applied'), 'the edit to begin');
    live.change(setAll(0.65));
    live.socket.end();
    await until(async () => (await ask(daemon, 'GET', '/v1/scenes')).scenes.find(({ id }) => id === 'many').revision === revision + 2, 'both edits');
    await seen.next('changed', { revision: revision + 2 });
    assert.ok(seen.find('changed', { revision: revision + 2 }).ops.every(({ value }) => value === 0.65));
    await until(async () => (await ask(daemon, 'GET', '/v1/scenes')).scenes.find(({ id }) => id === 'many').viewers === 1, 'the client to be gone');
    await seen.close();
});

test('one client has no more than its share of large documents waiting', async () => {
    const body = fatDocument();
    const first = put('largest', largeDocument(3 * NODES));
    await until(async () => (await counter(daemon, 'documents_waiting')) === 1, 'the first to be read');
    const answers = await Promise.all(Array.from({ length: SHARE + 8 }, (_, i) => put(`fat-${i}`, body)));
    assert.equal((await first).status, 201);
    const refused = answers.filter(({ status }) => status === 429);
    assert.ok(refused.length > 0, `${answers.map(({ status }) => status)}`);
    assert.equal(await counter(daemon, 'documents_over_share_total'), refused.length);
    assert.ok(answers.every(({ status }) => status === 429 || status === 201));
    assert.ok(Number(refused[0].headers.get('retry-after')) >= 1);
    const problem = await refused[0].json();
    assert.equal(problem.code, 'share');
    assert.match(problem.detail, new RegExp(`^${SHARE} large tasks of this client wait already; the limit is ${SHARE}$`));
});

test('nor of copies and pictures of large scenes that a body names', async () => {
    assert.ok((await put('original', largeDocument(LARGE))).ok);
    for (const [at, body, done] of [
        ['scenes', { from: 'scene:original' }, 201],
        ['render', { scene: 'original', width: 8, height: 8 }, 200],
    ]) {
        const work = () =>
            fetch(`${daemon.url}/v1/${at}`, {
                method: 'POST',
                headers: { 'content-type': 'application/json' },
                body: JSON.stringify(body),
            });
        const first = put('largest', largeDocument(3 * NODES));
        await until(async () => (await counter(daemon, 'documents_waiting')) === 1, 'the first to be read');
        const refused = await counter(daemon, 'documents_over_share_total');
        const answers = await Promise.all(Array.from({ length: SHARE + 8 }, work));
        assert.ok((await first).ok);
        assert.ok((await counter(daemon, 'documents_over_share_total')) > refused, at);
        const statuses = answers.map(({ status }) => status);
        assert.ok(statuses.every((status) => status === 429 || status === done), `${statuses}`);
    }
});

/** Processor time of a process outside the kernel. */
const userSecondsOf = (pid) => Number(fs.readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ')[11]) / 100;

test('a new render process gets the document of a picture without that it is read again', async (t) => {
    const own = await startDaemon({ driver: 'null', tileMs: 2000 });
    try {
        const body = `{"scene":${largeDocument(3 * NODES)},"width":16,"height":16}`;
        const before = userSecondsOf(own.pid);
        const picture = fetch(`${own.url}/v1/render`, { method: 'POST', headers: { 'content-type': 'application/json' }, body });
        await until(async () => (await counter(own, 'images_waiting')) === 1, 'the picture to be asked');
        await until(async () => (await counter(own, 'documents_waiting')) === 0, 'the end of the reading');
        const asked = userSecondsOf(own.pid);
        process.kill(own.worker(), 'SIGKILL');
        assert.equal((await picture).status, 200);
        const again = userSecondsOf(own.pid) - asked;
        t.diagnostic(`${(asked - before).toFixed(2)} s of the processor to read it, ${again.toFixed(2)} s to send it again`);
        assert.ok(again < (asked - before) / 5, `${again} s`);
    } finally {
        await own.stop();
    }
});

/** The answer to the first of several edits of almost 16 MiB each that is refused. */
async function fill(id) {
    const value = { type: 'implicit', params: { equation: `x = ${'0'.repeat(16_000)}1` } };
    const ops = Array.from({ length: 1000 }, () => ({ op: 'insert', into: '/nodes/hidden', value }));
    for (let i = 0; i < 6; i += 1) {
        const answer = await fetch(`${daemon.url}/v1/scenes/${id}`, {
            method: 'PATCH',
            headers: { 'content-type': 'application/json' },
            body: JSON.stringify(ops),
        });
        if (!answer.ok) {
            return { status: answer.status, ...(await answer.json()) };
        }
    }
    return {};
}

test('a scene that is full is drawn, also when an undo has brought it back', async () => {
    const restarts = await counter(daemon, 'worker_restarts_total');
    const hidden = { id: 'hidden', type: 'union', visible: false };
    const root = { id: 'root', type: 'union', children: [{ id: 'ball', type: 'sphere' }, hidden] };
    await ask(daemon, 'POST', '/v1/scenes?id=full', { format: 'fieldcast/1', root });
    const draw = async () => (await fetch(`${daemon.url}/v1/scenes/full/image.png?width=16&height=16`)).status;
    assert.equal(await draw(), 200);
    const { status, code, place, detail } = await fill('full');
    assert.deepEqual([status, code, place], [422, 'limit', '']);
    assert.match(detail, / bytes of the scene are above the maximum 67108864 \(scene_bytes\)$/);
    assert.equal(await draw(), 200);
    const live = await Live.open(daemon, 'full');
    await live.next('applied', { edit: live.change([{ op: 'remove', at: '/nodes/hidden' }]) });
    assert.equal(await draw(), 200);
    live.say({ type: 'undo', edit: (live.edit += 1) });
    await live.next('applied', { edit: live.edit });
    assert.equal(await draw(), 200);
    assert.equal(await counter(daemon, 'worker_restarts_total'), restarts);
    await live.close();
});
