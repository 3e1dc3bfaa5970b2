// SPDX-License-Identifier: MIT
// Pictures a second of a scene from the daemon, whole pictures asked one by one as JPEG files, beside
// the same scene as one shader of WebGL 2 in chromium (`fieldcast shader --page`), in turns. Chromium
// gets the driver that draws this shader faster: llvmpipe. `first_ms`: until the page has compiled
// and drawn once. Prints one JSON object.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { ask, makeDirectory, program, removeDirectory, startDaemon } from '../support/daemon.mjs';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = require('playwright-core');

const SCENES = (process.env.WEBGL_SCENES ?? 'temple,snail,frog,portrait').split(',');
const WIDTH = Number(process.env.WEBGL_WIDTH ?? 640);
const HEIGHT = Math.round((WIDTH * 9) / 16);
const ROUNDS = 5;
const EACH = 4; // pictures of a round
const STEP = 0.05; // radians between two pictures
const FLAGS = ['--no-sandbox', '--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'];

const round = (x) => Math.round(x * 100) / 100;
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

const examples = new URL('../../protocol/examples/', import.meta.url).pathname;
const directory = makeDirectory();
const daemon = await startDaemon();
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: FLAGS, timeout: 0 });

/** The scene without what one shader cannot do, so that both draw the same. */
function plainScene(name) {
    const scene = JSON.parse(fs.readFileSync(path.join(examples, `${name}.json`), 'utf8'));
    scene.render = { ...scene.render, antialiasing: 'none' };
    return scene;
}

/** The camera's place after some steps around its target. */
function placeAfter(camera, steps) {
    const [x, y, z] = camera.position.map((value, i) => value - camera.target[i]);
    const [c, s] = [Math.cos(STEP * steps), Math.sin(STEP * steps)];
    return [c * x + s * z, y, c * z - s * x].map((value, i) => value + camera.target[i]);
}

async function openPage(scene) {
    const file = path.join(directory, 'scene.json');
    const page = await browser.newPage({ viewport: { width: 160, height: 90 } });

    fs.writeFileSync(file, JSON.stringify(scene));
    fs.writeFileSync(
        path.join(directory, 'page.html'),
        execFileSync(program, ['shader', '--page', '--level', 'interactive', file], { maxBuffer: 1 << 28 }),
    );
    page.setDefaultTimeout(0);
    const start = performance.now();
    await page.goto(`file://${directory}/page.html`);
    await page.waitForFunction(() => document.querySelector('p').textContent !== 'Compiling.');
    await page.evaluate(() => draw(16, 9));
    return { page, first: performance.now() - start };
}

const drawInPage = (page, from) =>
    page.evaluate(
        ([width, height, count, first, step]) => {
            const start = performance.now();
            for (let i = 0; i < count; i++) {
                orbit[0] = step * (first + i);
                draw(width, height);
            }
            return (performance.now() - start) / count;
        },
        [WIDTH, HEIGHT, EACH, from, STEP],
    );

async function drawByDaemon(id, camera, from) {
    const start = performance.now();
    for (let i = 0; i < EACH; i += 1) {
        const body = {
            scene: id,
            width: WIDTH,
            height: HEIGHT,
            level: 'interactive',
            format: 'jpeg',
            camera: { position: placeAfter(camera, from + i) },
        };
        const answer = await fetch(`${daemon.url}/v1/render`, {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify(body),
        });
        if ((await answer.arrayBuffer()).byteLength === 0 || !answer.ok) {
            throw new Error(`${id}: ${answer.status}`);
        }
    }
    return (performance.now() - start) / EACH;
}

async function compare(name) {
    const scene = plainScene(name);
    await ask(daemon, 'PUT', `/v1/scenes/${name}`, scene);
    const { page, first } = await openPage(scene);
    const times = { daemon: [], chromium: [] };

    await drawByDaemon(name, scene.camera, -EACH);
    await drawInPage(page, -EACH);
    for (let i = 0; i < ROUNDS; i += 1) {
        times.daemon.push(await drawByDaemon(name, scene.camera, i * EACH));
        times.chromium.push(await drawInPage(page, i * EACH));
    }
    await page.close();
    return {
        scene: name,
        daemon_ms: round(median(times.daemon)),
        chromium_ms: round(median(times.chromium)),
        ratio: round(median(times.chromium.map((ms, i) => ms / times.daemon[i]))),
        first_ms: Math.round(first),
    };
}

try {
    const runs = [];
    for (const name of SCENES) {
        runs.push(await compare(name));
    }
    console.log(JSON.stringify({ width: WIDTH, height: HEIGHT, runs }));
} finally {
    await browser.close();
    await daemon.stop();
    removeDirectory(directory);
}
