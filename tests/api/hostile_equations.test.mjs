// SPDX-License-Identifier: MIT
// Equations and surfaces that are broken or meant to do harm: each is answered with a limit by its
// name or with a clear reason, no process is left, and the viewer of another scene gets a new frame
// while each question is open.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { longNumber } from '../support/algebra.mjs';
import { ask, childrenOf, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const nest = (count, open, inner, close = '') => open.repeat(count) + inner + close.repeat(count);
const chain = (sign) =>
    `q0 := s+t; ${Array.from({ length: 30 }, (_, i) => `q${i + 1} := q${i}${sign}q${i};`).join('')} q30`;
const quotients = (a, b) => Array.from({ length: 30 }, (_, i) => `1/(${a}+${i}${b}+1)`).join('+');

// --- surfaces whose equation is asked for: their x, or all three parts; where and why there is none ---

const SURFACES = [
    ['a tower of powers', '((s^60)^60)^60', '/x', /degree 120; the limit is 64 \(parametric_degree\)/],
    ['a tower of numbers', '2^2^2^2^2^9*s', '/x', /exponent \d+; the limit is 64 \(equation_exponent\)/],
    ['an exponent 9^9^9', 's^(9^9^9)', '/x', /exponent \d+; the limit is 64 \(equation_exponent\)/],
    ['10^1000', '10^1000*s', '/x', /exponent 1000; the limit is 64 \(equation_exponent\)/],
    ['1e1000', '1e1000*s', '/x', /1e1000 is above the maximum 1e\+06/],
    ['degree 10^6', 's^1000000', '/x', /exponent 1000000; the limit is 64 \(equation_exponent\)/],
    ['degree -10^6', 's^-1000000', '/x', /exponent -1000000; the limit is 64 \(equation_exponent\)/],
    ['tiny numbers', '(1e-300)^60*s', '/x', /a coefficient of \d+ bits; the limit is 4096 \(coefficient_bits\)/],
    ['millions of terms', '((1+s+t)^64)*((1+s-t)^64)', '/x', /degree 128; the limit is 64 \(parametric_degree\)/],
    ['a polynomial of a polynomial', 'cheb(64, cheb(64, s))', '/x', /the limit is 64 \(parametric_degree\)/],
    ['many denominators', [quotients('s', 't'), quotients('t', 's'), quotients('t', '*3')], '', /degree \d+; the limit is 64 \(parametric_degree\)/],
    ['a large degree', ['s^4*t^4+s', 's^4-t^4', 's^3*t^4+t'], '', /degree 32, up to 6545 coefficients; the limit is 18 \(implicit_degree\)/],
    ['angles far apart', ['cos(1000000*s)+cos(s)', 't', 'sin(s)'], '/x', /multiples that differ by a factor over 64 \(equation_exponent\)/],
    ['exponentials far apart', ['exp(1000000*s)+exp(s)', 't', 'exp(s)'], '/x', /multiples that differ by a factor over 64 \(equation_exponent\)/],
    ['0/0', '0/0', '/x', /a denominator is 0 everywhere/],
    ['a denominator that cancels', '1/(1/s-1/s)', '/x', /a denominator is 0 everywhere/],
    ['a denominator that cancels by an identity', ['1/(cos(s)^2+sin(s)^2-1)', 't', 'cos(s)'], '/x', /a denominator is 0 everywhere/],
    ['denominators that cancel to a curve', ['(s^2-t^2)/(s-t)', '(s^2+2s*t+t^2)/(s+t)', '1'], '', /make a curve, not a surface/],
    ['nothing', ['0', '0', '0'], '', /make a point, not a surface/],
    ['a point that cancels', ['s-s', 't/t', '(s+t)^2-s^2-2s*t-t^2'], '', /make a point, not a surface/],
    ['a curve by an identity', ['cos(s+t)', 'sin(s+t)', 'cos(2s+2t)'], '', /make a curve, not a surface/],
    ['a thousand parentheses', nest(1000, '(', 's', ')'), '/x', /nested deeper than 64 levels \(equation_depth\)/],
    ['five thousand products', nest(5000, '2(', 's', ')'), '/x', /nested deeper than 64 levels \(equation_depth\)/],
    ['four thousand signs', nest(4000, '-', 's'), '/x', /nested deeper than 64 levels \(equation_depth\)/],
    ['a hundred sines', nest(100, 'sin(', 's', ')'), '/x', /nested deeper than 64 levels \(equation_depth\)/],
    ['squares of squares by definitions', chain('*'), '/x', /\(equation_nodes\), or 16384 with all definitions written out \(equation_weight\)/],
    ['sums of sums by definitions', chain('+'), '/x', /\(equation_weight\)/],
    ['a definition by itself', 'q := q+1; q', '/x', /"q" is no name/],
    ['too much text', 's+'.repeat(8500) + 's', '/x', /17001 bytes are above the maximum 16384 \(equation_bytes\)/],
    ['a Cyrillic letter', '\u0455*t', '/x', /found "\u0455"/],
    ['a space of no width', 's\u200b*t', '/x', /unexpected/],
    ['text from right to left', '\u202es*t', '/x', /expected a number/],
    ['hexadecimal digits', '0x10*s', '/x', /"x10" is no name/],
    ['no number', ['nan*s', 'inf', 's'], '/x', /"nan" is no name/],
    ['a format', '%s%n', '/x', /expected a number/],
    ['an option', '--help', '/x', /"help" is no name/],
    ['an undefined letter', 'q*s', '/x', /"q" is no name/],
    ['four letters', 's*t*u*v', '', /a surface has two parameters/],
];

// --- equations beside the umbrella: the verdict and its reason ---

const UMBRELLA = { x: 's*t', y: 's', z: 't^2', s: [-1, 1], t: [-1, 1] };
const PROOFS = [
    ['a tower of powers', '((x^60)^60)^60', 'not checked', /the limit is 64 \(parametric_degree\)/],
    ['all terms of degree 64', '(1+x+2y+3z)^64+x', 'not checked', /too large: the equation has degree 64; the limit is 18 \(implicit_degree\)/],
    ['all terms of degree 18', '(1+x+2y+3z)^18+x', 'does not fit', /at the point/],
    ['terms that cancel', '(x^2-y^2)/(x-y)-x-y', 'does not fit', /holds everywhere/],
    ['a denominator that cancels', '1/((x+y)^2-x^2-2x*y-y^2)', 'not checked', /a denominator is 0 everywhere/],
    ['eighteen factors', `${Array.from({ length: 15 }, (_, i) => `(x+${i}y-z+${i})`).join('*')}*(x^2-y^2*z)`, 'does not fit', /is a product/],
    ['a surface of degree 63', 'x^18+y^9*z^9', 'does not fit', /at the point/, { ...UMBRELLA, x: '(1+s+t)^63', y: '(1+s-2t)^63' }],
];

// --- equations that are drawn: where in the text, and why not ---

const TEXTS = [
    ['a tower of numbers', 'x = 2^2^2^2^2^2^2', 11, /exponent \d+; the limit is 64 \(equation_exponent\)/],
    ['numbers that grow', 'x = 1000000^64', 1, /more than a number may be/],
    ['a division by 0', 'x = 1/0', 1, /a division by 0/],
    ['10^1000', 'x = 10^1000', 8, /exponent 1000; the limit is 64 \(equation_exponent\)/],
    ['deep nesting', nest(1000, '(', 'x', ')'), 65, /nested deeper than 64 levels \(equation_depth\)/],
    ['deep products', nest(1000, '2(', 'x', ')'), 129, /nested deeper than 64 levels \(equation_depth\)/],
    ['nothing varies', '1 = 2', 1, /holds everywhere or nowhere/],
    ['two relations', 'x < y < z', 7, /./],
    ['an undefined letter', 'x + j = 1', 5, /"j" is no name/],
];

let daemon;
let author;
let viewer;
let turn = 0;
before(async () => {
    daemon = await startDaemon();
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    await ask(daemon, 'POST', '/v1/scenes?id=hostile', {
        format: 'fieldcast/1',
        root: { id: 'it', type: 'implicit', params: { equation: 'x^2+y^2+z^2=1' } },
    });
    viewer = await Live.open(daemon, 'other');
    author = await Live.open(daemon, 'hostile');
    author.look();
    await author.nextFrame((frame) => frame.lossless);
});
after(async () => {
    await Promise.all([author?.close(), viewer?.close()]);
    await daemon?.stop();
});

const commandOf = (pid) => {
    try {
        return fs.readFileSync(`/proc/${pid}/cmdline`, 'utf8').split('\0')[0];
    } catch {
        return '';
    }
};
const algebraLeft = () => childrenOf(daemon.pid).filter((pid) => commandOf(pid).endsWith('fieldcast-algebra'));

/** The viewer of the other scene turns its camera, and sees it. */
async function seesFrame() {
    turn += 1;
    const seq = viewer.look({ camera: { position: [Math.sin(turn / 20), 1, 5] } });
    await viewer.nextFrame((frame) => frame.seq >= seq, Math.max(0, viewer.frames.length - 1));
}

async function post(path, body) {
    const asked = fetch(daemon.url + path, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify(body),
    });
    await seesFrame();
    const answer = await asked;
    assert.deepEqual(algebraLeft(), [], 'a process is left');
    return { status: answer.status, ...(await answer.json()) };
}

for (const [what, texts, place, why] of SURFACES) {
    test(`a surface: ${what}`, async () => {
        const [x, y, z] = Array.isArray(texts) ? texts : [texts, 't', 's'];
        const answer = await post('/v1/implicitize', { x, y, z });
        assert.equal(answer.status, 422, answer.detail);
        assert.equal(answer.place, place, answer.detail);
        assert.match(answer.detail, why);
    });
}

for (const [what, equation, verdict, why, parametric = UMBRELLA] of PROOFS) {
    test(`a proof: ${what}`, async () => {
        const answer = await post('/v1/verify', { equation, parametric });
        assert.equal(answer.status, 200, answer.detail);
        assert.equal(answer.verdict, verdict, answer.reason);
        assert.match(answer.reason, why);
    });
}

test('a proof: ranges that are reversed', async () => {
    const answer = await post('/v1/verify', { equation: 'x', parametric: { ...UMBRELLA, s: [1, -1] } });
    assert.equal(answer.status, 422);
    assert.equal(answer.place, '/parametric/s');
});

for (const [what, equation, column, why] of TEXTS) {
    test(`an equation that is drawn: ${what}`, async () => {
        const from = author.messages.length;
        author.set('/nodes/it/params/equation', equation);
        await seesFrame();
        const notice = await author.next('notice', { level: 'error' }, from);
        assert.equal(notice.place, '/nodes/it/params/equation');
        assert.equal(notice.line, 1);
        assert.equal(notice.column, column, notice.message);
        assert.match(notice.message, why);
        author.set('/nodes/it/params/equation', 'x^2+y^2+z^2=1');
        await author.next('notice', { level: 'info', code: 'compiled' }, from);
    });
}

/** A polynomial of degree 3 in both letters with all its terms. */
function everyTerm(first) {
    const powers = [0, 1, 2, 3].flatMap((i) => [0, 1, 2, 3].map((k) => `s^${i}*t^${k}`));
    return powers.map((power, i) => `${longNumber((first + i) % 12)}*${power}`).join('+');
}

test('a surface that takes too long: frames come until it is ended by its limit', async () => {
    let answered = false;
    const asked = fetch(`${daemon.url}/v1/implicitize`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify({ x: everyTerm(0), y: everyTerm(5), z: everyTerm(9) }),
    }).finally(() => (answered = true));
    await until(() => algebraLeft().length === 1, 'the process of the algebra');
    for (let i = 0; i < 20; i += 1) {
        await seesFrame();
    }
    assert.equal(answered, false, 'it was answered before: take a longer surface');
    const [pid] = algebraLeft();
    assert.match(fs.readFileSync(`/proc/${pid}/limits`, 'utf8'), /^Max cpu time +30 /m);
    execFileSync('prlimit', ['--pid', pid, '--cpu=2']); // its end comes sooner
    const answer = await asked;
    assert.equal(answer.status, 503);
    assert.match((await answer.json()).detail, /over 30 s of processor time \(algebra_seconds\)/);
    assert.deepEqual(algebraLeft(), []);
    await seesFrame();
});

test('none was left out', () => {
    assert.equal(SURFACES.length + PROOFS.length + TEXTS.length, 54);
});
