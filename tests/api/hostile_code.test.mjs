// SPDX-License-Identifier: MIT
// Texts of code by families (support/hostile_code.mjs), each sent as a live edit by one author: what
// shall be refused is refused with its place, all else is accepted, and what another viewer sees goes
// on after each. Nothing is drawn here: what the driver gets is left to api/hostile and to kill/.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { ask, counter, startDaemon } from '../support/daemon.mjs';
import { goBack, openAuthor, placeOf, verdictOf } from '../support/hostile_author.mjs';
import { HONEST, HOSTILE } from '../support/hostile_code.mjs';
import { Live } from '../support/live.mjs';

let daemon;
let author;
let viewer;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    author = await openAuthor(daemon, 'hostile');
    viewer = await Live.open(daemon, 'other');
    viewer.look();
    await viewer.nextFrame();
});
after(async () => {
    await Promise.all([author?.close(), viewer?.close()]);
    await daemon?.stop();
});

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
                    const { refused } = await verdictOf(author, code);
                    assert.equal(refused ? 'refused' : 'drawn', verdict, `${name}: ${refused?.message}\n${code.slice(0, 500)}`);
                    if (refused?.code === 'compile') {
                        assert.equal(refused.place, placeOf(code), name);
                        assert.ok(refused.line > 0 && refused.column > 0, `${name}: ${JSON.stringify(refused)}`);
                        await goBack(author, refused.place);
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
