// SPDX-License-Identifier: MIT
// Thumbnails: who gets which, what an edit renews, what comes from the cache, and when none is drawn.
import assert from 'node:assert/strict';
import { after, before, beforeEach, test } from 'node:test';
import { ask, counter, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { decodePng } from '../support/png.mjs';

const DOCUMENT = {
    format: 'fieldcast/1',
    materials: {
        red: { shader: 'phong', properties: { diffuse: [0.8, 0.1, 0.1] } },
        blue: { shader: 'phong', properties: { diffuse: [0.1, 0.1, 0.8] } },
    },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'pair', type: 'group', material: 'red', children: [{ id: 'ball', type: 'sphere' }, { id: 'ring', type: 'torus' }] },
            { id: 'box', type: 'box', material: 'blue' },
            { id: 'nothing', type: 'group' },
        ],
    },
};
const NODES = ['root', 'pair', 'ball', 'ring', 'box'];
const RADIUS = '/nodes/ball/params/radius';

let daemon;
let scene;
let made = 0;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
});
after(() => daemon.stop());
beforeEach(async () => {
    made += 1;
    scene = `s${made}`;
    await ask(daemon, 'POST', `/v1/scenes?id=${scene}`, DOCUMENT);
});

const open = (options) => Live.open(daemon, scene, options);
const total = (name) => counter(daemon, `thumbnails_${name}_total`);
const ids = (live, from) => live.thumbnails.slice(from).map(({ id }) => id).sort();
const came = (live, count) => until(() => live.thumbnails.length >= count, `${count} thumbnails`);
const show = (live, more) => live.say({ type: 'thumbnails', nodes: NODES, ...more });

/** The mean colour of what is opaque. */
function colour({ png }) {
    const { width, height, pixels } = decodePng(png);
    const sum = [0, 0, 0, 0];
    for (let i = 0; i < width * height; i += 1) {
        const alpha = pixels[4 * i + 3] / 255;
        [0, 1, 2].forEach((c) => (sum[c] += alpha * pixels[4 * i + c]));
        sum[3] += alpha;
    }
    return { red: sum[0] / sum[3], blue: sum[2] / sum[3], part: sum[3] / (width * height) };
}

test('each part is sent once, in its size and colour, on a clear ground', async () => {
    const live = await open();
    show(live, { large: ['ball'], materials: ['blue'] });
    await came(live, NODES.length + 2);
    const sizes = live.thumbnails.map(({ kind, id, width, height }) => `${kind} ${id} ${width}x${height}`);
    assert.deepEqual(sizes.sort(), [...NODES.map((id) => `node ${id} 96x64`), 'node ball 256x171', 'material blue 96x64'].sort());
    for (const one of live.thumbnails) {
        const { width, height } = decodePng(one.png);
        assert.deepEqual([width, height], [one.width, one.height]);
        const { part } = colour(one);
        assert.ok(part > 0.1 && part < 0.9, `${one.id} takes ${part} of its picture`);
    }
    const [ball] = live.thumbnails.filter(({ id }) => id === 'ball').map(colour);
    const [blue] = live.thumbnails.filter(({ kind }) => kind === 'material').map(colour);
    assert.ok(ball.red > 1.5 * ball.blue, 'the ball has the material of its group');
    assert.ok(blue.blue > 1.5 * blue.red, 'the material has its colour');
    await live.close();
});

test('an edit renews the node and what is around it; an undo draws nothing', async () => {
    const live = await open();
    show(live);
    await came(live, NODES.length);
    const drawn = await total('drawn');
    await live.next('applied', { edit: live.set(RADIUS, 2.5 + made) });
    await came(live, NODES.length + 3);
    assert.deepEqual(ids(live, NODES.length), ['ball', 'pair', 'root']);
    assert.equal(await total('drawn'), drawn + 3);
    const reused = await total('reused');
    await live.next('applied', { edit: live.step('undo') });
    await came(live, NODES.length + 6);
    assert.deepEqual(ids(live, NODES.length + 3), ['ball', 'pair', 'root']);
    assert.equal(await total('drawn'), drawn + 3);
    assert.equal(await total('reused'), reused + 3);
    for (const id of ['ball', 'pair', 'root']) {
        const [first, second, third] = live.thumbnails.filter((one) => one.id === id).map(({ png }) => png);
        assert.ok(!first.equals(second), `${id} has changed`);
        assert.ok(first.equals(third), `${id} is as it was`);
    }
    await live.close();
});

test('a material renews those who have it, also what is in other scenes but once', async () => {
    const live = await open();
    show(live, { materials: ['red', 'blue'] });
    await came(live, NODES.length + 2);
    const diffuse = [0.1, 0.1 + 0.01 * made, 0.9];
    await live.next('applied', { edit: live.set('/materials/red/properties/diffuse', diffuse) });
    await came(live, NODES.length + 7);
    assert.deepEqual(ids(live, NODES.length + 2), ['ball', 'pair', 'red', 'ring', 'root']);
    const drawn = await total('drawn');
    const other = await open();
    show(other, { materials: ['red', 'blue'] });
    await came(other, NODES.length + 2);
    assert.equal(await total('drawn'), drawn);
    await Promise.all([live.close(), other.close()]);
});

test('what was moved looks as it did, and only what is around it comes', async () => {
    const live = await open();
    show(live);
    await came(live, NODES.length);
    await live.next('applied', { edit: live.set('/nodes/pair/transform/translation', [0, 3 + made, 0]) });
    await came(live, NODES.length + 1);
    assert.deepEqual(ids(live, NODES.length), ['root']);
    await live.close();
});

/** Sets a radius again and again for longer than a rest takes; answers the longest pause in between. */
async function drag(live, from) {
    const started = Date.now();
    let [sent, longest] = [started, 0];
    for (let i = 1; Date.now() - started < 1500; i += 1) {
        const edit = live.change([{ op: 'set', at: RADIUS, value: from + i / 1e5 }], { group: 'drag' });
        await live.next('applied', { edit });
        longest = Math.max(longest, Date.now() - sent);
        sent = Date.now();
    }
    return longest;
}

test('nothing is drawn while a hand moves', async () => {
    const live = await open();
    show(live);
    await came(live, NODES.length);
    for (let radius = 1; ; radius += 0.5) {
        const drawn = await total('drawn');
        const longest = await drag(live, radius);
        const after = await total('drawn');
        const came = live.thumbnails.length;
        if (longest < 300) {
            assert.equal(after, drawn);
            await until(() => live.thumbnails.length === came + 3, 'what has changed');
            assert.equal(await total('drawn'), drawn + 3);
            break;
        }
        // On a busy machine the hand has rested: again.
        await until(() => live.thumbnails.length > came, 'what has changed');
    }
    await live.close();
});

test('at most one message waits for its acknowledgement', async () => {
    const fresh = JSON.stringify(DOCUMENT).replaceAll('"sphere"', '"sphere","params":{"radius":1.3}').replaceAll('[0.', '[0.0');
    await ask(daemon, 'PUT', `/v1/scenes/${scene}`, JSON.parse(fresh)); // in no cache
    const live = await open({ ack: false });
    show(live);
    await came(live, 1);
    const { number } = live.thumbnails[0];
    const drawn = () => live.thumbnails.length;
    // All are drawn for another, so that nothing else keeps them back.
    const other = await open();
    show(other);
    await came(other, NODES.length);
    const first = drawn();
    assert.ok(live.thumbnails.every((one) => one.number === number));
    assert.ok(first < NODES.length);
    live.say({ type: 'ack_thumbnails', number: number + 7 });
    await ask(daemon, 'GET', '/healthz');
    assert.equal(drawn(), first);
    live.say({ type: 'ack_thumbnails', number });
    await came(live, NODES.length);
    assert.equal(live.thumbnails.at(-1).number, number + 1);
    await Promise.all([live.close(), other.close()]);
});

test('who does not take thumbnails gets no more drawn', async () => {
    const children = Array.from({ length: 60 }, (_, i) => ({ id: `n${i}`, type: 'sphere', params: { radius: 3 + i / 100 } }));
    await ask(daemon, 'PUT', `/v1/scenes/${scene}`, { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
    const before = await total('drawn');
    const live = await open({ ack: false });
    show(live, { nodes: children.map(({ id }) => id) });
    await until(async () => (await total('drawn')) >= before + 33, 'those that wait to be sent');
    // Sessions take turns, so as many of the first would be drawn meanwhile.
    const other = await open();
    show(other, { nodes: children.slice(0, 10).map(({ id }) => id), width: 48 });
    await came(other, 10);
    assert.equal(await total('drawn'), before + 33 + 10);
    live.say({ type: 'ack_thumbnails', number: live.thumbnails[0].number });
    await until(() => live.thumbnails.length > 1, 'those that waited');
    await other.close();
    await live.close();
});

test('what cannot be drawn has an empty picture, ids that are gone none', async () => {
    const live = await open();
    show(live, { nodes: ['ball', 'gone', 'nothing'], materials: ['gone'] });
    await came(live, 2);
    assert.deepEqual(ids(live, 0), ['ball', 'nothing']);
    assert.equal(live.thumbnails.find(({ id }) => id === 'nothing').png.length, 0);
    const edit = live.change([{ op: 'insert', into: '/nodes/nothing', before: null, value: { id: 'gone', type: 'cone' } }]);
    await live.next('applied', { edit });
    await came(live, 4);
    assert.deepEqual(ids(live, 2), ['gone', 'nothing']);
    assert.ok(live.thumbnails.slice(2).every(({ png }) => png.length > 0));
    await live.close();
});

test('a wrong list is refused with place and limit, and the old one stays', async () => {
    const live = await open();
    const many = Array.from({ length: 257 }, (_, i) => `n${i}`);
    for (const [more, code, place, words] of [
        [{ nodes: ['ball', 'no id'] }, 'invalid', '/nodes/1', /id of a node/],
        [{ large: many }, 'limit', '/large', /257 ids are above the maximum 256/],
        [{ width: 500 }, 'invalid', '/width', /192/],
    ]) {
        const from = live.messages.length;
        show(live, more);
        const notice = await live.next('notice', {}, from);
        assert.deepEqual([notice.level, notice.code, notice.place], ['error', code, place]);
        assert.match(notice.message, words);
    }
    const { 'x-fieldcast': registry } = await (await fetch(`${daemon.url}/v1/schema.json`)).json();
    const limit = (name) => registry.limits.find((row) => row.name === name)?.value;
    assert.deepEqual(
        ['thumbnails', 'thumbnail_width', 'thumbnail_nodes', 'thumbnail_cache_bytes'].map(limit),
        [256, 192, 4096, 16777216],
    );
    await live.close();
});

test('a node with more below it than the limit has an empty picture', async () => {
    const children = Array.from({ length: 4096 }, (_, i) => ({ id: `n${i}`, type: 'sphere' }));
    const root = { id: 'root', type: 'union', children: [{ id: 'many', type: 'group', children }] };
    await ask(daemon, 'PUT', `/v1/scenes/${scene}`, { format: 'fieldcast/1', root });
    const live = await open();
    show(live, { nodes: ['root', 'many', 'n7'] });
    await came(live, 3);
    const empty = live.thumbnails.filter(({ png }) => png.length === 0).map(({ id }) => id);
    assert.deepEqual(empty.sort(), ['many', 'root']);
    await live.close();
});

test('who asks for many large parts rests in between, and gets them all', async () => {
    const CHAIN = 12;
    let root = { id: 'leaves', type: 'union', children: Array.from({ length: 3900 }, (_, i) => ({ id: `n${i}`, type: 'sphere', visible: i === 0 })) };
    const nodes = Array.from({ length: CHAIN }, (_, i) => (root = { id: `c${i}`, type: 'union', children: [root] }).id);
    await ask(daemon, 'PUT', `/v1/scenes/${scene}`, { format: 'fieldcast/1', root });
    const live = await open({ ack: true });
    const before = await counter(daemon, 'thumbnail_rests_total');
    live.say({ type: 'thumbnails', nodes, large: nodes });
    await came(live, 2 * CHAIN);
    assert.ok((await counter(daemon, 'thumbnail_rests_total')) > before);
    await live.close();
});
