// SPDX-License-Identifier: MIT
// Files that scenes name: sent, kept over restarts, shown as what is around a scene, and what is
// said of those that are none.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { execFile } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { promisify } from 'node:util';

import { ask, makeDirectory, program, removeDirectory, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const run = promisify(execFile);
const WIDTH = 64;
const HEIGHT = 32;

/** What is seen along each axis: red, green and blue of a picture of the sides of the world. */
const SIDES = [
    { along: [1, 0, 0], color: [4, 0, 0] },
    { along: [-1, 0, 0], color: [0, 2, 0] },
    { along: [0, 0, -1], color: [0, 0, 1] },
    { along: [0, 0, 1], color: [0.5, 0.5, 0] },
    { along: [0, 1, 0], color: [1, 1, 1] },
    { along: [0, -1, 0], color: [0.25, 0, 0.25] },
];

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** A Radiance file in flat rows; its middle looks along -Z, +X is right of it. */
function radiance(colorOf) {
    const head = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${HEIGHT} +X ${WIDTH}\n`;
    const bytes = Buffer.alloc(4 * WIDTH * HEIGHT);
    for (let i = 0; i < WIDTH * HEIGHT; i += 1) {
        const longitude = (((i % WIDTH) + 0.5) / WIDTH - 0.5) * 2 * Math.PI;
        const latitude = ((Math.floor(i / WIDTH) + 0.5) / HEIGHT) * Math.PI;
        const s = Math.sin(latitude);
        const rgb = colorOf([s * Math.sin(longitude), Math.cos(latitude), -s * Math.cos(longitude)]);
        const exponent = Math.floor(Math.log2(Math.max(...rgb, 1e-9))) + 1;
        rgb.forEach((value, k) => (bytes[4 * i + k] = Math.min(255, Math.round(value * 2 ** (8 - exponent)))));
        bytes[4 * i + 3] = exponent + 128;
    }
    return Buffer.concat([Buffer.from(head), bytes]);
}

const nearest = (d) => SIDES.reduce((a, b) => (dot(d, b.along) > dot(d, a.along) ? b : a));
const sides = radiance((d) => nearest(d).color);
const digest = (bytes) => createHash('sha256').update(bytes).digest('hex');

const scene = (image, more = {}) => ({
    format: 'fieldcast/1',
    environment: { type: 'image', image, color: [0.5, 0.25, 0.125], ...more },
    render: { tone_map: 'none', level: 'interactive', antialiasing: 'none' },
    root: { id: 'dot', type: 'sphere', params: { radius: 0.001 }, transform: { translation: [0, 900, 0] } },
});

const send = (daemon, body, headers = {}) =>
    fetch(`${daemon.url}/v1/assets`, { method: 'POST', body, headers });

/** Linear colour of the one pixel that looks along a direction. */
async function colorAlong(daemon, id, [x, y, z]) {
    const up = Math.abs(y) > 0.9 ? '0,0,1' : '0,1,0';
    const at = `/v1/scenes/${id}/image.npy?width=1&height=1&camera.position=0,0,0&camera.target=${x},${y},${z}&camera.up=${up}&camera.fov=1`;
    const answer = await fetch(daemon.url + at);
    const bytes = Buffer.from(await answer.arrayBuffer());
    assert.equal(answer.status, 200, bytes.toString());
    const start = 10 + bytes.readUInt16LE(8);
    return [0, 4, 8].map((offset) => bytes.readFloatLE(start + offset));
}

function assertNear(actual, expected, what) {
    actual.forEach((value, i) =>
        assert.ok(Math.abs(value - expected[i]) < 0.02 * Math.max(1, expected[i]), `${what}: ${actual}, not ${expected}`),
    );
}

describe('files that scenes name', () => {
    let daemon;
    const data = makeDirectory();
    before(async () => {
        daemon = await startDaemon({ data });
    });
    after(async () => {
        await daemon.stop();
        removeDirectory(data);
    });

    test('a file is kept under its digest, once', async () => {
        const first = await send(daemon, sides);
        assert.equal(first.status, 201);
        assert.equal(first.headers.get('location'), `/v1/assets/${digest(sides)}`);
        const about = { id: digest(sides), type: 'image/vnd.radiance', width: 64, height: 32, bytes: sides.length };
        assert.deepEqual(await first.json(), about);
        const second = await send(daemon, sides);
        assert.equal(second.status, 200);
        assert.deepEqual(await second.json(), about);
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        assert.deepEqual(assets.filter((one) => one.id === about.id), [about]);
    });

    test('it comes back as it was', async () => {
        const answer = await fetch(`${daemon.url}/v1/assets/${digest(sides)}`);
        assert.equal(answer.headers.get('content-type'), 'image/vnd.radiance');
        assert.match(answer.headers.get('cache-control'), /immutable/);
        assert.deepEqual(Buffer.from(await answer.arrayBuffer()), sides);
    });

    test('what is built in for the examples is there', async () => {
        const file = fs.readFileSync('protocol/examples/assets/studio.hdr');
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        assert.ok(assets.some((one) => one.id === digest(file) && one.width === 256));
        const answer = await fetch(`${daemon.url}/v1/assets/${digest(file)}`);
        assert.deepEqual(Buffer.from(await answer.arrayBuffer()), file);
    });

    for (const { along, color } of SIDES) {
        test(`along ${along} it shows ${color}`, async () => {
            if (!(await fetch(`${daemon.url}/v1/scenes/s`)).ok) {
                await ask(daemon, 'POST', '/v1/scenes?id=s', scene(digest(sides)));
            }
            assertNear(await colorAlong(daemon, 's', along), color, 'the picture');
        });
    }

    test('turned by a quarter about +Y, and brighter', async () => {
        const more = { rotation: Math.PI / 2, brightness: 3 };
        await ask(daemon, 'POST', '/v1/scenes?id=turned', scene(digest(sides), more));
        assertNear(await colorAlong(daemon, 'turned', [0, 0, -1]), [12, 0, 0], 'what was along +X');
        assertNear(await colorAlong(daemon, 'turned', [1, 0, 0]), [1.5, 1.5, 0], 'what was along +Z');
    });

    test('an edit changes what is around', async () => {
        const other = radiance(() => [0, 0, 2]);
        await send(daemon, other);
        const edit = [{ op: 'set', at: '/environment/image', value: digest(other) }];
        await ask(daemon, 'PATCH', '/v1/scenes/turned', edit);
        assertNear(await colorAlong(daemon, 'turned', [0, 0, -1]), [0, 0, 6], 'the other picture');
    });

    test('a scene may come before its file', async () => {
        const late = radiance(() => [1, 0, 1]);
        await ask(daemon, 'POST', '/v1/scenes?id=early', scene(digest(late)));
        const live = await Live.open(daemon, 'early');
        live.look({ width: 32, height: 32, camera: {} });
        const notice = await live.next('notice', { code: 'asset' });
        assert.equal(notice.place, '/environment/image');
        assertNear(await colorAlong(daemon, 'early', [0, 0, -1]), [0.5, 0.25, 0.125], 'the one colour');
        await live.nextFrame((frame) => frame.lossless);
        const from = live.frames.length;
        assert.equal((await send(daemon, late)).status, 201);
        assertNear(await colorAlong(daemon, 'early', [0, 0, -1]), [1, 0, 1], 'the picture');
        await live.nextFrame((frame) => frame.lossless, from);
        live.close();
    });

    test('of a scene that names no file yet nothing is said', async () => {
        await ask(daemon, 'POST', '/v1/scenes?id=unnamed', scene(''));
        const live = await Live.open(daemon, 'unnamed');
        live.look({ width: 32, height: 32, camera: {} });
        await live.nextFrame((frame) => frame.lossless);
        assert.deepEqual(live.messages.filter(({ type }) => type === 'notice'), []);
        live.close();
    });

    test('a picture asked for with its scene has it too', async () => {
        const body = { scene: scene(digest(sides)), width: 16, height: 16, format: 'png' };
        const ask = async (document) =>
            Buffer.from(
                await (
                    await fetch(`${daemon.url}/v1/render`, {
                        method: 'POST',
                        headers: { 'content-type': 'application/json' },
                        body: JSON.stringify({ ...body, scene: document }),
                    })
                ).arrayBuffer(),
            );
        assert.notDeepEqual(await ask(body.scene), await ask(scene('0'.repeat(64))));
    });

    test('a picture drawn without its file is drawn anew with it, also where another file went', async () => {
        const [other, late] = [[3, 0, 0], [0, 3, 0]].map((color) => radiance(() => color));
        const document = scene(digest(late));
        const draw = (headers = {}) =>
            fetch(`${daemon.url}/v1/render`, {
                method: 'POST',
                headers: { 'content-type': 'application/json', ...headers },
                body: JSON.stringify({ scene: document, width: 16, height: 16, format: 'png' }),
            });
        assert.equal((await send(daemon, other)).status, 201);
        const before = await draw();
        const without = Buffer.from(await before.arrayBuffer());
        assert.equal((await fetch(`${daemon.url}/v1/assets/${digest(other)}`, { method: 'DELETE' })).status, 204);
        assert.equal((await send(daemon, late)).status, 201);
        const again = await draw({ 'if-none-match': before.headers.get('etag') });
        assert.equal(again.status, 200);
        assert.notDeepEqual(Buffer.from(await again.arrayBuffer()), without);
    });

    test('a damaged file is said to be one, and the one colour stands for it', async () => {
        const cut = sides.subarray(0, sides.length / 2);
        assert.equal((await send(daemon, cut)).status, 201);
        await ask(daemon, 'POST', '/v1/scenes?id=cut', scene(digest(cut)));
        const live = await Live.open(daemon, 'cut');
        live.look({ width: 32, height: 32, camera: {} });
        const notice = await live.next('notice', { code: 'asset' });
        assert.match(notice.message, /row 16 of 32 of the Radiance file is cut off/);
        live.close();
        assertNear(await colorAlong(daemon, 'cut', [1, 0, 0]), [0.5, 0.25, 0.125], 'the one colour');
    });

    test('the next render process gets it again', async () => {
        const worker = daemon.worker();
        process.kill(worker, 'SIGKILL');
        await until(() => daemon.worker() && daemon.worker() !== worker, 'another worker');
        const at = `${daemon.url}/v1/scenes/s/image.npy?width=2&height=1&camera.position=0,0,0&camera.target=1,0,0&camera.fov=1`;
        const bytes = Buffer.from(await (await fetch(at)).arrayBuffer());
        assertNear([bytes.readFloatLE(10 + bytes.readUInt16LE(8))], [4], 'red along +X');
    });

    test('all is there after a restart', async () => {
        await daemon.kill('SIGKILL');
        daemon = await startDaemon({ data });
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        assert.ok(assets.some((one) => one.id === digest(sides)));
        assertNear(await colorAlong(daemon, 's', [1, 0, 0]), [4, 0, 0], 'the picture');
    });

    test('the command line draws the same', async () => {
        const file = path.join(data, 'sides.hdr');
        const document = path.join(data, 'scene.json');
        const out = path.join(data, 'out.png');
        fs.writeFileSync(file, sides);
        fs.writeFileSync(document, JSON.stringify(scene(digest(sides))));
        const size = ['--width', '64', '--height', '36'];
        const without = await run(program, ['render', document, '-o', out, ...size]);
        assert.match(without.stderr, /warning: \/environment\/image: no such file/);
        const plain = fs.readFileSync(out);
        const given = ['--asset', 'protocol/examples/assets/studio.hdr', '--asset', file];
        const { stderr } = await run(program, ['render', document, '-o', out, ...size, ...given]);
        assert.equal(stderr, '');
        const served = await fetch(`${daemon.url}/v1/scenes/s/image.png?width=64&height=36`);
        assert.deepEqual(fs.readFileSync(out), Buffer.from(await served.arrayBuffer()));
        assert.notDeepEqual(fs.readFileSync(out), plain);
    });

    const bad = [
        ['nothing', '', 422, /neither PNG nor Radiance HDR/],
        ['a text', 'hello', 422, /neither PNG nor Radiance HDR/],
        ['a giant', '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9000 +X 9000\n', 422, /9000 x 9000 pixels are above 8192/],
        ['other numbers', '#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n', 422, /not FORMAT=32-bit_rle_rgbe/],
        ['too much', Buffer.alloc(33554433), 413, /above the maximum 33554432/],
    ];
    for (const [name, body, status, words] of bad) {
        test(`${name} is refused`, async () => {
            const answer = await send(daemon, body);
            assert.equal(answer.status, status);
            assert.match((await answer.json()).detail, words);
        });
    }

    test('an unknown file is not found', async () => {
        assert.equal((await fetch(`${daemon.url}/v1/assets/${'0'.repeat(64)}`)).status, 404);
        assert.equal((await fetch(`${daemon.url}/v1/assets/x`)).status, 404);
    });
});

test('without the token nothing is taken or given', async () => {
    const directory = makeDirectory();
    const file = path.join(directory, 'token');
    fs.writeFileSync(file, 'a-token-that-only-tests-know\n', { mode: 0o600 });
    const daemon = await startDaemon({ args: ['--token-file', file], ready: false });
    assert.equal((await send(daemon, sides)).status, 401);
    const headers = { authorization: 'Bearer a-token-that-only-tests-know' };
    assert.equal((await send(daemon, sides, headers)).status, 201);
    const at = `${daemon.url}/v1/assets/${digest(sides)}`;
    assert.equal((await fetch(at)).status, 401);
    const answer = await fetch(at, { headers });
    assert.equal(answer.status, 200);
    assert.match(answer.headers.get('cache-control'), /^private\b/, 'no shared cache keeps it for others');
    await daemon.stop();
    removeDirectory(directory);
});

/** Files of one pixel, each another one. */
const dot_file = (i) => Buffer.concat([Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n'), Buffer.from([i & 255, i >> 8, 7, 128])]);
const remove = (daemon, id) => fetch(`${daemon.url}/v1/assets/${id}`, { method: 'DELETE' });
const statusOf = async (daemon, id) => (await fetch(`${daemon.url}/v1/assets/${id}`)).status;

describe('removing', () => {
    let daemon;
    const data = makeDirectory();
    const [named, free, tried] = [1, 2, 3].map(dot_file);
    before(async () => {
        daemon = await startDaemon({ driver: 'null', data });
        for (const file of [named, free, tried]) {
            assert.equal((await send(daemon, file)).status, 201);
        }
        await ask(daemon, 'POST', '/v1/scenes?id=s', scene(digest(named)));
    });
    after(async () => {
        await daemon.stop();
        removeDirectory(data);
    });

    test('a file that no scene names', async () => {
        assert.equal((await remove(daemon, digest(free))).status, 204);
        assert.equal(await statusOf(daemon, digest(free)), 404);
        assert.equal((await remove(daemon, digest(free))).status, 404);
        assert.ok(!(await ask(daemon, 'GET', '/v1/assets')).assets.some(({ id }) => id === digest(free)));
    });

    test('not one that a scene names', async () => {
        const answer = await remove(daemon, digest(named));
        assert.equal(answer.status, 409);
        assert.match((await answer.json()).detail, /the scene s names this file/);
        assert.equal(await statusOf(daemon, digest(named)), 200);
    });

    test('not one of the examples', async () => {
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        const answer = await remove(daemon, assets[0].id);
        assert.equal(answer.status, 409);
        assert.match((await answer.json()).detail, /examples name this file/);
    });

    test('one that an edit names until it is undone', async () => {
        const live = await Live.open(daemon, 's');
        live.set('/environment/image', digest(tried));
        await live.next('applied', { edit: live.edit });
        assert.equal((await remove(daemon, digest(tried))).status, 409);
        assert.equal((await remove(daemon, digest(named))).status, 204);
        assert.equal((await send(daemon, named)).status, 201);
        const step = live.step('undo');
        await live.next('applied', { edit: step });
        assert.equal((await remove(daemon, digest(tried))).status, 204);
        await live.close();
    });

    test('for good: it is not there after a restart, and what is named is', async () => {
        await daemon.kill();
        daemon = await startDaemon({ driver: 'null', data });
        assert.deepEqual(await Promise.all([named, free, tried].map((file) => statusOf(daemon, digest(file)))), [200, 404, 404]);
        assert.equal((await remove(daemon, digest(named))).status, 409);
        await ask(daemon, 'DELETE', '/v1/scenes/s');
        assert.equal((await remove(daemon, digest(named))).status, 204);
    });
});

describe('as many as may be kept', () => {
    let daemon;
    let limit;
    let files;
    before(async () => {
        daemon = await startDaemon({ driver: 'null', ready: false });
        ({ value: limit } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'].limits.find(({ name }) => name === 'assets'));
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        files = Array.from({ length: limit - assets.length }, (_, i) => dot_file(i + 1));
        for (let i = 0; i < files.length; i += 8) {
            const answers = await Promise.all(files.slice(i, i + 8).map((file) => send(daemon, file)));
            answers.forEach(({ status }) => assert.equal(status, 201));
        }
    });
    after(() => daemon.stop());

    test('the oldest that no scene names makes room', async () => {
        const { assets } = await ask(daemon, 'GET', '/v1/assets');
        const sent = assets.map(({ id }) => id).filter((id) => files.some((file) => digest(file) === id));
        assert.equal(assets.length, limit);
        await ask(daemon, 'POST', '/v1/scenes?id=first', scene(sent[0]));
        const more = dot_file(60000);
        assert.equal((await send(daemon, more)).status, 201);
        const ids = (await ask(daemon, 'GET', '/v1/assets')).assets.map(({ id }) => id);
        assert.equal(ids.length, limit);
        assert.ok(ids.includes(sent[0]) && !ids.includes(sent[1]) && ids.includes(sent[2]) && ids.at(-1) === digest(more));
    });

    test('there is no room where scenes name all', async () => {
        const ids = (await ask(daemon, 'GET', '/v1/assets')).assets.map(({ id }) => id);
        for (let i = 0; i < ids.length; i += 8) {
            await Promise.all(ids.slice(i, i + 8).map((id, k) => ask(daemon, 'PUT', `/v1/scenes/n${i + k}`, scene(id))));
        }
        const answer = await send(daemon, dot_file(60001));
        assert.equal(answer.status, 507);
        const { place, detail } = await answer.json();
        assert.equal(place, '/v1/assets');
        assert.match(detail, new RegExp(`${limit} files of \\d+ bytes, .* the limits are ${limit} files and 1073741824 bytes`));
        await ask(daemon, 'DELETE', `/v1/scenes/n${ids.length - 1}`);
        assert.equal((await send(daemon, dot_file(60001))).status, 201);
        assert.equal(await statusOf(daemon, ids.at(-1)), 404);
    });
});
