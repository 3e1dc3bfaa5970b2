// SPDX-License-Identifier: MIT
// Finding an equation takes a process of its own: nobody else waits for it, and it ends with the
// server. No clock decides.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { algebraOf, isAlgebra } from '../support/algebra.mjs';
import { ask, startDaemon, until } from '../support/daemon.mjs';

// Degree 18 with coefficients of some thousand bits: longer than all that this file does meanwhile.
const long = (i) => `0.${'739184620583'.repeat(2).slice(i)}7`;
const slow = {
    x: `s^3*t^3+${long(0)}*s-2t^2+${long(1)}s^2*t`,
    y: `2s^3*t^3+${long(2)}s^3-t+${long(3)}s*t-${long(4)}t^3*s^2`,
    z: `s^3*t^3-${long(5)}t^3+s^2+${long(6)}s*t^2`,
};
const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

test('others are answered while an equation is sought, and it ends with the server', async () => {
    const daemon = await startDaemon({ driver: 'null' });
    let answered = false;
    const question = fetch(`${daemon.url}/v1/implicitize`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify(slow),
    })
        .then((response) => response.status)
        .catch(() => 0)
        .finally(() => (answered = true));
    await until(() => algebraOf(daemon).length === 1, 'the process of the algebra');
    const [child] = algebraOf(daemon);
    await ask(daemon, 'POST', '/v1/scenes?id=other', ball);
    await ask(daemon, 'PATCH', '/v1/scenes/other', [{ op: 'set', at: '/nodes/ball/params/radius', value: 0.7 }]);
    assert.equal((await ask(daemon, 'GET', '/v1/scenes/other')).root.params.radius, 0.7);
    assert.equal(answered, false, 'it was answered before: take a longer equation');
    await daemon.stop();
    assert.ok([0, 503].includes(await question));
    assert.equal(isAlgebra(child), false);
});
