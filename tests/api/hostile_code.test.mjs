// SPDX-License-Identifier: MIT
// Texts of code by families (support/hostile_code.mjs), each sent as a live edit by one author: what
// shall be refused is refused with its place, all else is accepted, and what another viewer sees goes
// on after each. Nothing is drawn here: what the driver gets is left to api/hostile and to kill/.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { ask, counter, startDaemon, until } from '../support/daemon.mjs';
import { HONEST, HOSTILE, isShade } from '../support/hostile_code.mjs';
import { Live } from '../support/live.mjs';

const SHAPE = '/primitives/blob/code';
const SHADE = '/shaders/paint/code';
const GOOD_SHAPE = 'float sdf(vec3 p) { return length(p) - radius; }';
const GOOD_SHADE = 'vec3 shade(FragmentProperties properties) { return vec3(1.0); }';
const DOCUMENT = {
    format: 'fieldcast/1',
    primitives: { blob: { params: [{ name: 'radius', type: 'float', default: 0.5 }], code: GOOD_SHAPE } },
    shaders: { paint: { code: GOOD_SHADE } },
    materials: { red: { shader: 'paint' } },
    root: { id: 'b', type: 'field', material: 'red', params: { primitive: 'blob' } },
};

let daemon;
let author;
let viewer;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
    await ask(daemon, 'POST', '/v1/scenes?id=hostile', DOCUMENT);
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    author = await Live.open(daemon, 'hostile');
    author.look();
    await author.nextFrame();
    viewer = await Live.open(daemon, 'other');
    viewer.look();
    await viewer.nextFrame();
});
after(async () => {
    await Promise.all([author?.close(), viewer?.close()]);
    await daemon?.stop();
});

/** What the author is told of a text: it cannot be drawn, or the edit itself is refused; or it is shown. */
async function verdictOf(place, code) {
    const from = author.messages.length;
    const frames = author.frames.length;
    const edit = author.set(place, code);
    const told = (type, more) => author.messages.slice(from).find((m) => m.type === type && Object.entries(more).every(([key, value]) => m[key] === value));
    return until(() => {
        const rejected = told('rejected', { edit });
        const error = told('notice', { level: 'error' });
        const applied = told('applied', { edit });
        const shown = applied && author.frames.slice(frames).some((frame) => frame.revision >= applied.revision && !frame.stale);
        return (rejected && { refused: rejected }) || (error && { refused: error }) || (shown && { shown });
    }, 'a verdict');
}

async function goBack(place) {
    const from = author.messages.length;
    author.set(place, place === SHAPE ? GOOD_SHAPE : GOOD_SHADE);
    await author.next('notice', { level: 'info', code: 'compiled', place }, from);
}

async function isServed(i) {
    const seq = viewer.look({ camera: { position: [Math.sin(i), 1, 5] } });
    await viewer.nextFrame((frame) => frame.seq >= seq);
}

const families = (texts) => texts.reduce((map, one) => map.set(one.family, [...(map.get(one.family) ?? []), one]), new Map());

let count = 0;
for (const [kind, texts] of [['hostile', HOSTILE], ['honest', HONEST]]) {
    describe(`${kind} code`, () => {
        for (const [family, list] of families(texts)) {
            test(`${family}: ${list.length} texts`, async () => {
                for (const { name, code, verdict } of list) {
                    const place = isShade(code) ? SHADE : SHAPE;
                    const { refused } = await verdictOf(place, code);
                    assert.equal(refused ? 'refused' : 'drawn', verdict, `${name}: ${refused?.message}\n${code.slice(0, 500)}`);
                    if (refused?.code === 'compile') {
                        assert.equal(refused.place, place, name);
                        assert.ok(refused.line > 0 && refused.column > 0, `${name}: ${JSON.stringify(refused)}`);
                        await goBack(place);
                    } else if (refused) { // as JSON or as a value of a document
                        assert.ok(['limit', 'invalid', 'syntax'].includes(refused.code) && refused.place, `${name}: ${JSON.stringify(refused)}`);
                    }
                    await isServed((count += 1));
                }
            });
        }
    });
}

test('none was the end of a process', async () => {
    assert.deepEqual([HOSTILE.length, HONEST.length], [307, 65]);
    assert.equal(count, HOSTILE.length + HONEST.length);
    assert.equal(await counter(daemon, 'worker_restarts_total'), 0);
    assert.equal(author.closed || viewer.closed, false);
});
