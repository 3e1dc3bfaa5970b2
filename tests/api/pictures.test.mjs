// SPDX-License-Identifier: MIT
// What can be asked of a picture over REST: outputs, several at once, regions, levels, transparency,
// and what is refused.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';

import { OUTPUTS } from '../support/counts.mjs';
import { ask, startDaemon } from '../support/daemon.mjs';
import { readHdr } from '../support/hdr.mjs';
import { Live } from '../support/live.mjs';
import { readNpy } from '../support/npy.mjs';
import { decodePng } from '../support/png.mjs';
import { readZip } from '../support/zip.mjs';

const WIDTH = 64;
const HEIGHT = 48;
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: [0, 0.5, 4], target: [0, 0, 0] },
    lights: [{ type: 'directional', intensity: 3 }],
    materials: { mirror: { shader: 'standard', properties: { metallic: 1, roughness: 0 } } },
    root: {
        type: 'union',
        children: [
            { type: 'sphere', params: { radius: 0.8 } },
            { type: 'box', transform: { translation: [1, -0.3, 0.6] }, material: 'mirror' },
        ],
    },
};

let daemon;
let outputs;

const get = (query, format = 'png') =>
    fetch(`${daemon.url}/v1/scenes/s/image.${format}?width=${WIDTH}&height=${HEIGHT}${query}`);

async function picture(query, format = 'png', type = 'image/png') {
    const answer = await get(query, format);
    assert.equal(answer.status, 200, `${query}: ${await answer.clone().text()}`);
    assert.equal(answer.headers.get('content-type'), type);
    return Buffer.from(await answer.arrayBuffer());
}

async function refused(query, format, expected) {
    const answer = await get(query, format);
    const body = await answer.json();
    assert.equal(answer.status, 422, JSON.stringify(body));
    assert.equal(body.place, expected.place);
    assert.match(body.detail, expected.detail);
}

before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'PUT', '/v1/scenes/s', DOCUMENT);
    outputs = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'].outputs;
});
after(() => daemon.stop());

describe('outputs', () => {
    test('have the picture and the array that the schema says', async () => {
        assert.equal(outputs.length, OUTPUTS);
        for (const { name, channels, picture: shown } of outputs) {
            const array = readNpy(await picture(`&aov=${name}`, 'npy', 'application/x-npy'));
            assert.deepEqual(array.shape, channels > 1 ? [HEIGHT, WIDTH, channels] : [HEIGHT, WIDTH], name);
            assert.equal(array.type, name === 'id' ? '<u4' : '<f4');
            if (shown) {
                const png = decodePng(await picture(`&aov=${name}`));
                assert.deepEqual([png.width, png.height], [WIDTH, HEIGHT]);
                const [depth, parts] = name === 'depth' ? [16, 1] : [8, 3];
                assert.deepEqual([png.depth, png.channels], [depth, parts], name);
            } else {
                await refused(`&aov=${name}`, 'png', { place: 'aov', detail: /raw values alone/ });
            }
        }
    });

    test('hold what they are called', async () => {
        const at = (array, x, y) => {
            const parts = array.shape[2] ?? 1;
            return Array.from(array.values.subarray((y * WIDTH + x) * parts, (y * WIDTH + x + 1) * parts));
        };
        const read = async (name) => readNpy(await picture(`&aov=${name}`, 'npy', 'application/x-npy'));
        const middle = [WIDTH / 2, HEIGHT / 2];

        assert.deepEqual(at(await read('depth'), 0, 0), [Infinity]);
        const [depth] = at(await read('depth'), ...middle);
        assert.ok(Math.abs(depth - (Math.hypot(0.5, 4) - 0.8)) < 0.05, `${depth}`);
        assert.deepEqual(at(await read('id'), ...middle), [2]);
        assert.deepEqual(at(await read('id'), 0, 0), [0]);
        assert.ok(Math.abs(Math.hypot(...at(await read('normal'), ...middle)) - 1) < 1e-3);
        assert.ok(Math.abs(Math.hypot(...at(await read('position'), ...middle)) - 0.8) < 0.01);
        assert.ok(at(await read('steps'), ...middle)[0] >= 1);
    });

    test('come together in a ZIP, each as it is alone', async () => {
        for (const [format, type] of [
            ['png', 'image/png'],
            ['npy', 'application/x-npy'],
        ]) {
            const zip = await picture('&aov=normal,color,depth', format, 'application/zip');
            const members = readZip(zip);
            assert.deepEqual(
                members.map(({ name }) => name),
                [`color.${format}`, `depth.${format}`, `normal.${format}`],
            );
            for (const { name, method, bytes } of members) {
                assert.equal(method, 0, 'stored');
                assert.ok(bytes.equals(await picture(`&aov=${name.split('.')[0]}`, format, type)), name);
            }
            assert.ok(zip.equals(await picture('&aov=color,depth,normal', format, 'application/zip')));
        }
    });

    test('that are not there are refused', async () => {
        await refused('&aov=color,smell', 'png', { place: '?aov', detail: /"smell" is none of color,depth/ });
        await refused('&aov=color,color', 'png', { place: '?aov', detail: /color is named twice/ });
    });

    test('are shown live as they are sent', async () => {
        const { stages } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
        const live = await Live.open(daemon, 's');
        for (const { name } of outputs.filter(({ picture: shown }) => shown)) {
            const from = live.frames.length;
            live.look({ width: WIDTH, height: HEIGHT, aov: name });
            const frame = await live.nextFrame(({ lossless }) => lossless, from);
            assert.equal(frame.version, 3);
            assert.equal(frame.stagesUs.length, stages.length);
            for (const stage of ['shade', 'encode']) {
                assert.ok(frame.stagesUs[stages.findIndex((one) => one.name === stage)] > 0, stage);
            }
            assert.equal(frame.codec, 'png');
            const [shown, asked] = [decodePng(frame.payload), decodePng(await picture(`&aov=${name}`))];
            assert.ok(shown.pixels.equals(asked.pixels), name);
        }
        await live.close();
    });
});

describe('light', () => {
    const srgb = (c) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
    const level = (light) => 255 * srgb(Math.min(Math.max(2 * light, 0), 1));

    test('comes as a Radiance file, brighter than white, and is that of the picture', async () => {
        await ask(daemon, 'PUT', '/v1/scenes/lamp', {
            ...DOCUMENT,
            materials: {
                lamp: { shader: 'phong', properties: { emission: [9, 5, 2] } },
                mirror: DOCUMENT.materials.mirror,
            },
            render: { tone_map: 'none', exposure: 1 },
            root: { ...DOCUMENT.root, material: 'lamp' },
        });
        const read = async (format) => {
            const answer = await fetch(`${daemon.url}/v1/scenes/lamp/image.${format}?width=${WIDTH}&height=${HEIGHT}`);
            assert.equal(answer.status, 200);
            return [answer.headers.get('content-type'), Buffer.from(await answer.arrayBuffer())];
        };
        const [type, bytes] = await read('hdr');
        assert.equal(type, 'image/vnd.radiance');
        const { width, height, values, steps } = readHdr(bytes);
        const { pixels } = decodePng((await read('png'))[1]);
        const numbers = readNpy((await read('npy'))[1]).values;
        assert.deepEqual([width, height], [WIDTH, HEIGHT]);
        assert.ok(values.filter((light) => light > 4).length > 200);
        values.forEach((light, i) => {
            const step = steps[Math.floor(i / 3)];
            const number = numbers[4 * Math.floor(i / 3) + (i % 3)];
            assert.ok(Math.abs(light - number) <= 1.001 * step, `${i}: ${light}, not ${number}`);
            assert.ok(Math.abs(level(number) - pixels[i]) <= 1, `${i}: ${level(number)}, not ${pixels[i]}`);
            assert.ok(pixels[i] >= level(light - step) - 1 && pixels[i] <= level(light + step) + 1, `${i}`);
        });
        await ask(daemon, 'DELETE', '/v1/scenes/lamp');
    });

    test('is that of color alone', async () => {
        await refused('&aov=normal', 'hdr', { place: '?aov', detail: /normal is no light/ });
        await refused('&aov=color,depth', 'hdr', { place: '?aov', detail: /depth is no light/ });
    });
});

describe('a region', () => {
    test('is cut out of the whole', async () => {
        const whole = decodePng(await picture(''));
        const [x, y, width, height] = [13, 9, 31, 22];
        const answer = await get(`&region=${x},${y},${width},${height}`);
        assert.equal(answer.headers.get('fieldcast-size'), `${width}x${height}`);
        const part = decodePng(Buffer.from(await answer.arrayBuffer()));
        assert.deepEqual([part.width, part.height, part.channels], [width, height, whole.channels]);
        for (let row = 0; row < height; row += 1) {
            const from = ((y + row) * WIDTH + x) * whole.channels;
            const expected = whole.pixels.subarray(from, from + width * whole.channels);
            const stride = width * whole.channels;
            assert.ok(part.pixels.subarray(row * stride, (row + 1) * stride).equals(expected), `row ${row}`);
        }
    });

    test('lies inside of it', async () => {
        await refused('&region=60,0,5,5', 'png', { place: 'region', detail: /60,0,5,5 is not inside of 64 x 48/ });
        await refused('&region=3,3,0,5', 'png', { place: '?region', detail: /holds no pixel/ });
        await refused('&region=1,2,3', 'png', { place: '?region', detail: /x,y,width,height/ });
        await refused('&region=0,0,2.5,1', 'png', { place: '?region', detail: /2\.5 is not a whole number/ });
    });
});

describe('a level', () => {
    test('decides what is drawn, and the scene where none is said', async () => {
        const pictures = {};
        for (const level of ['draft', 'interactive', 'still', 'final']) {
            pictures[level] = decodePng(await picture(`&level=${level}`)).pixels;
        }
        assert.ok(decodePng(await picture('')).pixels.equals(pictures.still));
        assert.ok(!pictures.draft.equals(pictures.still));
        assert.ok(!pictures.interactive.equals(pictures.draft));
        assert.ok(!pictures.still.equals(pictures.final));
    });

    test('is one of four', () => refused('&level=best', 'png', { place: '?level', detail: /best/ }));
});

describe('a transparent picture', () => {
    test('has straight alpha', async () => {
        const soft = decodePng(await picture('&transparent=on'));
        assert.ok(soft.pixels.some((value, i) => i % 4 === 3 && value > 0 && value < 255));
        const clear = decodePng(await picture('&transparent=on&samples=1'));
        const solid = decodePng(await picture('&transparent=off&samples=1'));
        assert.deepEqual([clear.channels, solid.channels], [4, 3]);
        const alphas = clear.pixels.filter((_, i) => i % 4 === 3);
        assert.equal(alphas[0], 0);
        assert.equal(alphas[(HEIGHT / 2) * WIDTH + WIDTH / 2], 255);
        for (let i = 0; i < WIDTH * HEIGHT; i += 1) {
            const same = [0, 1, 2].every((c) => clear.pixels[4 * i + c] === solid.pixels[3 * i + c]);
            assert.ok(alphas[i] < 255 || same, `pixel ${i}`);
        }
    });

    test('keeps its alpha in motion', async () => {
        const render = { level: 'draft', transparent: true };
        await ask(daemon, 'PUT', '/v1/scenes/clear', { ...DOCUMENT, render });
        const live = await Live.open(daemon, 'clear');
        live.look({ width: WIDTH, height: HEIGHT });
        await live.nextFrame(({ lossless }) => lossless);
        for (const { codec, payload } of live.frames) {
            assert.equal(codec, 'png');
            assert.equal(decodePng(payload).channels, 4);
        }
        await live.close();
    });

    test('is no JPEG', async () => {
        await refused('&transparent=true', 'jpg', { place: 'format', detail: /png does/ });
        await picture('&transparent=false', 'jpg', 'image/jpeg');
    });
});

async function render(body) {
    const answer = await fetch(`${daemon.url}/v1/render`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify({ width: WIDTH, height: HEIGHT, ...body }),
    });
    assert.equal(answer.status, 200, await answer.clone().text());
    return Buffer.from(await answer.arrayBuffer());
}

describe('a camera', () => {
    const ortho = { type: 'orthographic', height: 2.5 };

    test('changes what it names of the one that the scene has, by every road', async () => {
        const camera = { fov: 20 };
        const whole = { ...DOCUMENT, camera: { ...DOCUMENT.camera, ...camera } };
        const wanted = await render({ scene: whole });
        assert.ok(!wanted.equals(await picture('')), 'the camera shows');
        assert.ok((await picture('&camera.fov=20')).equals(wanted), 'in a query');
        assert.ok((await render({ scene: 's', camera })).equals(wanted), 'with the id of a scene');
        assert.ok((await render({ scene: DOCUMENT, camera })).equals(wanted), 'with a document');
        const live = await Live.open(daemon, 's');
        live.look({ width: WIDTH, height: HEIGHT, camera });
        const { payload } = await live.nextFrame(({ lossless }) => lossless);
        assert.ok(decodePng(payload).pixels.equals(decodePng(wanted).pixels), 'in a view');
        await live.close();
    });

    test('of a view follows the rest of the document', async () => {
        const live = await Live.open(daemon, 's');
        live.look({ width: WIDTH, height: HEIGHT, camera: { fov: 20 } });
        await live.nextFrame(({ lossless }) => lossless);
        const position = [0.5, 1, 3];
        const patch = [{ op: 'set', at: '/camera/position', value: position }];
        const { revision } = await ask(daemon, 'PATCH', '/v1/scenes/s', patch);
        const frame = await live.nextFrame((one) => one.lossless && one.revision === revision);
        const camera = { ...DOCUMENT.camera, position, fov: 20 };
        const wanted = decodePng(await render({ scene: { ...DOCUMENT, camera } }));
        assert.ok(decodePng(frame.payload).pixels.equals(wanted.pixels));
        live.say({ type: 'pick', pick: 1, x: WIDTH / 2, y: HEIGHT / 2, seq: live.seq });
        const picked = await live.next('picked', { pick: 1 });
        const from = Math.hypot(...picked.position.map((x, i) => x - position[i]));
        assert.ok(Math.abs(picked.distance - from) < 1e-4, `${picked.distance} is ${from}`);
        await live.close();
        await ask(daemon, 'PUT', '/v1/scenes/s', DOCUMENT);
    });

    test('has a height that is not the picture\'s', async () => {
        const bytes = await picture('&camera.type=orthographic&camera.height=2.5');
        assert.deepEqual([decodePng(bytes).width, decodePng(bytes).height], [WIDTH, HEIGHT]);
        assert.ok(bytes.equals(await render({ scene: 's', camera: ortho })));
        assert.ok(!bytes.equals(await picture('&camera.type=orthographic&camera.height=5')));
    });
});

test('a switch is said by two words', async () => {
    const [on, off] = [await picture('&transparent=on'), await picture('&transparent=off')];
    assert.ok((await picture('&transparent=true')).equals(on));
    assert.ok((await picture('&transparent=false')).equals(off));
    assert.ok(!on.equals(off));
});

test('a document sent along is asked the same way', async () => {
    const send = async (more) => {
        const answer = await fetch(`${daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'content-type': 'application/json' },
            body: JSON.stringify({ scene: DOCUMENT, width: WIDTH, height: HEIGHT, ...more }),
        });
        return [answer.status, Buffer.from(await answer.arrayBuffer())];
    };
    const [status, bytes] = await send({
        aov: 'color,id',
        level: 'draft',
        region: [8, 8, 40, 30],
        transparent: true,
    });
    assert.equal(status, 200);
    const [color] = readZip(bytes);
    assert.ok(color.bytes.equals(await picture('&level=draft&region=8,8,40,30&transparent=on')));
    const [wrong, problem] = await send({ level: 'best' });
    assert.equal(wrong, 422);
    assert.equal(JSON.parse(problem).place, '/level');
});

test('what would be too long is refused before it is drawn', async () => {
    const answer = await fetch(`${daemon.url}/v1/scenes/s/image.npy?width=16384&height=8192`);
    const body = await answer.json();
    assert.equal(answer.status, 422);
    assert.equal(body.code, 'limit');
    assert.match(body.detail, /2147483648 bytes of values are above the maximum 268435456/);
});

test('the time of pictures is counted by stage', async () => {
    const text = await (await fetch(`${daemon.url}/metrics`)).text();
    const { stages } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
    for (const { name } of stages) {
        const [, seconds] = new RegExp(`^fieldcast_stage_seconds_total\\{stage="${name}"\\} (\\S+)$`, 'm').exec(text);
        assert.ok(Number(seconds) >= 0);
        assert.ok(Number(seconds) > 0 || !['shade', 'encode'].includes(name), name);
    }
});
