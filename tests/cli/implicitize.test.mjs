// SPDX-License-Identifier: MIT
// fieldcast implicitize: the equations of classical surfaces, their certificates, and what is refused.
// The oracle evaluates the parametric texts themselves in double precision.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { test } from 'node:test';

const program = process.env.FIELDCAST ?? 'build/release/fieldcast';

// Degree and number of terms are those of the literature, or, for patches with numbers of our own, of
// the general surface of that kind: 2 m n for degrees m and n in the parameters, n^2 for a triangle.
const d = '(5-3*cos(u)*cos(v))';
const klein = '(2+cos(t/2)*sin(s)-sin(t/2)*sin(2*s))';
// A patch by its control points; the rim of M. Newell's teapot (1975).
const weights = (v) => [`(1-${v})^3`, `3${v}*(1-${v})^2`, `3${v}^2*(1-${v})`, `${v}^3`];
const bezier = (rows) =>
    [0, 1, 2].map((axis) =>
        rows.flatMap((row, i) => row.map((p, j) => `(${p[axis]})*${weights('s')[i]}*${weights('t')[j]}`)).join('+'),
    );
const arc = (r, part, z) => [[r, 0, z], [r, -part, z], [part, -r, z], [0, -r, z]];
const rim = bezier([arc(1.4, 0.784, 2.4), arc(1.3375, 0.749, 2.53125), arc(1.4375, 0.805, 2.53125), arc(1.5, 0.84, 2.4)]);
const SURFACES = [
    ['plane', ['s', 't', '1+s-2*t'], 1, 4],
    ['cylinder', ['cos(s)', 'sin(s)', 't'], 2, 3],
    ['cone', ['s*cos(t)', 's*sin(t)', 's'], 2, 3],
    ['paraboloid', ['s*cos(t)', 's*sin(t)', 's^2'], 2, 3],
    ['hyperbolic paraboloid', ['s', 't', 's t'], 2, 2],
    ['monkey saddle', ['s', 't', 's^3-3s*t^2'], 3, 3],
    ['Whitney umbrella', ['s*t', 's', 't^2'], 3, 2],
    ['swallowtail', ['u*v^2+3v^4', '-2u*v-4v^3', 'u'], 5, 6],
    ['tacnodal quintic', ['t', 's^2', 's(s^2-t^2)'], 5, 4],
    ['sphere', ['2s/(1+s^2+t^2)', '2t/(1+s^2+t^2)', '(1-s^2-t^2)/(1+s^2+t^2)'], 2, 4],
    ['sphere by hyperbolic functions', ['cos(t)/cosh(s)', 'sin(t)/cosh(s)', 'tanh(s)'], 2, 4],
    ['angle that is shifted', ['s*cos(t+pi/2)', 's*sin(t)', 's'], 1, 2],
    ['angle that is shifted by tau', ['s*cos(t+tau/4)', 's*sin(t)', 's'], 1, 2],
    ['angle that runs back', ['s*sin(-t)', 's*sin(t)', 's'], 1, 2],
    ['torus', ['(2+cos(u))*cos(v)', '(2+cos(u))*sin(v)', 'sin(u)'], 4, 10],
    ['Roman surface', ['cos(u)*cos(v)*sin(v)', 'sin(u)*cos(v)*sin(v)', 'cos(u)*sin(u)*cos(v)^2'], 4, 4],
    ['cross-cap', ['cos(u)*sin(2v)', 'sin(u)*sin(2v)', 'cos(v)^2-cos(u)^2*sin(v)^2'], 4, 7],
    ['Dupin cyclide', [`(3-5cos(u)*cos(v)+16cos(u))/${d}`, `4sin(u)*(5-cos(v))/${d}`, `4sin(v)*(3cos(u)-1)/${d}`], 4, 11],
    ['conoid of Pluecker', ['s*cos(t)', 's*sin(t)', 'sin(2t)'], 3, 3],
    ['Moebius strip', ['(1+s/2*cos(t/2))*cos(t)', '(1+s/2*cos(t/2))*sin(t)', 's/2*sin(t/2)'], 3, 7],
    ['Enneper', ['s-s^3/3+s*t^2', 't-t^3/3+t*s^2', 's^2-t^2'], 9, 23],
    ['Klein bottle', [`${klein}*cos(t)`, `${klein}*sin(t)`, 'sin(t/2)*sin(s)+cos(t/2)*sin(2s)'], 12, 157],
    ['Henneberg', ['2sinh(s)*cos(t)-2/3*sinh(3s)*cos(3t)', '2sinh(s)*sin(t)+2/3*sinh(3s)*sin(3t)', '2cosh(2s)*cos(2t)'], 15, 127],
    ['rim of the teapot', rim, 9, 106],
    ['biquadratic patch', ['s+s^2*t^2-t', 't+2s^2-s*t^2', 's t+3s^2*t-t^2+1'], 8, null],
    ['cubic triangle', ['s^3+2s*t-t', 't^3-s^2+s', 's^2*t+s*t^2+t^2-s'], 9, null],
    ['bicubic patch', ['s^3*t^3+s-2t^2', '2s^3*t^3+s^3-t+s t', 's^3*t^3+t^3+s^2'], 18, null],
];

const implicitize = (texts, ...options) =>
    JSON.parse(execFileSync(program, ['implicitize', ...options, '--', ...texts], { encoding: 'utf8' }));

// By the road that the program takes itself: asked once for each surface.
const answers = new Map();
function usual(texts) {
    const key = texts.join('\n');
    if (!answers.has(key)) {
        answers.set(key, implicitize(texts));
    }
    return answers.get(key);
}

// The language of equations as JavaScript: products that are not written, powers, functions of Math.
function compile(text, names) {
    const code = text
        .replace(/(\d)\s*([a-z(])/g, '$1*$2')
        .replace(/\b([stuv])\s*(?=[(stuv])/g, '$1*')
        .replaceAll('^', '**')
        .replace(/\bpi\b/g, 'Math.PI')
        .replace(/\btau\b/g, '2*Math.PI')
        .replace(/\b(sin|cos|tan|sinh|cosh|tanh|exp)\(/g, 'Math.$1(');
    return new Function(...names, `return ${code}`);
}

// |sum of terms| / sum of |terms| at a point.
function residual(equation, point) {
    const terms = equation.replace(/-/g, '+-').split('+').filter(Boolean);
    const values = terms.map((term) => compile(term.replace(/^-/, '-1*'), ['x', 'y', 'z'])(...point));
    const sum = values.reduce((a, b) => a + b, 0);
    return Math.abs(sum) / values.reduce((a, b) => a + Math.abs(b), 1e-300);
}

function points(texts, count) {
    const parts = texts.map((text) => compile(text, ['s', 't', 'u', 'v']));
    return Array.from({ length: count }, (_, i) => {
        const [a, b] = [0.15 + ((i * 0.618034) % 1) * 0.8, 0.2 + ((i * 0.754878) % 1) * 0.7];
        return parts.map((part) => part(a, b, a, b));
    });
}

for (const [name, texts, degree, terms] of SURFACES) {
    test(`${name}: its equation and certificate`, () => {
        const { equation, certificate } = usual(texts);
        assert.equal(certificate.degree, degree);
        assert.equal(certificate.identity, 'exact');
        assert.equal(certificate.irreducible, true);
        assert.deepEqual(certificate.parametric, texts);
        assert.equal(certificate.terms, equation.replace(/-/g, '+-').split('+').filter(Boolean).length);
        if (terms !== null) {
            assert.equal(certificate.terms, terms);
        }
        for (const point of points(texts, 20)) {
            assert.ok(residual(equation, point) < 1e-9, `${name} misses ${point}`);
        }
    });
}

// The next primes above 2^29 and 2^60: what is computed modulo one of them lacks what it divides.
for (const [name, texts, equation] of [
    ['a denominator', ['s/(2^29+11)', 't', 's*t/(2^29+11)'], 'x*y-z'],
    ['a large denominator', ['s/(2^60+33)', 't', 's*t/(2^60+33)'], 'x*y-z'],
    ['a coefficient', ['s', 't', 's^2+(2^29+11)*t'], 'x^2+536870923*y-z'],
    ['a sum of coefficients', ['s+2*t', 's+(2^29+13)*t', 's'], '536870925*x-2*y-536870923*z'],
]) {
    test(`a prime that divides ${name}`, () => assert.equal(implicitize(texts).equation, equation));
}

// The surfaces that a road does not finish within seconds.
const patches = ['biquadratic patch', 'cubic triangle', 'bicubic patch'];
const TOO_HARD = {
    resultant: ['Henneberg', 'bicubic patch'],
    groebner: ['Roman surface', 'Klein bottle', 'Henneberg', 'cubic triangle', 'bicubic patch'],
    saturation: ['Roman surface', 'cross-cap', 'Moebius strip', 'Klein bottle', 'Henneberg', ...patches],
};
for (const [method, hard] of Object.entries(TOO_HARD)) {
    test(`--method ${method} finds the same equations`, () => {
        const easy = SURFACES.filter(([name]) => !hard.includes(name));
        assert.equal(easy.length, SURFACES.length - hard.length);
        for (const [name, texts] of easy) {
            const { equation, certificate } = implicitize(texts, '--method', method);
            assert.equal(equation, usual(texts).equation, name);
            assert.equal(certificate.method, method);
            assert.equal(certificate.pairs !== undefined, method !== 'resultant', name);
        }
    });
}

// --- Singular's elimination, where it is on the machine ---

const hasSingular = spawnSync('Singular', ['--version']).error === undefined;

// The letters, then expressions that are 0. Where a letter is an angle, two letters are its cosine
// and sine, or of its half. `w` times a denominator is 1.
const circle = (a, b) => `${a}^2+${b}^2-1`;
const angles = ['a,b,c,d', circle('a', 'b'), circle('c', 'd')]; // u or s, then v or t
const ELIMINATED = {
    plane: ['s,t', 'x-s', 'y-t', 'z-(1+s-2*t)'],
    cylinder: ['a,b,t', circle('a', 'b'), 'x-a', 'y-b', 'z-t'],
    cone: ['s,a,b', circle('a', 'b'), 'x-s*a', 'y-s*b', 'z-s'],
    paraboloid: ['s,a,b', circle('a', 'b'), 'x-s*a', 'y-s*b', 'z-s^2'],
    'hyperbolic paraboloid': ['s,t', 'x-s', 'y-t', 'z-s*t'],
    'monkey saddle': ['s,t', 'x-s', 'y-t', 'z-(s^3-3*s*t^2)'],
    'Whitney umbrella': ['s,t', 'x-s*t', 'y-s', 'z-t^2'],
    swallowtail: ['u,v', 'x-(u*v^2+3*v^4)', 'y+2*u*v+4*v^3', 'z-u'],
    'tacnodal quintic': ['s,t', 'x-t', 'y-s^2', 'z-s*(s^2-t^2)'],
    sphere: ['w,s,t', 'w*(1+s^2+t^2)-1', 'x-2*s*w', 'y-2*t*w', 'z-(1-s^2-t^2)*w'],
    torus: [...angles, 'x-(2+a)*c', 'y-(2+a)*d', 'z-b'],
    'Roman surface': [...angles, 'x-a*c*d', 'y-b*c*d', 'z-a*b*c^2'],
    'cross-cap': [...angles, 'x-2*a*c*d', 'y-2*b*c*d', 'z-(c^2-a^2*d^2)'],
    'Dupin cyclide': [
        ...['w,a,b,c,d', circle('a', 'b'), circle('c', 'd'), 'w*(5-3*a*c)-1'],
        ...['x-(3-5*a*c+16*a)*w', 'y-4*b*(5-c)*w', 'z-4*d*(3*a-1)*w'],
    ],
    'conoid of Pluecker': ['s,a,b', circle('a', 'b'), 'x-s*a', 'y-s*b', 'z-2*a*b'],
    'Moebius strip': [
        ...['s,a,b', circle('a', 'b')],
        ...['2*x-(2+s*a)*(a^2-b^2)', '2*y-(2+s*a)*2*a*b', '2*z-s*b'],
    ],
    Enneper: ['s,t', '3*x-(3*s-s^3+3*s*t^2)', '3*y-(3*t-t^3+3*t*s^2)', 'z-(s^2-t^2)'],
};

function eliminate([letters, ...generators]) {
    const input = `ring r=0,(${letters},x,y,z),(dp(${letters.split(',').length}),dp(3)); short=0;
        ideal j=eliminate(ideal(${generators.join(',')}),${letters.replaceAll(',', '*')});
        size(j); print(cleardenom(j[1])); quit;`;
    const answer = execFileSync('Singular', ['-q', '--no-rc'], { input, encoding: 'utf8', stdio: ['pipe', 'pipe', 'ignore'] });
    const [count, equation] = answer.split('\n').filter((line) => line && !line.startsWith('//'));
    assert.equal(count, '1', answer);
    return equation;
}

// The terms, in one order and with one sign.
function sorted(equation) {
    const terms = equation.replace(/-/g, '+-').split('+').filter(Boolean);
    const number = (term) => {
        const [, sign, digits, powers] = /^(-?)(\d*)\*?(.*)$/.exec(term);
        return [powers.split('*').sort().join('*'), BigInt(`${sign}${digits || 1}`)];
    };
    const rows = terms.map(number).sort(([a], [b]) => (a < b ? -1 : 1));
    return rows.map(([powers, c]) => `${rows[0][1] < 0n ? -c : c} ${powers}`);
}

test('Singular finds the same equations', { skip: hasSingular ? false : 'Singular is not here' }, () => {
    for (const [name, generators] of Object.entries(ELIMINATED)) {
        const [, texts] = SURFACES.find(([other]) => other === name);
        assert.deepEqual(sorted(eliminate(generators)), sorted(usual(texts).equation), name);
    }
});

const torus = SURFACES.find(([name]) => name === 'torus')[1];

test('a coefficient that is one off is seen by the oracle', () => {
    const wrong = usual(torus).equation.replace('10*x^2', '11*x^2');
    assert.ok(points(torus, 20).some((point) => residual(wrong, point) > 1e-3));
});

test('how often the parameters cover the surface', () => {
    assert.equal(implicitize(['s*cos(t)', 's*sin(t)', 's^2']).certificate.map_degree, 2);
    assert.equal(implicitize(['s', 't', 's*t']).certificate.map_degree, 1);
    assert.equal(implicitize(['s^2', 't^3', 's^2+t^3']).certificate.map_degree, 6);
});

test('decimals are the fractions that are written', () => {
    assert.equal(implicitize(['s', 't', '0.1s^2+0.25t']).equation, '2*x^2+5*y-20*z');
    assert.equal(implicitize(['s', 't', '1e-3s*t']).equation, 'x*y-1000*z');
});

// --- refusals ---

const REFUSED = [
    ['a curve', ['s', 's^2', 's^3'], /make a curve, not a surface/],
    ['a curve in two parameters', ['(s+t)^2', '(s+t)^3', 's+t'], /make a curve, not a surface/],
    ['a point', ['1', '2', '3'], /make a point, not a surface/],
    ['helicoid', ['s*cos(t)', 's*sin(t)', 't'], /^z: t stands inside and outside of sin, cos or tan/],
    ['catenoid', ['cosh(v)*cos(u)', 'cosh(v)*sin(u)', 'v'], /^z: v stands inside and outside of exp, sinh, cosh or tanh/],
    ['Dini', ['cos(u)*sin(v)', 'sin(u)*sin(v)', 'cos(v)+log(tan(v/2))+u/5'], /^z: .*(log|not algebraic)/],
    ['two families', ['sin(t)', 'exp(t)', 's'], /^y: t stands in sin, cos or tan and in exp/],
    ['a root', ['sqrt(s)', 't', 's'], /^x: sqrt\(\) makes no polynomial/],
    ['a number that is not rational', ['s', 'e*t', 't'], /^y: e is no rational number/],
    ['an angle that is not rational', ['s*cos(t+1)', 's*sin(t)', 's'], /^x: an angle may be shifted by multiples of pi\/2/],
    ['a denominator of 0', ['s', 't', '1/(s-s)'], /^z: a denominator is 0 everywhere/],
    ['three parameters', ['s', 't', 'u'], /a surface has two parameters/],
    ['degree 32', ['s^4*t^4+s', 's^4-t^4', 's^3*t^4+t'], /the equation has degree \d+, .* the limit is 18 \(implicit_degree\)/],
    ['a tower', ['((s^60)^60)^60', 't', 's'], /^x: a polynomial of degree \d+; the limit is 64 \(parametric_degree\)/],
    ['an exponent that is large', ['s^(9^9)', 't', 's'], /^x:1:\d: exponent 387420489; the limit is 64 \(equation_exponent\)/],
    ['hexadecimal digits', ['0x10*s', 't', 's'], /^x:1:2: "x10" is no name/],
    ['a long number', ['s*(10^60)^60*(10^60)^60', 't', 's*t'], /^x: a coefficient of \d+ bits; the limit is 4096 \(coefficient_bits\)/],
    ['a number that is rounded', ['s', '0.1000000000000000055*t', 't'], /^y: a number has more than 15 digits, which are rounded/],
    ['an unknown name', ['s', 'sn(t)', 't'], /^y:1:1: "sn" is no function/],
    ['two unknown names', ['s', 'q+sn(t)', 't'], /^y:1:1: "q" is no name.*\(also 1:3: "sn" is no function/],
    ['x', ['x', 's', 't'], /^x:1:1: "x" is no name/],
    ['a relation', ['s = t', 's', 't'], /^x:1:3: a relation; an expression has none/],
    ['no text', ['', 's', 't'], /^x:1:1/],
    ['more text than fits', [`s${'+s'.repeat(9000)}`, 's', 't'], /^x: 18001 bytes are above the maximum 16384/],
];

for (const [name, texts, wanted] of REFUSED) {
    test(`refused: ${name}`, () => {
        const { status, stdout, stderr } = spawnSync(program, ['implicitize', '--', ...texts], { encoding: 'utf8' });
        assert.equal(status, 1);
        assert.equal(stdout, '');
        assert.match(stderr, wanted);
    });
}

// Of the processor, with a start of the program each: it is refused before anything is computed.
test('a refusal takes no longer than the simplest answer', () => {
    const quick = ['a curve', 'a point', 'helicoid', 'Dini', 'a root', 'a denominator of 0', 'degree 32'];
    const rows = REFUSED.filter(([name]) => quick.includes(name)).map(([, texts]) => texts);
    const cost = (texts) => {
        const ticks = () => fs.readFileSync('/proc/self/stat', 'utf8').split(') ').pop().split(' ').slice(13, 15);
        const before = ticks();
        spawnSync(program, ['implicitize', '--', ...texts]);
        return ticks().reduce((sum, now, i) => sum + Number(now) - Number(before[i]), 0);
    };
    const least = (texts) => Math.min(cost(texts), cost(texts), cost(texts));
    const answer = least(['s', 't', 's*t']);
    assert.equal(rows.length, quick.length);
    for (const texts of rows) {
        const ticks = least(texts);
        assert.ok(ticks <= 3 * answer, `${texts}: ${ticks} ticks, an answer ${answer}`);
    }
});

test('three expressions are taken, no more and no fewer', () => {
    const run = (...args) => spawnSync(program, ['implicitize', ...args], { encoding: 'utf8' });
    assert.match(run('--help').stdout, /^Usage: fieldcast implicitize \[OPTION\]\.\.\. X Y Z\n/);
    for (const [args, why] of [[['s', 't'], /needs X Y Z/], [['s', 't', 's', 'u'], /does not take 'u'/]]) {
        const { status, stdout, stderr } = run(...args);
        assert.equal(status, 2);
        assert.equal(stdout, '');
        assert.match(stderr, why);
    }
});

test('--steps tells what is found, with the time, on stderr', () => {
    const { stdout, stderr } = spawnSync(program, ['implicitize', '--steps', 's*t', 's', 't^2'], { encoding: 'utf8' });
    const steps = stderr.trimEnd().split('\n').map((line) => /^\d+\.\d\d s: (.*)$/.exec(line)?.[1]);
    assert.deepEqual(steps, [
        'degree 3, map degree 1',
        '2 of 20 monomials',
        'prime 1: 61 bits',
        'prime 2: 121 bits',
        'exact: the parts put into it give 0',
        'irreducible',
    ]);
    const silent = spawnSync(program, ['implicitize', 's*t', 's', 't^2'], { encoding: 'utf8' });
    assert.equal(silent.stderr, '');
    assert.equal(JSON.parse(stdout).equation, JSON.parse(silent.stdout).equation);
});
