// SPDX-License-Identifier: MIT
// The live connection: edits and who is told, undo, resuming, frames and their flow.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, beforeEach, describe, test } from 'node:test';
import {
    ask,
    counter,
    cpuSecondsOf,
    makeDirectory,
    memoryOf,
    removeDirectory,
    sleep,
    standStill,
    startDaemon,
    until,
} from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { decodePng } from '../support/png.mjs';

const DOCUMENT = {
    format: 'fieldcast/1',
    name: 'Test',
    lights: [{ id: 'sun', type: 'directional' }],
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'ball', type: 'sphere', params: { radius: 1 } },
            { id: 'box', type: 'box', transform: { translation: [2, 0, 0] } },
        ],
    },
};
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

const opened = [];
const open = async (options) => {
    const live = await Live.open(daemon, scene, options);
    opened.push(live);
    return live;
};
const read = async () => (await fetch(`${daemon.url}/v1/scenes/${scene}`)).text();
const still = (live, from = 0) => live.nextFrame((frame) => frame.lossless, from);

describe('edits', () => {
    test('the author is told twice, others once', async () => {
        const [a, b] = [await open(), await open()];
        assert.equal((await a.next('document')).document.name, 'Test');
        assert.equal(a.welcome.revision, 1);
        const edit = a.set(RADIUS, 1.25);
        assert.equal((await a.next('applied', { edit })).revision, 2);
        assert.equal((await a.next('applied', { edit, durable: true })).undo, 1);
        const changed = await b.next('changed');
        assert.deepEqual([changed.revision, changed.author], [2, a.welcome.author]);
        assert.deepEqual(changed.ops, [{ op: 'set', at: RADIUS, value: 1.25 }]);
        assert.equal(changed.edit, undefined);
        assert.equal(a.find('changed'), undefined);
        await Promise.all([a.close(), b.close()]);
    });

    test('a bad one is rejected with place, value and limit, and changes nothing', async () => {
        const live = await open();
        const before = await read();
        const nobody = '/nodes/nobody/name';
        const removal = { op: 'remove', at: '/nodes/root' };
        for (const [ops, code, place, message] of [
            [[{ op: 'set', at: RADIUS, value: 2000000 }], 'invalid', RADIUS, '2000000 is above the maximum 1000000'],
            [[{ op: 'set', at: nobody, value: 'x' }], 'not_found', nobody, 'there is no node "nobody"'],
            [[{ op: 'set', at: '/name', value: 'x' }, removal], 'conflict', '/nodes/root', 'the root cannot be removed'],
            [[{ op: 'paint', at: '/name' }], 'syntax', '/0/op', 'unknown operation "paint"'],
            ['no array', 'syntax', '', 'expected an array of operations'],
        ]) {
            const edit = live.change(ops);
            const rejected = await live.next('rejected', { edit });
            assert.deepEqual([rejected.code, rejected.place, rejected.message], [code, place, message]);
        }
        assert.equal(await read(), before);
        await live.close();
    });

    test('REST edits are told to everybody, and PUT brings a new document', async () => {
        const live = await open();
        await ask(daemon, 'PATCH', `/v1/scenes/${scene}`, [{ op: 'set', at: '/name', value: 'R' }]);
        assert.equal((await live.next('changed')).author, 'rest');
        const from = live.messages.length;
        await ask(daemon, 'PUT', `/v1/scenes/${scene}`, { ...DOCUMENT, name: 'New' });
        assert.equal((await live.next('document', {}, from)).document.name, 'New');
        await live.close();
    });

    test('a thousand in a row arrive in order, all durable', async () => {
        const [a, b] = [await open(), await open()];
        for (let i = 1; i <= 1000; i += 1) {
            a.set(RADIUS, 1 + i / 1000);
        }
        await a.next('applied', { edit: 1000, durable: true });
        await until(() => b.messages.filter((m) => m.type === 'changed').length === 1000, 'changes');
        const revisions = b.messages.filter((m) => m.type === 'changed').map((m) => m.revision);
        assert.deepEqual(revisions, Array.from({ length: 1000 }, (_, i) => i + 2));
        const durable = a.messages.filter((m) => m.type === 'applied' && m.durable).map((m) => m.edit);
        assert.equal(new Set(durable).size, 1000);
        await Promise.all([a.close(), b.close()]);
    });
});

describe('undo', () => {
    test('a newer value of somebody else stays, and its author is told', async () => {
        const [a, b] = [await open(), await open()];
        await a.next('applied', { edit: a.set(RADIUS, 0.4) });
        await b.next('applied', { edit: b.set(RADIUS, 0.7) });
        const refused = await a.next('rejected', { edit: a.step('undo') });
        assert.equal(refused.code, 'conflict');
        assert.equal(refused.place, RADIUS);
        assert.deepEqual(refused.skipped, [{ op: 'set', at: RADIUS, value: 1 }]);
        const ops = [
            { op: 'set', at: RADIUS, value: 0.5 },
            { op: 'set', at: '/nodes/ball/visible', value: false },
        ];
        await a.next('applied', { edit: a.change(ops) });
        await b.next('applied', { edit: b.set(RADIUS, 0.8) });
        const applied = await a.next('applied', { edit: a.step('undo') });
        assert.deepEqual(applied.skipped, [{ op: 'set', at: RADIUS, value: 0.7 }]);
        await a.next('applied', { edit: a.change(applied.skipped) });
        await b.next('changed', { revision: applied.revision + 1 });
        await Promise.all([a.close(), b.close()]);
    });

    test('each author undoes what is their own, and the document comes back byte for byte', async () => {
        const [a, b] = [await open(), await open()];
        const before = await read();
        await a.next('applied', { edit: a.set(RADIUS, 2) });
        await b.next('applied', { edit: b.set('/nodes/box/visible', false) });
        const undo = a.step('undo');
        const changed = await a.next('changed', { edit: undo });
        assert.deepEqual(changed.ops, [{ op: 'set', at: RADIUS, value: 1 }]);
        const applied = await a.next('applied', { edit: undo });
        assert.deepEqual([applied.undo, applied.redo], [0, 1]);
        await b.next('applied', { edit: b.step('undo') });
        assert.equal(await read(), before);
        await a.next('applied', { edit: a.step('redo') });
        assert.equal(JSON.parse(await read()).root.children[0].params.radius, 2);
        const none = b.step('undo');
        assert.equal((await b.next('rejected', { edit: none })).code, 'not_found');
        await Promise.all([a.close(), b.close()]);
    });

    test('a gesture is one step', async () => {
        const live = await open();
        const before = await read();
        for (let i = 1; i <= 30; i += 1) {
            live.set(RADIUS, 1 + i / 100, { group: 'drag-1' });
        }
        const last = await live.next('applied', { edit: 30 });
        assert.equal(last.undo, 1);
        await live.next('applied', { edit: live.step('undo') });
        assert.equal(await read(), before);
        await live.close();
    });
});

describe('waiting for a picture', () => {
    const poster = () => fetch(`${daemon.url}/v1/scenes/${scene}/poster.jpg`);

    test('the last picture is there at once, and after the room was left', async () => {
        assert.equal((await poster()).status, 204);
        assert.equal((await fetch(`${daemon.url}/v1/scenes/nobody/poster.jpg`)).status, 404);
        const live = await open();
        live.look({ width: 128, height: 96 });
        const frame = await live.nextFrame((one) => one.still && one.codec === 'jpeg');
        const answer = await poster();
        assert.equal(answer.headers.get('content-type'), 'image/jpeg');
        assert.deepEqual(Buffer.from(await answer.arrayBuffer()), frame.payload);
        for (const own of [{ isolate: ['box'] }, { section: { offset: 0 } }]) {
            live.look({ width: 128, height: 96, ...own });
            await live.nextFrame((one) => one.still && one.codec === 'jpeg' && one.seq === live.seq);
            assert.deepEqual(Buffer.from(await (await poster()).arrayBuffer()), frame.payload);
        }
        await live.close();
    });

    test('a copy of an example has its card, a copy of a scene its picture', async () => {
        const card = await (await fetch(`${daemon.url}/v1/examples/gyroid/card.jpg`)).arrayBuffer();
        await ask(daemon, 'POST', `/v1/scenes?id=${scene}-gyroid`, { from: 'example:gyroid' });
        await ask(daemon, 'POST', `/v1/scenes?id=${scene}-copy`, { from: `scene:${scene}-gyroid` });
        for (const id of [`${scene}-gyroid`, `${scene}-copy`]) {
            const answer = await fetch(`${daemon.url}/v1/scenes/${id}/poster.jpg`);
            assert.deepEqual(Buffer.from(await answer.arrayBuffer()), Buffer.from(card));
        }
    });

    test('rounds of samples are counted', async () => {
        const live = await open();
        await live.next('applied', { edit: live.set('/render/samples', 4) });
        live.look({ width: 96, height: 64 });
        const last = await live.nextFrame((frame) => frame.lossless && frame.rounds > 1);
        assert.equal(last.round, last.rounds);
        const between = live.frames.filter((frame) => frame.still && frame.rounds > 1);
        assert.ok(between.every((frame) => frame.round <= frame.rounds));
        await live.close();
    });

    test('viewers are told of a long compilation, and when it is over', async () => {
        const live = await open();
        live.look();
        await still(live);
        await standStill(daemon.worker()); // the compiler takes as long as this test likes
        const edit = live.change([
            { op: 'insert', into: '/nodes/root', before: null, value: { type: 'torus' } },
        ]);
        const { revision } = await live.next('applied', { edit });
        const told = await live.next('compiling', { over: false });
        assert.equal(told.revision, revision);
        assert.ok(told.elapsed_ms >= 250);
        process.kill(daemon.worker(), 'SIGCONT');
        const over = await live.next('compiling', { over: true });
        assert.ok(over.elapsed_ms >= told.elapsed_ms);
        await live.close();
    });
});

describe('coming back', () => {
    test('brings what was missed, one’s own edits with their numbers', async () => {
        const [a, b] = [await open(), await open()];
        await a.next('applied', { edit: a.set(RADIUS, 1.5) });
        const { epoch } = a.welcome;
        await a.close();
        await b.next('applied', { edit: b.set(RADIUS, 1.75) });
        const again = await open({ client: a.client, resume: { revision: 1, epoch } });
        await again.next('changed', { revision: 3 });
        const kinds = again.messages.map((m) => [m.type, m.revision, m.edit]);
        assert.deepEqual(kinds, [['welcome', 3, undefined], ['changed', 2, 1], ['changed', 3, undefined]]);
        assert.equal(again.welcome.last_edit, 1);
        await Promise.all([again.close(), b.close()]);
    });

    test('of another epoch brings the document', async () => {
        const live = await open({ resume: { revision: 1, epoch: 'another' } });
        assert.equal((await live.next('document')).revision, 1);
        await live.close();
    });

    test('with an edit that is in already changes nothing', async () => {
        const a = await open();
        const edit = a.set(RADIUS, 1.5);
        const first = await a.next('applied', { edit, durable: true });
        await a.close();
        const again = await open({ client: a.client });
        again.say({ type: 'edit', edit, ops: [{ op: 'set', at: RADIUS, value: 1.5 }] });
        const answer = await again.next('applied', { edit });
        assert.deepEqual([answer.revision, answer.durable], [first.revision, true]);
        assert.equal((await ask(daemon, 'GET', '/v1/scenes')).scenes.find((s) => s.id === scene).revision, 2);
        await again.close();
    });

    test('as the same client ends the older connection', async () => {
        const a = await open();
        const b = await open({ client: a.client });
        assert.equal((await a.next('bye')).reason, 'replaced');
        assert.equal(a.find('bye').retry_ms, undefined);
        await until(() => a.closed, 'the end');
        assert.equal(a.closeCode, 1000);
        await b.close();
    });

    test('after a scene was deleted ends', async () => {
        const live = await open();
        await ask(daemon, 'DELETE', `/v1/scenes/${scene}`);
        assert.equal((await live.next('bye')).reason, 'deleted');
        await until(() => live.closed, 'the end');
    });
});

describe('form', () => {
    test('the first message is hello', async () => {
        const live = await open({ hello: false });
        live.look();
        assert.equal((await live.next('bye')).reason, 'protocol');
        await until(() => live.closed, 'the end');
        assert.equal(live.closeCode, 1008);
    });

    test('a client names itself well', async () => {
        const live = await open({ hello: false });
        live.say({ type: 'hello', client: 'short' });
        assert.equal((await live.next('notice')).place, '/client');
        await live.close();
    });

    test('what is not understood is told, and the connection goes on', async () => {
        const live = await open();
        for (const text of ['{', '[]', '{"type":"fly"}', '{"type":"view","seq":1,"width":0,"height":1}', '{"type":"ack"}']) {
            const from = live.messages.length;
            live.sayText(text);
            assert.equal((await live.next('notice', {}, from)).level, 'error', text);
        }
        await live.next('applied', { edit: live.set(RADIUS, 2) });
        await live.close();
    });

    test('a message has a limit', async () => {
        const live = await open();
        live.sayText(' '.repeat(1048577));
        await until(() => live.closed, 'the end');
        assert.equal(live.closeCode, 1009);
    });

    test('binary messages are for the other direction', async () => {
        const live = await open();
        live.sayBytes(Buffer.from('FCF1'));
        await until(() => live.closed, 'the end');
        assert.equal(live.closeCode, 1003);
    });
});

describe('frames', () => {
    let withoutPixels;
    before(async () => {
        withoutPixels = daemon;
        daemon = await startDaemon();
    });
    after(async () => {
        await daemon.stop();
        daemon = withoutPixels;
    });

    test('move, rest, and end as the pixels of image.png', async () => {
        const live = await open();
        const seq = live.look({ width: 96, height: 64 });
        const last = await still(live);
        assert.deepEqual([last.codec, last.seq, last.width, last.height], ['png', seq, 96, 64]);
        // Where full size takes long, a larger moving picture comes in between.
        const kinds = new Set(live.frames.map((frame) => `${frame.codec} ${frame.still} ${frame.lossless}`));
        assert.deepEqual([...kinds], ['jpeg false false', 'jpeg true false', 'png true true']);
        const image = await fetch(`${daemon.url}/v1/scenes/${scene}/image.png?width=96&height=64`);
        assert.equal(Number(image.headers.get('fieldcast-revision')), last.revision);
        const [shown, asked] = [decodePng(last.payload), decodePng(Buffer.from(await image.arrayBuffer()))];
        assert.ok(new Set(shown.pixels).size > 10, 'the picture is not empty');
        assert.ok(shown.pixels.equals(asked.pixels), 'the pixels are the same');
        await live.close();
    });

    test('of many samples are shown on the way', async () => {
        const live = await open();
        live.look({ width: 96, height: 64, camera: { position: [3, 2, 4], target: [0, 0, 0], aperture: 0.2 } });
        const last = await still(live);
        const before = live.frames.filter((frame) => frame.codec === 'png' && !frame.lossless);
        assert.equal(before.length, 1, '4 of 16 samples');
        assert.ok(before[0].still && before[0].seq === last.seq && before[0].number < last.number);
        assert.notDeepEqual(decodePng(before[0].payload).pixels, decodePng(last.payload).pixels);
        await live.close();
    });

    test('of isolated nodes are one viewer’s own, and so are the picks', async () => {
        const [a, b] = [await open(), await open()];
        const size = { width: 96, height: 64 };
        const pixels = (frame) => decodePng(frame.payload).pixels;
        const settle = (live, view) => {
            const seq = live.look({ ...size, ...view });
            return live.nextFrame((frame) => frame.lossless && frame.seq === seq);
        };
        const pick = async (live, number) => {
            live.say({ type: 'pick', pick: number, x: 48, y: 32, seq: live.seq });
            return (await live.next('picked', { pick: number })).node;
        };
        const [all, others] = [await settle(a), await settle(b)];
        assert.ok(pixels(all).equals(pixels(others)));
        const shown = b.frames.length;
        const alone = await settle(a, { isolate: ['box', 'nobody', 'box'] });
        const [, box] = DOCUMENT.root.children;
        const root = { ...DOCUMENT.root, children: [box] };
        const asked = await fetch(`${daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify({ scene: { ...DOCUMENT, root }, ...size }),
        });
        assert.ok(pixels(alone).equals(decodePng(Buffer.from(await asked.arrayBuffer())).pixels));
        assert.ok(!pixels(alone).equals(pixels(all)));
        assert.equal(await pick(a, 1), null);
        assert.equal(await pick(b, 1), 'ball');
        assert.equal(alone.revision, all.revision);
        assert.equal(a.messages.concat(b.messages).filter((m) => m.type === 'changed').length, 0);
        assert.equal(b.frames.length, shown, 'nobody else was sent a picture');
        assert.ok(pixels(await settle(a, { isolate: ['nobody'] })).equals(pixels(all)));
        assert.equal(await pick(a, 2), 'ball');
        await Promise.all([a.close(), b.close()]);
    });

    test('of a section are one viewer’s own, and so are the picks and guides', async () => {
        const [a, b] = [await open(), await open()];
        const size = { width: 96, height: 64 };
        const pixels = (frame) => decodePng(frame.payload).pixels;
        const settle = (live, view) => {
            const seq = live.look({ ...size, ...view });
            return live.nextFrame((frame) => frame.lossless && frame.seq === seq);
        };
        const pick = async (live, number) => {
            live.say({ type: 'pick', pick: number, x: 48, y: 32, seq: live.seq });
            return await live.next('picked', { pick: number });
        };
        const [all, others] = [await settle(a), await settle(b)];
        const whole = await pick(a, 1);
        const shown = b.frames.length;
        const section = { normal: [0, 0, 4], offset: 0.25 };
        const cut = await settle(a, { section });
        const picked = await pick(a, 2);
        const query = 'width=96&height=64&section.normal=0,0,4&section.offset=0.25';
        const image = await fetch(`${daemon.url}/v1/scenes/${scene}/image.png?${query}`);
        const posted = await fetch(`${daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify({ scene, ...size, section }),
        });
        assert.ok(!pixels(cut).equals(pixels(all)));
        for (const answer of [image, posted]) {
            const asked = decodePng(Buffer.from(await answer.arrayBuffer())).pixels;
            assert.ok(pixels(cut).equals(asked));
        }
        assert.equal(whole.node, 'ball');
        assert.equal(picked.node, 'ball');
        assert.ok(Math.abs(picked.position[2] - 0.25) < 1e-3);
        assert.deepEqual(picked.normal, [0, 0, 1]);
        assert.ok(picked.distance > whole.distance + 0.1);
        assert.equal(cut.revision, all.revision);
        assert.equal(a.messages.concat(b.messages).filter((m) => m.type === 'changed').length, 0);
        assert.equal(b.frames.length, shown, 'nobody else was sent a picture');
        assert.ok(pixels(await settle(b, { quality: 'sharp' })).equals(pixels(others)));
        assert.ok(pixels(await settle(a)).equals(pixels(all)));
        a.say({ type: 'view', seq: 99, ...size, section: { normal: [0, 0, 0] } });
        const refused = await a.next('notice', { place: '/section/normal' });
        assert.match(refused.message, /no direction/);
        await Promise.all([a.close(), b.close()]);
    });

    test('follow the camera of the view, which image.png can be given too', async () => {
        const live = await open();
        const camera = { position: [3, 2, 4], target: [1, 0, 0], fov: 30 };
        live.look({ width: 80, height: 60, camera });
        const last = await still(live);
        const image = await fetch(
            `${daemon.url}/v1/scenes/${scene}/image.png?width=80&height=60&camera.position=3,2,4&camera.target=1,0,0&camera.fov=30`,
        );
        const asked = decodePng(Buffer.from(await image.arrayBuffer()));
        assert.ok(decodePng(last.payload).pixels.equals(asked.pixels));
        await live.close();
    });

    test('come after an edit, and not without a change', async () => {
        const live = await open();
        live.look();
        await still(live);
        const count = live.frames.length;
        const cpu = cpuSecondsOf(daemon.pid);
        await sleep(1500);
        assert.equal(live.frames.length, count);
        assert.ok(cpuSecondsOf(daemon.pid) - cpu < 0.3, 'resting costs processor time');
        live.look(); // the same picture under a new number
        live.edit += 1;
        live.say({ type: 'edit', edit: live.edit, ops: [{ op: 'set', at: RADIUS, value: 1.5 }] });
        const next = await live.nextFrame((frame) => frame.revision === 2 && frame.lossless);
        assert.equal(next.seq, live.seq);
        await live.close();
    });

    test('numbers change nothing that would have to be compiled', async (t) => {
        const compiling = await startDaemon({ driver: 'null', args: ['--stage', 'compute'] });
        t.after(() => compiling.stop());
        assert.equal((await ask(compiling, 'GET', '/readyz')).stage, 'compute');
        await ask(compiling, 'POST', `/v1/scenes?id=${scene}`, DOCUMENT);
        const live = await Live.open(compiling, scene);
        live.look();
        await still(live);
        await sleep(600); // the worker's counters come with its next pong
        const compiled = await counter(compiling, 'shader_compilations_total');
        assert.ok(compiled > 0);
        for (let i = 1; i <= 100; i += 1) {
            live.set(RADIUS, 1 + i / 1000);
        }
        await live.nextFrame((frame) => frame.revision === 101 && frame.lossless);
        await sleep(600);
        assert.equal(await counter(compiling, 'shader_compilations_total'), compiled);
        await live.close();
    });

    test('wait for acknowledgements: no second one comes before the first, no third after', async () => {
        const live = await open({ ack: false });
        live.look();
        await live.nextFrame();
        await sleep(600);
        assert.equal(live.frames.length, 1);
        live.acknowledge(1);
        live.look({ width: 80 });
        await until(() => live.frames.length === 3, 'two more frames');
        for (let i = 0; i < 20; i += 1) {
            live.set(RADIUS, 1 + i / 100);
            await sleep(20);
        }
        await sleep(300);
        assert.equal(live.frames.length, 3);
        live.acknowledge(2);
        await until(() => live.frames.length === 4, 'the fourth');
        await sleep(300);
        assert.equal(live.frames.length, 4);
        assert.equal(live.frames[3].revision, 21, 'the newest state is shown, not what was missed');
        await live.close();
    });

    test('stop for a page that is hidden', async () => {
        const live = await open();
        live.look();
        await still(live);
        live.look({ visible: false });
        await live.next('applied', { edit: live.set(RADIUS, 2) });
        const count = live.frames.length;
        await sleep(600);
        assert.equal(live.frames.length, count);
        live.look({ visible: true });
        await live.nextFrame((frame) => frame.revision === 2 && frame.lossless);
        await live.close();
    });

    test('have the size of the newest view', async () => {
        const live = await open();
        live.look({ width: 64, height: 48 });
        live.look({ width: 120, height: 40 });
        const last = await still(live);
        assert.deepEqual([last.width, last.height, last.viewWidth, last.viewHeight], [120, 40, 120, 40]);
        await live.close();
    });

    test('of other outputs are exact too', async () => {
        const live = await open();
        for (const aov of ['normal', 'depth', 'id']) {
            const from = live.frames.length;
            live.look({ aov });
            const last = await still(live, from);
            const image = await fetch(`${daemon.url}/v1/scenes/${scene}/image.png?width=64&height=48&aov=${aov}`);
            const asked = decodePng(Buffer.from(await image.arrayBuffer()));
            assert.ok(decodePng(last.payload).pixels.equals(asked.pixels), aov);
        }
        await live.close();
    });

    test('a structural edit is shown soon, and a picture is there until then', async () => {
        const live = await open();
        live.look();
        await still(live);
        live.change([{ op: 'insert', into: '/nodes/root', before: null, value: { id: 'ring', type: 'torus' } }]);
        live.look({ camera: { position: [0, 1, 7] } });
        await live.nextFrame((frame) => frame.seq === live.seq);
        const last = await live.nextFrame((frame) => frame.revision === 2 && frame.lossless);
        assert.equal(last.stale, false);
        await live.close();
    });

    test('what is under a pixel', async () => {
        const live = await open();
        live.look({ width: 100, height: 100, camera: { position: [0, 0, 6], target: [0, 0, 0] } });
        live.say({ type: 'pick', pick: 7, x: 50, y: 50, seq: live.seq });
        const hit = await live.next('picked', { pick: 7 });
        assert.equal(hit.node, 'ball');
        assert.ok(Math.abs(hit.distance - 5) < 1e-2);
        live.say({ type: 'pick', pick: 8, x: 1, y: 1 });
        assert.equal((await live.next('picked', { pick: 8 })).node, null);
        assert.equal('through' in hit, false, 'not asked for');
        live.say({ type: 'pick', pick: 9, x: 50, y: 50, through: true });
        assert.deepEqual((await live.next('picked', { pick: 9 })).through, ['ball']);
        live.say({ type: 'pick', pick: 10, x: 1, y: 1, through: true });
        assert.deepEqual((await live.next('picked', { pick: 10 })).through, []);
        await live.close();
    });

    test('how large a node is', async () => {
        const live = await open();
        live.say({ type: 'bounds', bounds: 7, nodes: ['ball'] });
        assert.deepEqual((await live.next('bounded', { bounds: 7 })).high, [1, 1, 1]);
        await live.close();
    });

    test('of many questions at once the newest are answered, in their order', async () => {
        const live = await open();
        live.look({ width: 100, height: 100, camera: { position: [0, 0, 6], target: [0, 0, 0] } });
        const before = await counter(daemon, 'picks_given_up_total');
        for (let pick = 1; pick <= 500; pick += 1) {
            live.say({ type: 'pick', pick, x: 50, y: 50, seq: live.seq });
        }
        await live.next('picked', { pick: 500 });
        const answered = live.messages.filter((m) => m.type === 'picked').map((m) => m.pick);
        assert.deepEqual(answered.slice(-8), [493, 494, 495, 496, 497, 498, 499, 500]);
        assert.deepEqual(answered, [...answered].sort((a, b) => a - b));
        assert.equal((await counter(daemon, 'picks_given_up_total')) - before, 500 - answered.length);
        await live.close();
    });

    test('what is under a pixel while the newest state cannot be drawn is of the one before', async () => {
        const primitives = (code) => ({ p: { code } });
        const root = { id: 'own', type: 'field', params: { primitive: 'p' } };
        await ask(daemon, 'POST', '/v1/scenes?id=broken-code', {
            format: 'fieldcast/1',
            primitives: primitives('float sdf(vec3 p) { return length(p) - 1; }'),
            root,
        });
        const live = await Live.open(daemon, 'broken-code');
        live.look({ width: 100, height: 100, camera: { position: [0, 0, 6], target: [0, 0, 0] } });
        const look = async (pick) => {
            live.say({ type: 'pick', pick, x: 50, y: 50, seq: live.seq });
            const { node, revision } = await live.next('picked', { pick });
            return { node, revision };
        };
        assert.deepEqual(await look(1), { node: 'own', revision: 1 });
        live.set('/primitives/p/code', 'float sdf(vec3 p) { return length(p) - ; }');
        assert.deepEqual(await look(2), { node: 'own', revision: 1 });
        live.set('/primitives/p/code', 'float sdf(vec3 p) { return length(p) - 2; }');
        let pick = 2;
        const newest = async () => (await look((pick += 1))).revision === 3;
        await until(newest, 'the newest state, once it can be drawn');
        await live.close();
    });
});

test('a picture is drawn once for all who ask, until the scene changes', async () => {
    const at = `${daemon.url}/v1/scenes/${scene}/image.png?width=40&height=30`;
    const first = await fetch(at);
    const drawn = await counter(daemon, 'renders_total');
    const again = await fetch(at);
    assert.ok(Buffer.from(await first.arrayBuffer()).equals(Buffer.from(await again.arrayBuffer())));
    assert.equal(again.headers.get('etag'), first.headers.get('etag'));
    const known = await fetch(at, { headers: { 'if-none-match': first.headers.get('etag') } });
    assert.equal(known.status, 304);
    assert.equal(await counter(daemon, 'renders_total'), drawn);
    await ask(daemon, 'PATCH', `/v1/scenes/${scene}`, [{ op: 'set', at: RADIUS, value: 2 }]);
    const changed = await fetch(at, { headers: { 'if-none-match': first.headers.get('etag') } });
    assert.equal(changed.status, 200);
    assert.equal(changed.headers.get('fieldcast-revision'), '2');
    assert.equal(await counter(daemon, 'renders_total'), drawn + 1);
});

test('a client that stops reading costs no memory and leaves others their frames', async () => {
    const [slow, fast] = [await open(), await open()];
    slow.look({ width: 640, height: 480 });
    fast.look();
    await still(fast);
    // Edits of 60 kB, one step of undo: only what waits for the slow client could grow.
    const text = 'x'.repeat(190);
    const ops = (i) => Array.from({ length: 250 }, () => ({ op: 'set', at: '/nodes/ball/name', value: text + i }));
    const churn = async (edits) => {
        const [from, heard] = [fast.frames.length, fast.messages.length];
        for (let i = 0; i < edits; i += 1) {
            fast.look({ camera: { position: [0, 1, 5 + (i % 50) / 50] } });
            await fast.next('applied', { edit: fast.change(ops(i), { group: 'one' }) }, fast.messages.length);
            await sleep(5);
        }
        await fast.nextFrame((frame) => frame.seq === fast.seq && frame.revision > fast.edit, from);
        await fast.next('applied', { edit: fast.edit, durable: true }, heard); // none waits for the disk
        return edits * 60000;
    };
    await churn(50);
    slow.stopReading();
    await churn(200); // more than the server and the kernel keep for it
    const before = memoryOf(daemon.pid);
    const bytes = await churn(400); // what threads keep of freed memory is 3 MB of it at most
    const grown = memoryOf(daemon.pid) - before;
    assert.ok(grown < bytes / 4, `${bytes} bytes of edits, and the server grew by ${grown}`);
    slow.goOnReading();
    await until(() => slow.closed, 'the slow one to be closed');
    await fast.close();
});

describe('who may', () => {
    let guarded;
    let scratch;
    const token = 'a-token-that-only-tests-know';
    before(async () => {
        scratch = makeDirectory();
        fs.writeFileSync(path.join(scratch, 'token'), token);
        guarded = await startDaemon({
            driver: 'null',
            args: ['--token-file', path.join(scratch, 'token'), '--allow-origin', 'https://friend.example'],
        });
        await fetch(`${guarded.url}/v1/scenes?id=g`, {
            method: 'POST',
            headers: { authorization: `Bearer ${token}`, 'content-type': 'application/json' },
            body: JSON.stringify(DOCUMENT),
        });
    });
    after(async () => {
        await guarded.stop();
        removeDirectory(scratch);
    });

    const offered = (text) => ({ 'Sec-WebSocket-Protocol': text });
    for (const [name, headers, status] of [
        ['no token', {}, 401],
        ['a token', offered(`fieldcast.v1, fieldcast.token.${token}`), 101],
        ['a wrong token', offered(`fieldcast.v1, fieldcast.token.${token}x`), 401],
        ['a token without the protocol', offered(`fieldcast.token.${token}`), 426],
        ['a token as a header', { Authorization: `Bearer ${token}` }, 101],
        ['a token from a friend’s page', { Authorization: `Bearer ${token}`, Origin: 'https://friend.example' }, 101],
        ['a token from another page', { Authorization: `Bearer ${token}`, Origin: 'https://evil.example' }, 403],
        ['a token under another host', { Authorization: `Bearer ${token}`, Host: 'evil.example' }, 403],
    ]) {
        test(name, async () => {
            const live = new Live(guarded, 'g', { headers });
            await until(() => live.status, 'an answer');
            assert.match(live.status, new RegExp(` ${status} `));
            if (status === 101) {
                assert.match(live.head, /Sec-WebSocket-Protocol: fieldcast\.v1\r?$/im);
                await live.close();
            }
            live.socket.destroy();
        });
    }
});

test('a public address without a token is refused, with the remedy', async () => {
    await assert.rejects(startDaemon({ args: ['--host', '0.0.0.0'] }), /--token-file/);
});

/* After all that was said above. */
describe('the table of messages', () => {
    let table;
    before(async () => {
        table = (await (await fetch(`${daemon.url}/v1/schema.json`)).json())['x-fieldcast'].messages;
    });

    test('says what each message of the server holds', () => {
        const rows = new Map(table.server.map((row) => [row.type, row.members]));
        const seen = new Set();
        for (const { at, type, ...members } of opened.flatMap((live) => live.messages)) {
            const row = rows.get(type);
            assert.ok(row, `a message ${type} is in no row of protocol/messages.c`);
            const known = row.map(({ name }) => name);
            const lacking = row.filter(({ name, required }) => required && !(name in members)).map(({ name }) => name);
            assert.deepEqual(lacking, [], `${type} lacks members`);
            assert.deepEqual(Object.keys(members).filter((name) => !known.includes(name)), [], `${type} has members of no row`);
            seen.add(type);
        }
        assert.deepEqual([...rows.keys()].filter((type) => !seen.has(type)), [], 'messages that nobody was sent here');
    });

    test('is known to the page', () => {
        const files = ['web/src/link/protocol.ts', 'web/src/model/session.ts'];
        const texts = files.map((file) => fs.readFileSync(file, 'utf8')).join('');
        const page = new Set([...texts.matchAll(/\breadonly type: "(\w+)"/g)].map(([, type]) => type));
        const sorted = (rows) => rows.map(({ type }) => type).sort();
        assert.deepEqual([...page].sort(), sorted([...table.client, ...table.server]));
        const [, list] = /\bSERVER_TYPES = \{([^}]*)\}/.exec(texts);
        assert.deepEqual([...list.matchAll(/\w+(?=: true)/g)].map(([type]) => type).sort(), sorted(table.server));
    });

    test('stands in protocol/README.md', () => {
        const readme = fs.readFileSync('protocol/README.md', 'utf8');
        for (const [side, title] of [['client', 'Client to server'], ['server', 'Server to client']]) {
            const [, section] = new RegExp(`^### ${title}\\n([^#]*)`, 'm').exec(readme);
            const first = [...section.matchAll(/^\| (`.*?) \|/gm)].flatMap(([, cell]) => cell.match(/\w+/g));
            assert.deepEqual(first.sort(), table[side].map(({ type }) => type).sort());
        }
    });
});
