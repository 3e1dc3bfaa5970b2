// SPDX-License-Identifier: MIT
// How long people wait for something to look at on a cold and busy machine: the poster and the first
// own picture of examples, and the first picture with code that the editor starts with. No part of
// `make test`.
//
//   node tests/first.mjs PROGRAM LOOPS TRIES [EXAMPLE]...   beside LOOPS busy loops; TRIES of the code,
//                                                           each with nothing compiled before; by
//                                                           default every example, once
//
// A worker that is replaced, a notice of an error, or an example whose poster takes over a second is a
// failure: the exit status is 1.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { transformSync } from '../web/node_modules/esbuild/lib/main.js';
import { makeDirectory, removeDirectory } from './support/daemon.mjs';

const [program, loopCount, tries, ...wanted] = process.argv.slice(2);
process.env.FIELDCAST = program;
const { ask, counter, startDaemon } = await import('./support/daemon.mjs');
const { Live } = await import('./support/live.mjs');
const templates = fs.readFileSync(new URL('../web/src/model/templates.ts', import.meta.url), 'utf8');
const { NEW_NODE_CODE, NEW_PRIMITIVE, NEW_SHADER } = await import(
    `data:text/javascript,${encodeURIComponent(transformSync(templates, { loader: 'ts' }).code)}`
);

const loops = Array.from({ length: Number(loopCount) }, () => spawn('sh', ['-c', 'while :; do :; done'], { stdio: 'ignore' }));
process.on('exit', () => loops.forEach((loop) => loop.kill('SIGKILL')));
for (const signal of ['SIGINT', 'SIGTERM']) {
    process.on(signal, () => process.exit(130));
}

const VIEW = { width: 960, height: 540 };
const own = (root, more) => ({ format: 'fieldcast/1', lights: [{ id: 'sun', type: 'directional' }], root, ...more });
const SCENES = {
    'new primitive': own({ id: 'a', type: 'field', params: { primitive: 'own' } }, { primitives: { own: NEW_PRIMITIVE } }),
    'new function': own({ id: 'a', type: 'field', params: { code: NEW_NODE_CODE } }),
    'new shader': own(
        { id: 'a', type: 'sphere', material: 'own' },
        { shaders: { own: NEW_SHADER }, materials: { own: { shader: 'own' } } },
    ),
    'new volume': own({ id: 'a', type: 'sphere' }, { volumes: [{ id: 'v', type: 'box' }] }),
};

const POSTER_MS = 1000; // within which an example shows something

let failures = 0;
const ms = (from, to) => `${((to - from) / 1000).toFixed(1).padStart(7)} s`;

/** A daemon that has compiled nothing yet. */
async function coldDaemon() {
    const cache = makeDirectory();
    process.env.FIELDCAST_CACHE = process.env.MESA_SHADER_CACHE_DIR = cache;
    const daemon = await startDaemon();
    return { daemon, end: () => daemon.stop().then(() => removeDirectory(cache)) };
}

async function open(daemon, name, body, posterMs = Number.POSITIVE_INFINITY) {
    const start = Date.now();
    const { id } = await ask(daemon, 'POST', '/v1/scenes', body);
    const poster = await fetch(`${daemon.url}/v1/scenes/${id}/poster.jpg`);
    await poster.arrayBuffer();
    const shown = Date.now();
    const live = await Live.open(daemon, id);
    live.look(VIEW);
    const frame = await live.nextFrame();
    const restarts = await counter(daemon, 'worker_restarts_total');
    const told = live.messages.filter((m) => m.type === 'notice' && m.level === 'error');
    const late = posterMs < Number.POSITIVE_INFINITY && (poster.status !== 200 || shown - start > posterMs);
    const bad = restarts > 0 || told.length > 0 || late;
    failures += bad;
    console.log(
        `${bad ? 'FAIL' : 'ok  '} ${name.padEnd(24)} poster ${poster.status === 200 ? ms(start, shown) : '       none'}${late ? ' (late)' : ''}, ` +
            `own picture ${ms(start, frame.at)}${bad ? `, ${restarts} restarts, ${JSON.stringify(told)}` : ''}`,
    );
    await live.close();
    await ask(daemon, 'DELETE', `/v1/scenes/${id}`);
}

for (let i = 0; i < Number(tries); i += 1) {
    for (const [name, scene] of Object.entries(SCENES)) {
        const { daemon, end } = await coldDaemon();
        await open(daemon, `${name} ${i + 1}`, scene);
        await end();
    }
}
const { daemon, end } = await coldDaemon();
const { examples } = await ask(daemon, 'GET', '/v1/examples');
for (const { id } of examples.filter((one) => wanted.length === 0 || wanted.includes(one.id))) {
    await open(daemon, id, { from: `example:${id}` }, POSTER_MS);
}
await end();
console.log(`${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
