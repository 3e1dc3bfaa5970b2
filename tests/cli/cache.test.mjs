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

// Code has a program of its own. Shaders are compiled on the GL roads alone.
const SCENE = {
    format: 'fieldcast/1',
    lights: [{ id: 'sun', type: 'directional' }],
    primitives: { blob: { params: [], code: 'float sdf(vec3 p) { return length(p) - 0.8 + 0.1 * sin(9.0 * p.x); }' } },
    root: { type: 'union', children: [{ type: 'field', params: { primitive: 'blob' } }, { type: 'plane' }] },
};

let folder;
let scene;
before(() => {
    folder = makeDirectory();
    scene = path.join(folder, 'scene.json');
    fs.writeFileSync(scene, JSON.stringify(SCENE));
});
after(() => removeDirectory(folder));

/** What the driver keeps, besides its list. */
const kept = (cache) =>
    fs
        .readdirSync(cache, { recursive: true, withFileTypes: true })
        .filter((entry) => entry.isFile() && entry.name !== 'index')
        .map((entry) => path.join(entry.parentPath ?? entry.path, entry.name))
        .sort();

function draw(env) {
    const out = path.join(folder, 'out.png');
    const args = ['render', scene, '-o', out, '--width', '64', '--height', '48', '--stage', 'compute'];
    const { status, stderr } = spawnSync(program, args, { env: { ...process.env, ...env } });
    assert.equal(status, 0, String(stderr));
    return decodePng(fs.readFileSync(out));
}

test('a picture is the same from a cold cache, from a warm one, and without the optimizer', () => {
    const cache = path.join(folder, 'cache');
    const asUsers = { FIELDCAST_CACHE: cache, GALLIVM_PERF: '' };
    const cold = draw(asUsers);
    const after = kept(cache);
    assert.ok(after.length > 0, 'nothing is kept');
    assert.deepEqual(draw(asUsers), cold);
    assert.deepEqual(kept(cache), after, 'the second time something is compiled again');
    assert.deepEqual(draw({ GALLIVM_PERF: 'nopt' }), cold);
});
