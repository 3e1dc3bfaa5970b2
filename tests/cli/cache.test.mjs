// SPDX-License-Identifier: MIT
// Compiled shaders are kept, and what is kept draws the same picture. All other suites share a cache
// and do without the optimizer of the software driver (run.mjs); here both are as users have them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { makeDirectory, program, removeDirectory } from '../support/daemon.mjs';
import { decodePng } from '../support/png.mjs';

const RICH = 'tests/golden/everything/rich/scene.json';

let folder;
before(() => (folder = makeDirectory()));
after(() => removeDirectory(folder));

function draw(env) {
    const out = path.join(folder, 'out.png');
    const args = ['render', RICH, '-o', out, '--width', '64', '--height', '48'];
    const { status, stderr } = spawnSync(program, args, { env: { ...process.env, ...env } });
    assert.equal(status, 0, String(stderr));
    return decodePng(fs.readFileSync(out));
}

test('a picture is the same from a cold cache, from a warm one, and without the optimizer', () => {
    const cache = path.join(folder, 'cache');
    const asUsers = { FIELDCAST_CACHE: cache, GALLIVM_PERF: '' };
    const cold = draw(asUsers);
    assert.ok(fs.readdirSync(cache).length > 0, 'nothing is kept');
    assert.deepEqual(draw(asUsers), cold);
    assert.deepEqual(draw({ GALLIVM_PERF: 'nopt' }), cold);
});
