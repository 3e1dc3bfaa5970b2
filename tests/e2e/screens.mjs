// SPDX-License-Identifier: MIT
// Pictures of every panel, dialog and state of the page, in both themes and three widths, on one
// HTML page to look at, and what a machine finds wrong in each. No part of `make test`.
//
//   node tests/e2e/screens.mjs OUT [WORD]...   OUT: the folder for the pictures and index.html; only
//                                              states whose name holds one of the words
//   SCREENS_ALL=1    every state in all six variants, not in two
//   SCREENS_JOBS=2   pages at once
//
// The exit status is 1 when a state could not be reached, or something is wrong in one.
import fs from 'node:fs';
import path from 'node:path';
import { check } from './screens/checks.mjs';
import { writeIndex } from './screens/index.mjs';
import { openScreen } from './screens/screen.mjs';
import { STATES } from './screens/states.mjs';
import { openStage } from './stage.mjs';

const EXAMPLES = new URL('../../protocol/examples/', import.meta.url).pathname;
const [out = 'build/screens', ...words] = process.argv.slice(2);
const SIZES = [
    { width: 1440, height: 900 },
    { width: 1024, height: 700 },
    { width: 390, height: 844, touch: true },
];
const THEMES = ['dark', 'light'];
const JOBS = Number(process.env.SCREENS_JOBS ?? 2);

const nameOf = ({ theme, width }) => `${theme} ${width}`;
const variants = SIZES.flatMap((size) => THEMES.map((theme) => ({ ...size, theme })));

/** A state is taken in both themes, each in another width: over three states all six are seen. */
const PAIRS = [
    ['dark 1440', 'light 390'],
    ['light 1440', 'dark 1024'],
    ['light 1024', 'dark 390'],
];
function isTaken(i, variant) {
    if (STATES[i].narrow) {
        return variant.touch === true;
    }
    return process.env.SCREENS_ALL === '1' || PAIRS[i % PAIRS.length].includes(nameOf(variant));
}

/** What one page goes through after another; a state that is alone has a page of its own. */
function coursesOf(variant) {
    const courses = new Map();
    for (const [i, state] of STATES.entries()) {
        if (isTaken(i, variant) && (words.length === 0 || words.some((word) => state.name.includes(word)))) {
            const key = state.alone ? `${state.group} ${state.name}` : state.group;
            courses.set(key, [...(courses.get(key) ?? []), state]);
        }
    }
    return [...courses.values()].map((states) => ({ variant, states }));
}

async function take(page, state, variant) {
    const shot = { name: state.name, group: state.group, variant: nameOf(variant), found: [] };
    const file = `${state.name} ${nameOf(variant)}.png`.toLowerCase().replaceAll(/[^a-z0-9.]+/g, '-');
    try {
        await state.go(page);
        await page.quiet();
    } catch (error) {
        shot.found.push(`could not be reached: ${String(error).split('\n').slice(0, 3).join(' ')}`);
    }
    shot.file = file;
    await page.screenshot({ path: path.join(out, file) });
    shot.found.push(...(await check(page)));
    page.problems = [];
    console.log(`${shot.found.length === 0 ? 'ok' : 'NOT OK'}  ${shot.name}, ${shot.variant}`);
    shot.found.forEach((line) => console.log(`        ${line}`));
    return shot;
}

const failed = (state, variant, error) => {
    console.log(`NOT OK  ${state.name}, ${nameOf(variant)}: no page: ${error}`);
    process.exitCode = 1;
    return null;
};

async function walk(stage, { variant, states }) {
    const shots = [];
    let page = null;
    for (const state of states) {
        page ??= await openScreen(stage, state, variant).catch((error) => failed(state, variant, error));
        if (page === null) {
            continue;
        }
        const shot = await take(page, state, variant);
        shots.push(shot);
        const left = await page.rest(state).then(() => true, () => false);
        if (!left || shot.found.some((line) => line.startsWith('could not'))) {
            await page.context().close();
            page = null;
        }
    }
    await page?.context().close();
    return shots;
}

fs.mkdirSync(out, { recursive: true });
const stage = await openStage({ whole: true });
for (const name of ['still-life', 'robot', 'lighthouse']) {
    await stage.scene(JSON.parse(fs.readFileSync(path.join(EXAMPLES, `${name}.json`), 'utf8')));
}
/* Waits are for the browser to end. */
const alive = setInterval(stage.heard, 1000);
const courses = variants.flatMap(coursesOf);
const shots = [];
await Promise.all(
    Array.from({ length: JOBS }, async () => {
        for (let course = courses.shift(); course; course = courses.shift()) {
            shots.push(...(await walk(stage, course)));
        }
    }),
);
clearInterval(alive);
await stage.close();
writeIndex(out, shots, STATES.map(({ name }) => name));
const wrong = shots.filter(({ found }) => found.length > 0);
console.log(`${shots.length} pictures, ${wrong.length} with something wrong: ${path.join(out, 'index.html')}`);
process.exitCode ||= wrong.length > 0 ? 1 : 0;
