// SPDX-License-Identifier: MIT
// fieldcast check proves each equation that has a parametric surface beside it: what fits, what does
// not and why, what cannot be checked. The status fails where one does not fit.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { test } from 'node:test';

const program = process.env.FIELDCAST ?? 'build/release/fieldcast';
const run = (args, input) => spawnSync(program, args, { input, encoding: 'utf8' });

const surface = (x, y, z, letters = 'st') => ({
    ...{ x, y, z },
    ...Object.fromEntries([...letters].map((letter) => [letter, [-1, 1]])),
});
const umbrella = surface('s*t', 's', 't^2');
const torus = surface('(2+cos(u))*cos(v)', '(2+cos(u))*sin(v)', 'sin(u)', 'uv');

/** What check says of one node, without the place. */
function check(params) {
    const node = { id: 'it', type: 'implicit', params };
    const result = run(['check', '-'], JSON.stringify({ format: 'fieldcast/1', root: node }));
    const lines = (result.stdout + result.stderr).trimEnd().split('\n');
    const told = lines.find((line) => line.includes('/nodes/it/params/parametric: ')) ?? '';
    return { ...result, told: told.replace(/^.*\/nodes\/it\/params\/parametric: /, '') };
}

const VERIFIED = [
    ['the umbrella', { equation: 'x^2 = y^2*z', parametric: umbrella }],
    ['with a whole factor', { equation: '14x^2-14y^2*z = 0', parametric: umbrella }],
    ['as a solid', { equation: 'x^2 < y^2*z', parametric: umbrella }],
    ['with letters', { equation: 'a*x^2 = 0.1*y^2*z', a: 0.1, parametric: umbrella }],
    ['with a denominator', { equation: 'x^2/y^2 = z', parametric: umbrella }],
    ['with definitions', { equation: 'q := x^2; q = y^2*z', parametric: umbrella }],
    ['factors that are not written out', { equation: '(x^2+y^2+z^2+3)^2 = 16(x^2+y^2)', parametric: torus }],
    ['hyperbolic functions', { equation: 'x^2+y^2+z^2 = 1', parametric: surface('cos(t)/cosh(s)', 'sin(t)/cosh(s)', 'tanh(s)') }],
    ['exponentials', { equation: 'x*y = 1', parametric: surface('exp(s)', 'exp(-s)', 't') }],
    ['other letters', { equation: 'x^2 = y^2*z', parametric: surface('u*v', 'u', 'v^2', 'uv') }],
];
for (const [name, params] of VERIFIED) {
    test(`verified: ${name}`, () => {
        const { status, stdout, stderr, told } = check(params);
        assert.match(told, /^verified: degree \d, \d+ terms; the patch covers \d+ % of the implicit surface within the clip$/);
        assert.match(stdout.split('\n')[0], /^-: \/nodes\/it\/params\/equation: /);
        assert.equal(stdout.split('\n').slice(1).join('\n'), `-: /nodes/it/params/parametric: ${told}\n`);
        assert.equal(stderr, '');
        assert.equal(status, 0);
    });
}

// A square of side 1 in the plane z = 0, of what the clip has of it.
const square = { equation: 'z = 0', parametric: { x: 's', y: 't', z: '0*s', s: [0, 1], t: [0, 1] } };
const CLIPS = [
    ['the box that there is', {}, 100 / 9],
    ['a box', { size: [2, 2, 1] }, 25],
    ['a ball', { clip: 'ball', radius: 2 }, 100 / (4 * Math.PI)],
];
for (const [name, clip, wanted] of CLIPS) {
    test(`the clip cuts what is covered: ${name}`, () => {
        const [, percent] = /the patch covers (\d+) % of/.exec(check({ ...square, ...clip }).told);
        assert.ok(Math.abs(percent - wanted) < 3, `${percent} instead of ${wanted}`);
    });
}

const DOES_NOT_FIT = [
    ['a number that is one off', { equation: 'x^2 = y^2*z+1', parametric: umbrella }, /at the point \(2, 1, 4\) of the surface the equation is off by -1/],
    ['a letter that is off', { equation: 'a*x^2 = y^2*z', a: 1.001, parametric: umbrella }, /is off by 0.004/],
    ['another surface', { equation: '(x^2+y^2+z^2+3)^2 = 16(x^2+y^2)', parametric: umbrella }, /is off by/],
    ['a product with another surface', { equation: '(x^2-y^2*z)*(x-3) = 0', parametric: umbrella }, /is a product/],
    ['a square', { equation: '(x^2-y^2*z)^2 = 0', parametric: umbrella }, /is a product/],
    ['everything', { equation: 'x = x', parametric: umbrella }, /holds everywhere/],
    ['nothing', { equation: 'x-x = 1', parametric: umbrella }, /holds nowhere/],
    ['a curve', { equation: 'y = x^2', parametric: surface('s', 's^2', 's^3') }, /make a curve, not a surface/],
    ['a point', { equation: 'x = 1', parametric: surface('1', '2', '3') }, /make a point, not a surface/],
];
for (const [name, params, why] of DOES_NOT_FIT) {
    test(`does not fit: ${name}`, () => {
        const { status, told } = check(params);
        assert.match(told, /^does not fit: /);
        assert.match(told, why);
        assert.equal(status, 1);
    });
}

const NOT_CHECKED = [
    ['a degree above the limit', { equation: 'x^19 = y', parametric: umbrella }, /too large: the equation has degree 19; the limit is 18 \(implicit_degree\)/],
    ['a degree far above it', { equation: '(x^60)^60 = y', parametric: umbrella }, /equation: a polynomial of degree \d+; the limit is 64 \(parametric_degree\)/],
    ['a long number', { equation: 'x^2 = y^2*z*1.0000000000000001', parametric: umbrella }, /equation: a number has more than 15 digits/],
    ['a sine of x', { equation: 'sin(x) = y', parametric: umbrella }, /equation: sin\(\) makes no polynomial/],
    ['pi', { equation: 'x = pi', parametric: umbrella }, /equation: pi is no rational number/],
    ['a letter without a range', { equation: 'x = y', parametric: surface('s', 't', '1', 'su') }, /t: has no range/],
    ['a surface that cannot be read', { equation: 'x = y', parametric: surface('s+', 't', '1') }, /x:1:3: expected a number/],
    ['a helicoid', { equation: 'x = y', parametric: surface('s*cos(t)', 's*sin(t)', 't') }, /z: t stands inside and outside of sin/],
    ['a denominator that is 0', { equation: 'x/(y-y) = 1', parametric: umbrella }, /equation: a denominator is 0 everywhere/],
];
for (const [name, params, why] of NOT_CHECKED) {
    test(`not checked: ${name}`, () => {
        const { status, told, stderr } = check(params);
        assert.match(told, /^not checked: /);
        assert.match(told, why);
        assert.match(stderr, /^fieldcast: warning: -: /m);
        assert.equal(status, 0);
    });
}

test('an equation that cannot be read is an error of its own', () => {
    const { status, told, stdout } = check({ equation: 'x +', parametric: umbrella });
    assert.match(stdout, /^-: \/nodes\/it\/params\/equation:1:4: /m);
    assert.match(told, /^not checked: equation:1:4: /);
    assert.equal(status, 1);
});

test('equations in models and hidden nodes are proved, others are not', () => {
    const node = (id, equation, more = {}) => ({ id, type: 'implicit', params: { equation, parametric: umbrella }, ...more });
    const { status, stdout } = run(
        ['check', '-'],
        JSON.stringify({
            format: 'fieldcast/1',
            models: { m: node('inside', 'x = 1') },
            root: {
                id: 'root',
                type: 'union',
                children: [
                    node('hidden', 'x = 2', { visible: false }),
                    { id: 'bare', type: 'implicit', params: { equation: 'x = 3' } },
                    { id: 'none', type: 'implicit', params: { equation: 'x = 4', parametric: {} } },
                ],
            },
        }),
    );
    assert.equal(status, 1);
    const proved = stdout.trimEnd().split('\n').filter((line) => line.includes('/parametric: '));
    const places = proved.map((line) => line.split(': ').slice(1, 3).join(' '));
    assert.deepEqual(places, ['/nodes/hidden/params/parametric does not fit', '/nodes/inside/params/parametric does not fit']);
});

test('every equation that implicitize finds is verified', () => {
    for (const parametric of [umbrella, torus, surface('s-s^3/3+s*t^2', 't-t^3/3+t*s^2', 's^2-t^2')]) {
        const found = run(['implicitize', '--', parametric.x, parametric.y, parametric.z]);
        const { equation, certificate } = JSON.parse(found.stdout);
        assert.deepEqual(certificate.letters, Object.keys(parametric).slice(3));
        assert.match(check({ equation, parametric }).told, /^verified/);
    }
});

test('every example that tells its surface is verified', () => {
    const folder = new URL('../../protocol/examples/', import.meta.url).pathname;
    const names = fs.readdirSync(folder).filter((name) => name.endsWith('.json'));
    const told = names.filter((name) => fs.readFileSync(folder + name, 'utf8').includes('"parametric":'));
    const { status, stdout, stderr } = run(['check', ...told.map((name) => folder + name)]);
    const beside = told.flatMap((name) => fs.readFileSync(folder + name, 'utf8').match(/"parametric":/g));
    assert.equal(stdout.match(/parametric: verified: /g)?.length, beside.length, stdout + stderr);
    assert.deepEqual(
        told.sort(),
        ['boy', 'dingdong', 'enneper', 'moebius', 'rim', 'steiner', 'whitney'].map((name) => `surface-${name}.json`),
    );
    assert.equal(status, 0);
});
