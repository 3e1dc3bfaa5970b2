// SPDX-License-Identifier: MIT
// A part of the hostile and the honest texts of code, drawn, beside eight busy loops: all are told what
// they should be, no worker ends, and a viewer of another scene goes on. Its pauses are told by what the
// daemon used of the processors meanwhile, so that no busy machine matters. bench/hostile_code runs all.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { HONEST, HOSTILE } from '../support/hostile_code.mjs';
import { hostileLoad } from '../support/hostile_load.mjs';

const EVERY = 9; // each so manieth text of a kind
const MOST_SECONDS = 2;
const ALONE_MS = 500;

const some = (texts) => texts.filter((_, i) => i % EVERY === 0);

test('hostile and honest code under load', async (t) => {
    const texts = [...some(HOSTILE), ...some(HONEST)];
    const { wrong, beside, restarts, dead } = await hostileLoad(texts, { whole: true, aloneMs: ALONE_MS });
    const longest = Math.max(...beside.map(({ cpu }) => cpu));
    t.diagnostic(`${texts.length} texts, ${beside.length} pictures of the other scene, ${longest} s of the processors between two`);
    assert.deepEqual(wrong, []);
    assert.equal(restarts, 0);
    assert.equal(dead, false);
    assert.ok(beside.length > texts.length / 2, 'the viewer sees pictures');
    assert.ok(longest <= MOST_SECONDS, `a pause of ${longest} s`);
});
