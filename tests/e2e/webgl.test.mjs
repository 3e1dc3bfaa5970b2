// SPDX-License-Identifier: MIT
// A scene as one shader of WebGL 2, in a browser: it compiles, and draws what the engine draws.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { makeDirectory, program, removeDirectory } from '../support/daemon.mjs';
import { EXAMPLES, GOLDEN } from '../support/counts.mjs';
import { decodePng } from '../support/png.mjs';
import { SHELL } from './stage.mjs';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = require('playwright-core');

const FLAGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const WIDTH = 160;
const HEIGHT = 90;
const root = new URL('../../', import.meta.url).pathname;
const examples = path.join(root, 'protocol/examples');
const golden = path.join(root, 'tests/golden');

let browser;
let directory;

before(async () => {
    directory = makeDirectory();
    browser = await chromium.launch({ executablePath: SHELL, args: FLAGS, timeout: 0 });
});

after(async () => {
    await browser.close();
    removeDirectory(directory);
});

const run = (...args) =>
    execFileSync(program, args, { maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });

/** Scene documents in and below a folder. */
function documentsOf(folder) {
    return fs
        .readdirSync(folder, { recursive: true })
        .filter((name) => name.endsWith('.json'))
        .map((name) => path.join(folder, name))
        .filter((file) => JSON.parse(fs.readFileSync(file, 'utf8')).format === 'fieldcast/1');
}

async function emptyPage() {
    const page = await browser.newPage({ viewport: { width: WIDTH, height: HEIGHT } });
    page.setDefaultTimeout(0);
    return page;
}

/** Why the browser refuses a shader; null: it does not. */
const refusal = (page, text) =>
    page.evaluate((source) => {
        window.gl ??= document.createElement('canvas').getContext('webgl2');
        const shader = gl.createShader(gl.FRAGMENT_SHADER);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        const log = gl.getShaderParameter(shader, gl.COMPILE_STATUS) ? null : gl.getShaderInfoLog(shader);
        gl.deleteShader(shader);
        return log;
    }, text);

/** A shader without its numbers: those that differ in these alone are the same to a compiler. */
const shapeOf = (text) => text.replace(/\b\d[\d.]*(e[-+]?\d+)?/g, '0');

const hasPatches = (file) => fs.readFileSync(file, 'utf8').includes('"type": "parametric"');

for (const [folder, count] of [[examples, EXAMPLES], [golden, GOLDEN]]) {
    test(`a browser accepts the shader of each scene in ${path.basename(folder)}`, async () => {
        const page = await emptyPage();
        const files = documentsOf(folder).filter((file) => !file.includes('refused'));

        assert.equal(files.length, count);
        const drawn = files.filter((file) => !hasPatches(file));
        for (const file of files.filter(hasPatches)) {
            assert.throws(() => run('shader', '--webgl', file), /are too many numbers for the text of a shader/);
        }
        const texts = new Map(drawn.map((file) => [file, run('shader', '--webgl', file).toString()]));
        const distinct = new Map([...texts].map(([file, text]) => [shapeOf(text), file]));
        for (const file of distinct.values()) {
            const log = await refusal(page, texts.get(file));

            assert.equal(log, null, `${path.relative(root, file)}: ${log}`);
        }
        assert.match(await refusal(page, '#version 300 es\nvoid main() { x = 1; }'), /undeclared/);
        await page.close();
    });
}

/** A copy of a scene without what a single pass cannot do: edges that are blended, and a picture. */
function plainCopy(file, change) {
    const scene = JSON.parse(fs.readFileSync(file, 'utf8'));
    const copy = path.join(directory, path.basename(file));

    scene.render = { ...scene.render, antialiasing: 'none' };
    if (scene.environment?.type === 'image') {
        scene.environment = { intensity: scene.environment.intensity };
    }
    change?.(scene);
    fs.writeFileSync(copy, JSON.stringify(scene));
    return copy;
}

/** The pixels of the page that `shader --page` writes, from the top left. */
async function drawnByPage(file, orbit) {
    const html = path.join(directory, 'page.html');
    const page = await emptyPage();

    fs.writeFileSync(html, run('shader', '--page', '--level', 'interactive', file));
    await page.goto(`file://${html}`);
    await page.waitForFunction(() => document.querySelector('p').textContent !== 'Compiling.');
    assert.equal(await page.textContent('p'), '');
    const pixels = await page.evaluate(
        ([width, height, view]) => {
            orbit.splice(0, 3, ...view);
            draw(width, height);
            const rows = new Uint8Array(4 * width * height);
            gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rows);
            return Array.from({ length: height }, (_, y) => [
                ...rows.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)),
            ]).flat();
        },
        [WIDTH, HEIGHT, orbit],
    );
    await page.close();
    return pixels;
}

function drawnByEngine(file) {
    const out = path.join(directory, 'engine.png');
    const size = ['--width', String(WIDTH), '--height', String(HEIGHT)];
    const engine = ['--device', 'none', '--stage', 'engine', '--level', 'interactive'];

    run('render', ...engine, ...size, '-o', out, file);
    return decodePng(fs.readFileSync(out));
}

/** The part of the pixels with a channel that differs by more than 2. */
function difference(pixels, image) {
    const channels = image.pixels.length / (WIDTH * HEIGHT);
    let count = 0;

    for (let i = 0; i < WIDTH * HEIGHT; i++) {
        const off = [0, 1, 2].some(
            (k) => Math.abs(pixels[4 * i + k] - image.pixels[channels * i + k]) > 2,
        );
        count += off ? 1 : 0;
    }
    return count / (WIDTH * HEIGHT);
}

const SCENES = [
    'protocol/examples/first-steps',
    'protocol/examples/csg',
    'protocol/examples/glass',
    'protocol/examples/own-code',
    'protocol/examples/surface-kummer',
    'tests/golden/volumes/noise/scene',
];
for (const name of SCENES) {
    test(`${name} looks the same as the engine's picture`, async () => {
        const file = plainCopy(path.join(root, `${name}.json`));
        const off = difference(await drawnByPage(file, [0, 0, 0]), drawnByEngine(file));
        assert.ok(off < 0.005, `${off} of the pixels differ`);
    });
}

test('the page orbits as the camera of a document does', async () => {
    const angle = 0.6;
    const source = path.join(root, 'protocol/examples/csg.json');
    const turned = plainCopy(source, (scene) => {
        const [x, y, z] = scene.camera.position.map((value, i) => value - scene.camera.target[i]);
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const place = [c * x + s * z, y, c * z - s * x];
        scene.camera.position = place.map((value, i) => value + scene.camera.target[i]);
    });
    const expected = drawnByEngine(turned);
    const file = plainCopy(source);

    assert.ok(difference(await drawnByPage(file, [angle, 0, 0]), expected) < 0.005);
    assert.ok(difference(await drawnByPage(file, [0, 0, 0]), expected) > 0.1);
});
