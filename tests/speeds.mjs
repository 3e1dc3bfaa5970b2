// SPDX-License-Identifier: MIT
// Measures what tests/bench/README.md tells, and writes it and its plots anew (make speeds).
// `node tests/speeds.mjs BUILD [FILE]`; FILE: numbers of an earlier run, instead of a new one.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { measure, measureScript } from './support/measure.mjs';
import { plotBars, plotLines } from './support/plot.mjs';

const build = path.resolve(process.argv[2]);
const kept = path.join(build, 'speeds.json');
const folder = path.join(path.dirname(new URL(import.meta.url).pathname), 'bench');

/** So many pictures are wanted for each of chromium's WebGL. */
const GOAL = 10;

function measureAll() {
    const program = path.join(build, 'fieldcast');
    const part = (name, ...more) => measure(name, build, program, ['bench', '--part', name, ...more]);
    return {
        machine: `${os.cpus()[0].model.trim()}, ${os.cpus().length} processors`,
        growth: part('growth', '--rounds', '1').growth,
        edits: measureScript('edits', build),
        orbit: measureScript('orbit', build),
        webgl: measureScript('webgl', build),
    };
}

function table(head, rows) {
    assert.ok(rows.flat().every((cell) => cell !== undefined), `a figure is missing under ${head}`);
    return [head, head.map(() => '---'), ...rows].map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}

function orbitTable({ runs }) {
    const rows = runs.map((run) => [
        run.scene,
        run.pictures_per_second,
        run.width,
        run.photon_ms.join(', '),
        run.still_ms ?? 'over a second',
    ]);
    return table(['example', 'pictures a second', 'width', 'ms to the eye, median and p95', 'ms to full size'], rows);
}

function editTable({ runs }) {
    const kinds = ['numeric', 'hide', 'structural', 'undo', 'isolate'];
    const rows = runs.map((run) => [
        run.nodes.toLocaleString('en'),
        run.numeric.picture_ms,
        ...kinds.map((kind) => `${run[kind].p50_ms}, ${run[kind].p95_ms}`),
    ]);
    return table(['nodes', 'another view', ...kinds], rows);
}

function webglTable({ runs }) {
    const rows = runs.map((run) => [run.scene, run.daemon_ms, run.chromium_ms, run.ratio]);
    return table(['example', 'fieldcast, ms', 'WebGL, ms', 'times as fast'], rows);
}

function growthPlot(growth) {
    const lines = growth.map(({ family, cpu_ms }) => ({
        name: family.replaceAll('_', ' '),
        points: Object.entries(cpu_ms).map(([shapes, ms]) => [Number(shapes), ms]),
    }));
    return plotLines({ title: 'Time of a picture by number of shapes', x: 'shapes', y: 'ms of processor time', lines });
}

function webglPlot({ runs }) {
    const bars = runs.map(({ scene, ratio }) => ({ name: scene, value: ratio, note: `${ratio} times` }));
    return plotBars({ title: 'Pictures a second against WebGL in chromium', bars });
}

const page = (all) => `# Speeds

\`make speeds\` measures these figures and writes this page. Machine: ${all.machine}; no GPU, so the engine draws.
Figures of GPUs stand in [renderer/README.md](../../renderer/README.md#compute-or-fragment-shaders).

## Orbiting in the editor
Debian's chromium on loopback, a picture of about 1280 x 720. While the view moves, size follows the measured cost of the view.

${orbitTable(all.orbit)}

## Edits
From the bytes of an edit to those of the first picture that shows it, at ${all.edits.width} x ${all.edits.height}: median and p95, in ms.

${editTable(all.edits)}

## Growth with the scene
Processor time of a picture of 640 x 360 with 10 to 80,000 shapes, by family of scenes.

![Time of a picture by number of shapes](growth.svg)

## Beside WebGL
The same scene as one plain shader (\`fieldcast shader --webgl\`) in Debian's chromium on the same machine, in turns. Goal: ${GOAL} times.

${webglTable(all.webgl)}

![Pictures a second against WebGL in chromium](webgl.svg)
`;

const all = process.argv[3] ? JSON.parse(fs.readFileSync(process.argv[3], 'utf8')) : measureAll();
fs.writeFileSync(kept, JSON.stringify(all, null, 2));
fs.writeFileSync(path.join(folder, 'README.md'), page(all));
fs.writeFileSync(path.join(folder, 'growth.svg'), growthPlot(all.growth));
fs.writeFileSync(path.join(folder, 'webgl.svg'), webglPlot(all.webgl));
