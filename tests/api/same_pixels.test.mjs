// SPDX-License-Identifier: MIT
// One road to pixels: every example, and a scene with everything in it, drawn by the command line, by
// POST /v1/render, as image.png of a scene and as the last streamed frame gives the same pixels.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { promisify } from 'node:util';

import { EXAMPLES } from '../support/counts.mjs';
import { ask, makeDirectory, program, removeDirectory, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import { decodePng } from '../support/png.mjs';

const run = promisify(execFile);
const WIDTH = 48;
const HEIGHT = 27;
const folder = 'protocol/examples';
const examples = fs.readdirSync(folder).filter((name) => name.endsWith('.json'));
const rich = 'tests/golden/everything/rich/scene.json';
const files = [rich, ...examples.map((name) => path.join(folder, name))];

async function pictureOf(answer) {
    assert.equal(answer.status, 200, await answer.clone().text());
    assert.equal(answer.headers.get('fieldcast-size'), `${WIDTH}x${HEIGHT}`);
    return decodePng(Buffer.from(await answer.arrayBuffer()));
}

describe('every scene is the same picture by every road', () => {
    let daemon;
    let directory;
    before(async () => {
        directory = makeDirectory();
        daemon = await startDaemon();
    });
    after(async () => {
        await daemon.stop();
        removeDirectory(directory);
    });

    test('there are examples', () => assert.equal(examples.length, EXAMPLES));

    for (const file of files) {
        test(file, async () => {
            const out = path.join(directory, 'picture.png');
            const size = ['--width', String(WIDTH), '--height', String(HEIGHT)];
            await run(program, ['render', file, '-o', out, ...size]);
            const drawn = decodePng(fs.readFileSync(out));
            assert.ok(new Set(drawn.pixels).size > 16, 'a picture, not one colour');

            const scene = JSON.parse(fs.readFileSync(file, 'utf8'));
            const posted = await fetch(`${daemon.url}/v1/render`, {
                method: 'POST',
                headers: { 'content-type': 'application/json' },
                body: JSON.stringify({ scene, width: WIDTH, height: HEIGHT, format: 'png' }),
            });
            assert.deepEqual(await pictureOf(posted), drawn, 'POST /v1/render');

            const from = { from: `example:${path.parse(file).name}` };
            const { id } = await ask(daemon, 'POST', '/v1/scenes', file === rich ? scene : from);
            const image = `${daemon.url}/v1/scenes/${id}/image.png?width=${WIDTH}&height=${HEIGHT}`;
            assert.deepEqual(await pictureOf(await fetch(image)), drawn, 'image.png');

            const live = await Live.open(daemon, id);
            live.look({ width: WIDTH, height: HEIGHT });
            const last = await until(() => live.frames.find((frame) => frame.lossless), 'a lossless frame');
            assert.deepEqual(decodePng(last.payload), drawn, 'the last frame');
            await live.close();
        });
    }
});
