// SPDX-License-Identifier: MIT
// How large nodes are, as the live connection tells it.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ask, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const DOCUMENT = {
    format: 'fieldcast/1',
    models: {
        pawn: {
            params: [{ name: 'width', type: 'float', sets: '/nodes/foot/params/size.x', range: [0.1, 4] }],
            root: { id: 'foot', type: 'box' },
        },
    },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'ball', type: 'sphere', params: { radius: 2 }, transform: { translation: [1, 0, 0] } },
            { id: 'hidden', type: 'sphere', visible: false },
            {
                id: 'turned',
                type: 'group',
                transform: { translation: [0, 5, 0], rotation: [0, 0, Math.PI / 2], scale: [2, 2, 2] },
                children: [{ id: 'bar', type: 'box', params: { size: [4, 1, 1] } }],
            },
            { id: 'floor', type: 'plane' },
        ],
    },
};

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
});
after(() => daemon.stop());

let asked = 0;
async function boundsOf(live, nodes) {
    asked += 1;
    live.say({ type: 'bounds', bounds: asked, ...(nodes && { nodes }) });
    return live.next('bounded', { bounds: asked });
}

function near(answer, low, high) {
    for (const [is, wanted] of [[answer.low, low], [answer.high, high]]) {
        for (let i = 0; i < 3; i += 1) {
            assert.ok(Math.abs(is[i] - wanted[i]) < 1e-9, `${JSON.stringify(is)} ${wanted}`);
        }
    }
}

test('a box in the world holds what is to be seen of nodes, and no more', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=large', DOCUMENT);
    const live = await Live.open(daemon, 'large');
    near(await boundsOf(live, ['ball']), [-1, -2, -2], [3, 2, 2]);
    near(await boundsOf(live, ['bar']), [-1, 1, -1], [1, 9, 1]);
    near(await boundsOf(live, ['ball', 'bar', 'hidden']), [-1, -2, -2], [3, 9, 2]);
    live.set('/nodes/ball/params/radius', 0.5);
    const after = await boundsOf(live, ['ball']);
    near(after, [0.5, -0.5, -0.5], [1.5, 0.5, 0.5]);
    assert.equal(after.revision, 2, 'the newest state');
    await live.close();
});

test('what is hidden, and what has no end, has no box', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=none', DOCUMENT);
    const live = await Live.open(daemon, 'none');
    for (const nodes of [['hidden'], ['floor']]) {
        const { low, high } = await boundsOf(live, nodes);
        assert.deepEqual([low, high], [null, null], `${nodes}`);
    }
    await live.close();
});

test('beside what has no end, the rest has its box', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=rest', { ...DOCUMENT, environment: { floor: true } });
    const live = await Live.open(daemon, 'rest');
    near(await boundsOf(live), [-1, -2, -2], [3, 9, 2]);
    near(await boundsOf(live, ['nobody']), [-1, -2, -2], [3, 9, 2]);
    near(await boundsOf(live, ['floor', 'ball']), [-1, -2, -2], [3, 2, 2]);
    live.change([{ op: 'remove', at: '/nodes/floor' }]);
    near(await boundsOf(live), [-1, -2, -2], [3, 9, 2]);
    await live.close();
});

test('picks that come later take no answer from a question for sizes', async () => {
    const many = Array.from({ length: 3000 }, (_, i) => ({ id: `ball-${i}`, type: 'sphere' }));
    await ask(daemon, 'POST', '/v1/scenes?id=busy', { format: 'fieldcast/1', root: { id: 'root', type: 'union', children: many } });
    const live = await Live.open(daemon, 'busy');
    live.say({ type: 'view', seq: 1, width: 64, height: 48 });
    for (let i = 1; i <= 40; i += 1) {
        live.say({ type: 'pick', pick: i, seq: 1, x: 32, y: 24 });
        if (i === 10) {
            live.say({ type: 'bounds', bounds: 1000 });
        }
    }
    await live.next('picked', { pick: 40 });
    near(await live.next('bounded', { bounds: 1000 }), [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]);
    await live.close();
});

test('an instance is as large as its own numbers make it', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=models', {
        ...DOCUMENT,
        root: {
            id: 'root',
            type: 'union',
            children: [
                { id: 'slim', type: 'model', params: { model: 'pawn' } },
                {
                    id: 'wide',
                    type: 'model',
                    params: { model: 'pawn', width: 3 },
                    transform: { translation: [0, 0, 4] },
                },
            ],
        },
    });
    const live = await Live.open(daemon, 'models');
    near(await boundsOf(live, ['slim']), [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]);
    near(await boundsOf(live, ['wide']), [-1.5, -0.5, 3.5], [1.5, 0.5, 4.5]);
    await live.close();
});
