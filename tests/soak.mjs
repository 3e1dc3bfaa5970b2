// SPDX-License-Identifier: MIT
// Runs suites again and again on a machine that is busy with other things, for races. No part of
// `make test`.
//
//   node tests/soak.mjs BUILD ROUNDS LOOPS WORD...   BUILD: the folder with the program (build/asan);
//                                                    suites whose name holds one of the words, ROUNDS
//                                                    times, beside LOOPS busy loops
//
// The last lines say for each suite how many rounds it ran and how many failed; what a failed one
// printed is in BUILD/soak/.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const [build, rounds, loopCount, ...words] = process.argv.slice(2);
if (words.length === 0) {
    console.error('usage: node tests/soak.mjs BUILD ROUNDS LOOPS WORD...');
    process.exit(2);
}
const runner = path.join(path.dirname(new URL(import.meta.url).pathname), 'run.mjs');
const out = path.join(build, 'soak');
fs.mkdirSync(out, { recursive: true });

// Sessions of their own: the kernel may share the processors between sessions (autogroups), and
// eight loops in one session are then felt like one.
const loops = Array.from({ length: Number(loopCount) }, () =>
    spawn('sh', ['-c', 'while :; do :; done'], { stdio: 'ignore', detached: true }),
);
let round = null; // the runner's process
const end = () => {
    loops.forEach((loop) => loop.kill('SIGKILL'));
    round?.kill('SIGTERM');
};
process.on('exit', end);
for (const signal of ['SIGINT', 'SIGTERM']) {
    process.on(signal, () => process.exit(130));
}

const tally = new Map(); // suite: rounds, failures

function count(line, number, text) {
    const [, mark, suite] = /^(ok|FAIL) +(\S+)/.exec(line) ?? [];
    if (!suite) {
        return;
    }
    const sum = tally.get(suite) ?? { rounds: 0, failed: 0 };
    sum.rounds += 1;
    sum.failed += mark === 'FAIL' ? 1 : 0;
    tally.set(suite, sum);
    if (mark === 'FAIL') {
        fs.writeFileSync(path.join(out, `${suite.replace('/', '-')}-${number}.log`), text);
    }
}

function runOnce() {
    round = spawn(process.execPath, [runner, build, ...words], { stdio: ['ignore', 'pipe', 'inherit'] });
    let text = '';
    round.stdout.on('data', (chunk) => (text += chunk));
    return new Promise((done) => round.on('close', () => done(text)));
}

for (let number = 1; number <= Number(rounds); number += 1) {
    const text = await runOnce();
    for (const line of text.split('\n')) {
        count(line, number, text);
    }
    console.log(`round ${number}: ${text.trimEnd().split('\n').pop()}`);
}
for (const [suite, sum] of tally) {
    console.log(`${suite.padEnd(28)} ${sum.rounds} rounds, ${sum.failed} failed`);
    process.exitCode = sum.failed > 0 ? 1 : process.exitCode;
}
end();
