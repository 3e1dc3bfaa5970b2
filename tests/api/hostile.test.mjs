// SPDX-License-Identifier: MIT
// Code that is broken or meant to do harm, sent live by one author: each time it is refused before anything is
// drawn with it, the author is told what and where, and the pictures of another scene keep coming.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ask, counter, sleep, startDaemon } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const SHAPE = '/primitives/blob/code';
const SHADE = '/shaders/paint/code';
const GOOD_SHAPE = 'float sdf(vec3 p) {\n    return length(p) - radius;\n}';
const GOOD_SHADE = 'vec3 shade(FragmentProperties properties) {\n    return colour;\n}';

const DOCUMENT = {
    format: 'fieldcast/1',
    lights: [{ id: 'sun', type: 'directional' }],
    primitives: {
        blob: { params: [{ name: 'radius', type: 'float', default: 0.5 }], code: GOOD_SHAPE },
    },
    shaders: {
        paint: { properties: [{ name: 'colour', type: 'color', default: [1, 0, 0] }], code: GOOD_SHADE },
    },
    materials: { red: { shader: 'paint' } },
    root: { id: 'b', type: 'field', material: 'red', params: { primitive: 'blob' } },
};

const sdf = (...lines) => ['float sdf(vec3 p) {', ...lines, '}'].join('\n');
const shade = (...lines) => ['vec3 shade(FragmentProperties properties) {', ...lines, '}'].join('\n');
const doubling = ['float f0(float x) { return sin(x); }'];
for (let i = 1; i <= 13; i += 1) {
    doubling.push(`float f${i}(float x) { return f${i - 1}(x) + f${i - 1}(x + 1.0); }`);
}

// What is wrong, where it is put, the code, the line that is named, words of the message.
const CASES = [
    ['a brace is missing', SHAPE, 'float sdf(vec3 p) {\n    return length(p);\n', 3, /expected }/],
    ['a semicolon is missing', SHAPE, sdf('    float d = length(p)', '    return d;'), 3, /expected ;/],
    ['a wrong type', SHAPE, sdf('    float d = p;', '    return d;'), 2, /vec3/],
    ['a wrong type of result', SHADE, shade('    return properties;'), 2, /value returned .* not vec3/],
    ['an unknown name', SHAPE, sdf('    return length(q) - radius;'), 2, /no variable q/],
    ['an unknown function', SHADE, shade('    return paint_it(colour);'), 2, /no function paint_it/],
    ['no function', SHAPE, 'float distance_to(vec3 p, float x) {\n    return 1.0;\n}', 1, /no function float sdf/],
    ['recursion', SHAPE, 'float f(float x) {\n    return f(x);\n}\n' + sdf('    return f(p.x);'), 2, /calls itself: f/],
    ['an endless loop', SHAPE, sdf('    while (true) {}', '    return 1.0;'), 2, /while is not known/],
    ['an endless for', SHAPE, sdf('    for (;;) {}', '    return 1.0;'), 2, /the loop has no bound/],
    ['a loop of two milliards', SHAPE, sdf('    float d = 0.0;', '    for (int i = 0; i < 2000000000; i++) d += p.x;', '    return d;'), 3, /code_trips/],
    ['nested loops', SHAPE, sdf('    float d = 0.0;', ...[...'ijklmn'].map((v) => `    for (int ${v} = 0; ${v} < 64; ${v}++)`), '    d += 0.01;', '    return d;'), 7, /code_trips/],
    ['a huge array', SHAPE, sdf('    float a[65536];', '    return a[int(p.x)];'), 2, /code_array/],
    ['a very long expression', SHAPE, sdf(`    return p.x${'+1'.repeat(7000)};`), 2, /code_depth/],
    ['a chain of calls that doubles', SHAPE, `${doubling.join('\n')}\n${sdf('    return f13(p.x);')}`, 8, /code_size/],
    ['a thousand parentheses', SHAPE, sdf(`    return ${'('.repeat(1000)}1.0${')'.repeat(1000)};`), 2, /code_depth/],
    ['a division by zero', SHAPE, sdf('    float zero = 0.0;', '    return length(p) / zero;'), 3, /divides by 0/],
    ['no number', SHADE, shade('    float zero = properties.ray_distance * 0.0;', '    return vec3(zero / zero);'), 3, /divides by 0/],
    ['the preprocessor', SHAPE, `#define x 1\n${GOOD_SHAPE}`, 1, /preprocessor/],
    ['an escape from the function', SHAPE, `${GOOD_SHAPE}\n} void main() { discard;`, 4, /expected a type, not }/],
    ['a name of the driver', SHAPE, sdf('    gl_FragDepth = 1.0;', '    return 1.0;'), 2, /gl_FragDepth/],
    ['a buffer of its own', SHADE, `layout(binding = 0) buffer B { float b[]; };\n${GOOD_SHADE}`, 1, /layout is not known/],
    ['a character of no alphabet', SHADE, shade('    return colour § 2;'), 2, /character/],
];

let daemon;
let author;
let viewer;
let dragging = true;
let dragged;
before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'POST', '/v1/scenes?id=hostile', DOCUMENT);
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    author = await Live.open(daemon, 'hostile');
    author.look();
    await author.nextFrame((frame) => frame.lossless);
    viewer = await Live.open(daemon, 'other');
    dragged = (async () => {
        for (let i = 0; dragging; i += 1) {
            viewer.look({ camera: { position: [Math.sin(i / 20), 1, 5] } });
            await sleep(30);
        }
    })();
    await viewer.nextFrame();
});
after(async () => {
    dragging = false;
    await dragged;
    await Promise.all([author?.close(), viewer?.close()]);
    await daemon?.stop();
});

for (const [what, place, code, line, message] of CASES) {
    test(what, async (t) => {
        const from = author.messages.length;
        const seen = viewer.frames.length;
        const sent = Date.now();
        author.set(place, code);
        const notice = await author.next('notice', { level: 'error' }, from);
        t.diagnostic(`${notice.at - sent} ms: ${notice.line}:${notice.column}: ${notice.message}`);
        assert.deepEqual([notice.code, notice.place, notice.line], ['compile', place, line]);
        assert.ok(notice.column > 0);
        assert.match(notice.message, message);
        // The text is kept, the picture is the last good one, and others see theirs.
        await viewer.nextFrame(() => true, seen);
        author.look({ width: 60 + (author.seq % 9) });
        const frames = author.frames.length;
        const frame = await author.nextFrame(() => true, frames);
        assert.equal(frame.stale, true);
        author.set(place, place === SHAPE ? GOOD_SHAPE : GOOD_SHADE);
        await author.next('notice', { level: 'info', code: 'compiled', place }, from);
    });
}

test('afterwards everything is as before, by the same render process', async (t) => {
    const { revision } = await author.next('applied', { edit: author.edit });
    await author.nextFrame((frame) => frame.lossless && frame.revision === revision);
    assert.equal(CASES.length, 23);
    assert.equal(author.closed || viewer.closed, false);
    assert.equal(await counter(daemon, 'worker_restarts_total'), 0);
    t.diagnostic(`${viewer.frames.length} frames of the other scene`);
});
