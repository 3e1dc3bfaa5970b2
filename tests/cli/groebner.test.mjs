// SPDX-License-Identifier: MIT
// fieldcast groebner: bases from the command line, their steps, what is refused, and where.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';

const program = process.env.FIELDCAST ?? 'build/release/fieldcast';

function run(...args) {
    const { status, stdout, stderr } = spawnSync(program, ['groebner', ...args], { encoding: 'utf8' });
    return { status, out: stdout, err: stderr };
}

function basis(...args) {
    const { status, out, err } = run(...args);
    assert.equal(status, 0, err);
    return JSON.parse(out);
}

const texts = (list) => list.map(({ text }) => text);

test('the elimination ideal of a circle on a line, and what an element is', () => {
    const answer = basis('x=cos', 'y=2*sin', 'cos^2+sin^2=1', '--eliminate', '2');
    assert.deepEqual(answer.letters, ['cos', 'sin', 'x', 'y']);
    assert.deepEqual(texts(answer.elimination), ['4*x^2 + y^2 - 4']);
    assert.deepEqual(answer.elimination[0], { text: '4*x^2 + y^2 - 4', leading: 'x^2', terms: 3, degree: 2 });
    assert.ok(answer.basis.length > 1);
});

test('an ideal whose elimination ideal has several generators', () => {
    const { elimination } = basis('x-s^2', 'y-s^3', 'z-s^4', '--eliminate', '1');
    assert.deepEqual(texts(elimination), ['y^2 - x*z', 'x^2 - z']);
});

test('orders, weights and letters decide which monomial leads', () => {
    const leading = (...options) => basis('x^3+x^2*z^2+x*y^2*z+z^3+y^3', ...options).basis[0].leading;
    assert.equal(leading('--order', 'lex'), 'x^3');
    assert.equal(leading('--order', 'grlex'), 'x^2*z^2');
    assert.equal(leading('--order', 'grevlex'), 'x*y^2*z');
    assert.equal(leading(), 'x*y^2*z');
    assert.equal(leading('--order', 'lex', '--letters', 'z y x'), 'z^3');
    assert.equal(leading('--order', 'lex', '--weights', '1 9 1'), 'y^3');
});

test('coefficients modulo a prime, and bases that hold 1', () => {
    assert.deepEqual(texts(basis('3*x-1', '--prime', '7').basis), ['x + 2']);
    assert.deepEqual(texts(basis('x', 'x-1').basis), ['1']);
    assert.deepEqual(texts(basis('2*x-1', '2*x', '--prime', '2').basis), ['1']);
});

test('a division: scale f = quotients and elements, and a rest', () => {
    const { basis: elements, quotients, rest, scale } = basis('2*x^2-y', 'y^2-2', '--order', 'lex', '--divide', 'x^4+x*y+3');
    assert.deepEqual(texts(elements), ['y^2 - 2', '2*x^2 - y']);
    assert.deepEqual([scale, rest], ['4', '4*x*y + 14']);
    assert.deepEqual(quotients, ['1', '2*x^2 + y']);
    const negative = basis('y-x^2', 'z-x^3', '--divide', '6*x*z-6*y^2+4*x');
    assert.deepEqual([negative.quotients, negative.rest], [['-6', '0', '0'], '4*x'], 'of what was given');
    for (const more of [[], ['--prime', '5']]) {
        const of = basis('x^2-y', '--order', 'lex', '--divide', 'x^2/6+0.5*y', ...more);
        assert.deepEqual([of.scale, of.quotients, of.rest], ['6', ['1'], '4*y'], 'of a fraction');
    }
});

test('--steps tells what became of each pair', () => {
    const args = ['x^2+y^2+z^2-1', 'x^2-y+z^2', 'x=z', '--order', 'lex'];
    const { err, out } = run(...args, '--steps');
    const steps = err.trim().split('\n').map((line) => JSON.parse(line));
    const { counts } = JSON.parse(out);
    assert.equal(steps.length, counts.made);
    for (const outcome of ['coprime', 'chain', 'zero', 'added']) {
        assert.equal(steps.filter((step) => step.outcome === outcome).length, counts[outcome], outcome);
    }
    assert.equal(steps.reduce((sum, { divisions }) => sum + divisions, 0), counts.divisions);
    assert.equal(steps.at(-1).waiting, 0);
    const [first] = steps;
    assert.deepEqual(first, { pair: [0, 1], outcome: 'added', degree: 2, sugar: 2, divisions: 0, waiting: 5, element: 3, leading: 'y^2', terms: 3 });
    assert.equal(run(...args).err, '');
});

test('--criteria decides which pairs are left out, never the basis', () => {
    const counted = (...options) => {
        const { basis: elements, counts } = basis('x^2+y^2+z^2-1', 'x^2+z^2-y', 'x-z', ...options);
        assert.deepEqual(texts(elements), ['x - z', '2*z^2 - y', 'y^2 + y - 1']);
        return [counts.made, counts.coprime, counts.chain, counts.zero];
    };
    assert.deepEqual(counted('--criteria', 'both'), [10, 7, 1, 0]);
    assert.deepEqual(counted('--criteria', 'coprime'), [10, 7, 0, 1]);
    assert.deepEqual(counted('--criteria', 'chain'), [10, 0, 5, 3]);
    assert.deepEqual(counted('--criteria', 'none'), [10, 0, 0, 8]);
    assert.deepEqual(counted(), counted('--criteria', 'both'));
    assert.match(run('x', '--criteria', 'all').err, /--criteria: 'all' is none of both, coprime, chain, none/);
});

test('--strategy decides which pair comes next', () => {
    const pairs = (...options) => {
        const { err } = run('x^3-2*x*y', 'x^2*y-2*y^2+x', 'x*z-y^3', '--steps', ...options);
        return err.trim().split('\n', 3).map((line) => JSON.parse(line).pair);
    };
    assert.deepEqual(pairs('--strategy', 'normal'), [[0, 1], [1, 3], [2, 4]]);
    assert.deepEqual(pairs('--strategy', 'sugar'), [[0, 1], [1, 3], [0, 3]]);
    assert.deepEqual(pairs('--strategy', 'first'), [[0, 1], [0, 2], [1, 2]]);
    assert.deepEqual(pairs(), pairs('--strategy', 'normal'));
});

const REFUSED = [
    ['a name', ['x+?'], /^\/generators:1:3: /],
    ['the third line', ['x', 'y', 'x*(y'], /^\/generators:3:5: .*in line 3, column 3/],
    ['what only its value shows', ['x', ' ', 'y', 'x+1/y'], /^\/generators:4:1: a fraction/],
    ['an unknown letter', ['x+q', '--letters', 'x y'], /^\/generators:1:3: .*"q"/],
    ['two unknown letters', ['x', 'q+r', '--letters', 'x y'], /^\/generators:2:1: "q" .*\(also 2:3: "r" /],
    ['a function', ['sin(x)'], /sin\(\) makes no polynomial/],
    ['a fraction', ['1/x'], /^\/generators:1.*a fraction is no polynomial/],
    ['an inequality', ['x < 1'], /an inequality is no polynomial/],
    ['a number that is no prime', ['x', '--prime', '9'], /^\/prime: 9 is no prime/],
    ['weights for other letters', ['x+y', '--weights', '1'], /^\/weights: 1 weights for 2 letters/],
    ['a weight below 0', ['x+y', '--weights', '1 -1'], /^\/weights: weights are 2 whole numbers/],
    ['more letters than there are', ['x+y', '--eliminate', '3'], /^\/eliminate: 3 of 2 letters/],
    ['eleven letters', ['a+b+c+d+f+g+h+i+j+k+l'], /^\/letters: more than 10 letters \(groebner_letters\)/],
    ['65 polynomials', Array.from({ length: 65 }, (_, i) => `x-${i}`), /^\/generators: more than 64 polynomials/],
    ['a number that is rounded', ['x', 'x-0.12345678901234567'], /^\/generators:2:1: a number has more than 15 digits, which are rounded/],
    ['a dividend that is rounded', ['x', '--divide', '1234567890.1234567*x'], /^\/divide:1:1: a number has more than 15 digits/],
    ['a dividend', ['x', '--divide', 'x+*'], /^\/divide:1:3: /],
    ['a number that is divided by 0', ['x+y', 'x/6', '--prime', '3'], /^\/generators:2:1: a denominator is 0 modulo 3/],
];
for (const [name, args, message] of REFUSED) {
    test(`refused: ${name}`, () => {
        const { status, err } = run(...args);
        assert.equal(status, 1, err);
        assert.match(err, message);
    });
}

test('the limits themselves are taken', () => {
    assert.equal(basis('a+b+c+d+f+g+h+i+j+k').letters.length, 10);
    assert.deepEqual(texts(basis(...Array.from({ length: 64 }, (_, i) => `${i + 1}*x`)).basis), ['x']);
    assert.equal(run().status, 2);
});
