// SPDX-License-Identifier: MIT
// How much of an implicit surface its patch covers, against areas in closed form; and the patch alone,
// ray by ray, against the half sphere that it is.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { readNpy } from '../support/npy.mjs';

const program = process.env.FIELDCAST ?? 'build/release/fieldcast';
const run = (args, input) => execFileSync(program, args, { input, maxBuffer: 1 << 26 });
const implicitize = (texts, ...options) => JSON.parse(run(['implicitize', ...options, '--', ...texts]));

const TURN = '0,6.2831853';
const up = '1.5707963';
const sphere = ['cos(u)*cos(v)', 'sin(u)*cos(v)', 'sin(v)'];
const torus = ['(2+cos(u))*cos(v)', '(2+cos(u))*sin(v)', 'sin(u)'];
const rational = ['2s/(1+s^2+t^2)', '2t/(1+s^2+t^2)', '(1-s^2-t^2)/(1+s^2+t^2)'];

/** The part of the sphere that a square of the plane becomes: the mean of 4 / (1 + s^2 + t^2)^2, by the area. */
function stereographic(side) {
    const steps = 400;
    let sum = 0;
    for (let i = 0; i < steps; i++) {
        for (let j = 0; j < steps; j++) {
            const [s, t] = [i, j].map((k) => side * ((2 * k + 1) / steps - 1));
            sum += (4 / (1 + s * s + t * t) ** 2) * (2 * side / steps) ** 2;
        }
    }
    return sum / (4 * Math.PI);
}

const PARTS = [
    ['half of a sphere', sphere, ['-u', TURN, '-v', `0,${up}`], 1 / 2],
    ['an eighth of a sphere', sphere, ['-u', `0,${up}`, '-v', `0,${up}`, '--size', '2.1,2.1,2.1'], 1 / 8],
    ['the half of a ring that is outside', torus, ['-u', `-${up},${up}`, '-v', TURN], (Math.PI + 1) / (2 * Math.PI)],
    ['a quarter of a square', ['s', 't', '0*s+1'], ['-s', '0,1', '-t', '0,1', '--size', '2,2,3'], 1 / 4],
    ['a part of a pipe', ['cos(s)', 'sin(s)', 't'], ['-s', TURN, '-t', '-0.5,1', '--size', '2.1,2.1,4'], 3 / 8],
    ['a square by fractions', rational, ['-s', '-1,1', '-t', '-1,1', '--size', '2.1,2.1,2.1'], stereographic(1)],
];
for (const [name, texts, options, wanted] of PARTS) {
    test(`covered: ${name}`, () => {
        const { points, covered, share, text } = implicitize(texts, ...options).coverage;
        assert.equal(points, 2000);
        assert.equal(share, covered / points);
        // Three times the deviation of 2,000 independent points.
        const most = 3 * Math.sqrt((wanted * (1 - wanted)) / points);
        assert.ok(Math.abs(share - wanted) <= most, `${share} instead of ${wanted.toFixed(4)}`);
        assert.equal(text, `the patch covers ${(100 * share).toFixed(0)} % of the implicit surface within the clip`);
    });
}

const d = '(5-3*cos(u)*cos(v))';
const klein = '(2+cos(t/2)*sin(s)-sin(t/2)*sin(2*s))';
const CLOSED = [
    ['sphere', sphere, ['-u', TURN, '-v', `-${up},${up}`]],
    ['torus', torus, ['-u', TURN, '-v', TURN]],
    ['cross-cap', ['cos(u)*sin(2v)', 'sin(u)*sin(2v)', 'cos(v)^2-cos(u)^2*sin(v)^2'], ['-u', TURN, '-v', TURN]],
    ['Dupin cyclide', [`(3-5cos(u)*cos(v)+16cos(u))/${d}`, `4sin(u)*(5-cos(v))/${d}`, `4sin(v)*(3cos(u)-1)/${d}`], ['-u', TURN, '-v', TURN]],
    ['Klein bottle', [`${klein}*cos(t)`, `${klein}*sin(t)`, 'sin(t/2)*sin(s)+cos(t/2)*sin(2s)'], ['-s', TURN, '-t', TURN]],
];
for (const [name, texts, options] of CLOSED) {
    test(`covered: all of a ${name}`, () => {
        const { points, covered, text } = implicitize(texts, ...options).coverage;
        assert.deepEqual([points, covered], [2000, 2000]);
        assert.equal(text, 'the patch covers 100 % of the implicit surface within the clip');
    });
}

test('no line meets a surface outside of the clip, and without ranges nothing is told', () => {
    const { coverage } = implicitize(['s', 't', '0*s+5'], '-s', '0,1', '-t', '0,1', '--size', '2,2,2');
    assert.deepEqual(coverage, { points: 0, covered: 0, text: 'no line meets the implicit surface within the clip', size: [2, 2, 2] });
    const { coverage: none, trimmed } = implicitize(['s', 't', 's*t']);
    assert.deepEqual([none, trimmed], [undefined, undefined]);
});

const REFUSED = [
    [['-s', '0,1'], /^the ranges of 1 letters; a surface has two parameters/],
    [['-s', '1,0', '-t', '0,1'], /^s: the first number is not below the second/],
    [['-s', '0,1', '-u', '0,1'], /^t: has no range, but another letter has/],
    [['-s', '0', '-t', '0,1'], /-s: needs two numbers, as -1,1/],
];
for (const [options, why] of REFUSED) {
    test(`refused: ${options.join(' ')}`, () => {
        const { status, stderr } = spawnSync(program, ['implicitize', ...options, '--', 's', 't', 's*t'], { encoding: 'utf8' });
        assert.notEqual(status, 0);
        assert.match(stderr, why);
    });
}

// --- the patch alone ---

const [WIDTH, HEIGHT, ACROSS] = [40, 25, 2.3];
// Of the ray and the sphere: neither grazed, nor met where the half ends.
const [GRAZED, RIM] = [0.1, 0.04];

const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const scaled = (a, by) => a.map((x) => x * by);
const plus = (...all) => all.reduce((a, b) => a.map((x, i) => x + b[i]));
const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
const unit = (a) => scaled(a, 1 / Math.hypot(...a));

/** Where each ray of an orthographic picture meets what the root is; null: nowhere. */
function hits(root, eye) {
    const camera = { type: 'orthographic', position: eye, target: [0, 0, 0], up: [0, 0, 1], height: ACROSS };
    const size = ['--width', WIDTH, '--height', HEIGHT, '--samples', '1', '--device', 'none'].map(String);
    const picture = ['--aov', 'position', '--format', 'npy', '-o', '-'];
    const { values } = readNpy(run(['render', '-', ...size, ...picture], JSON.stringify({ format: 'fieldcast/1', camera, root })));
    return Array.from({ length: WIDTH * HEIGHT }, (_, i) => {
        const at = [...values.slice(3 * i, 3 * i + 3)];
        return at.every((x) => x === 0 || !Number.isFinite(x)) ? null : at;
    });
}

/** The same of the upper half of the unit sphere; undefined: too close to its rim to say. */
function closedForm(eye) {
    const way = unit(scaled(eye, -1));
    const right = unit(cross(way, [0, 0, 1]));
    const above = cross(right, way);
    return Array.from({ length: WIDTH * HEIGHT }, (_, i) => {
        const x = ((i % WIDTH) + 0.5) / WIDTH - 0.5;
        const y = 0.5 - (Math.floor(i / WIDTH) + 0.5) / HEIGHT;
        const from = plus(eye, scaled(right, (x * ACROSS * WIDTH) / HEIGHT), scaled(above, y * ACROSS));
        const middle = dot(from, way);
        const under = middle * middle - dot(from, from) + 1;
        if (Math.abs(under) < GRAZED) {
            return undefined;
        }
        const both = under < 0 ? [] : [-1, 1].map((sign) => plus(from, scaled(way, -middle + sign * Math.sqrt(under))));
        return both.some(([, , z]) => Math.abs(z) < RIM) ? undefined : (both.find(([, , z]) => z > 0) ?? null);
    });
}

test('the patch alone: hits outside of the half sphere are gone, those inside are kept', () => {
    const { trimmed } = implicitize(sphere, '-u', TURN, '-v', `0,${up}`);
    const { thickness } = trimmed.children[0].params;
    const counts = { kept: 0, gone: 0, unsaid: 0 };
    for (const eye of [[3, 2, 1.5], [2, 3, -1.5]]) {
        const wanted = closedForm(eye);
        const whole = hits(trimmed.children[0], eye);
        hits(trimmed, eye).forEach((hit, i) => {
            if (wanted[i] === undefined) {
                counts.unsaid++;
            } else if (wanted[i] === null) {
                assert.equal(hit, null, `ray ${i} of ${eye} meets ${hit}`);
                counts.gone += whole[i] !== null;
            } else {
                const off = hit && Math.hypot(...plus(hit, scaled(wanted[i], -1)));
                assert.ok(hit && off < 2 * thickness, `ray ${i} of ${eye} meets ${hit} instead of ${wanted[i]}`);
                counts.kept++;
            }
        });
    }
    console.log(`# of 2,000 rays ${JSON.stringify(counts)}`);
    assert.ok(counts.kept > 350 && counts.gone > 130, JSON.stringify(counts));
});
