// SPDX-License-Identifier: MIT
// Runs every suite and adds up their TAP. The last line is `N passed, N failed`. Suites that ask a
// process of their own, and nobody else, run two at a time; others run alone.
//
//   node tests/run.mjs BUILD [WORD]...    BUILD: the folder with the program (build/asan); only
//                                         suites whose name holds one of the words
//
// A suite is a C program BUILD/tests/*/test_*, a script tests/*/{run,*.test}.{mjs,sh}, or the page's
// own tests (vitest). A suite fails as well when it prints no test, fewer than it planned, crashes, exits with a status
// that its results do not explain, hangs, or leaves processes behind.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { countTap } from './support/tap.mjs';

const HANG_MS = 20 * 60 * 1000; // no suite takes a tenth of it; this only ends a run that hangs
const LOG_LINES = 200; // shown of a suite that failed
const ORDER = ['unit', 'lint', 'cli', 'web', 'property', 'golden', 'api', 'kill', 'e2e'];
const SIDE_BY_SIDE = ['unit', 'lint', 'web', 'property', 'golden'];
const NOT_SUITES = ['bench', 'support', 'bad'];

const root = path.dirname(path.dirname(new URL(import.meta.url).pathname));
const build = path.resolve(process.argv[2] ?? 'build/asan');
const words = process.argv.slice(3);

const environment = {
    ...process.env,
    FIELDCAST: path.join(build, 'fieldcast'),
    FIELDCAST_BUILD: build,
    CMOCKA_MESSAGE_OUTPUT: 'TAP',
    // Freed memory is held back a little only, so that tests may watch how a process grows.
    // Looking for leaks reads the storage of threads, and now and then crashes over one that has just
    // ended; without this interceptor it does not know that of drivers.
    ASAN_OPTIONS:
        'detect_leaks=1:detect_stack_use_after_return=1:quarantine_size_mb=8:intercept_tls_get_addr=0',
    UBSAN_OPTIONS: 'print_stacktrace=1:halt_on_error=1',
    LSAN_OPTIONS: `suppressions=${path.join(root, 'tests/support/lsan.supp')}:print_suppressions=0`,
    // Nothing of the user's is read or written; compiled shaders are kept between runs.
    XDG_CONFIG_HOME: path.join(build, 'home/config'),
    XDG_DATA_HOME: path.join(build, 'home/data'),
    XDG_CACHE_HOME: path.join(build, 'home/cache'),
};

const kindOf = (suite) => suite.name.split('/')[0];

function findSuites() {
    const suites = [];
    for (const kind of fs.readdirSync(path.join(root, 'tests')).sort()) {
        const folder = path.join(root, 'tests', kind);
        if (NOT_SUITES.includes(kind) || !fs.statSync(folder).isDirectory()) {
            continue;
        }
        for (const file of fs.readdirSync(folder).sort()) {
            const name = `${kind}/${file.replace(/(\.test)?\.(c|mjs|sh)$/, '')}`;
            if (/^test_.*\.c$/.test(file)) {
                suites.push({ name, command: [path.join(build, 'tests', name)] });
            } else if (/^(run|.*\.test)\.mjs$/.test(file)) {
                suites.push({
                    name,
                    command: [process.execPath, '--test-reporter=tap', path.join(folder, file)],
                });
            } else if (/^(run|.*\.test)\.sh$/.test(file)) {
                suites.push({ name, command: ['sh', path.join(folder, file)] });
            }
        }
    }
    const web = path.join(root, 'web');
    if (fs.existsSync(path.join(web, 'package.json'))) {
        suites.push({ name: 'web/vitest', command: ['npm', 'run', '--silent', 'test'], cwd: web });
    }
    const rank = (suite) => {
        const at = ORDER.indexOf(kindOf(suite));
        return at < 0 ? ORDER.length : at;
    };
    return suites
        .filter((suite) => words.length === 0 || words.some((word) => suite.name.includes(word)))
        .sort((a, b) => rank(a) - rank(b));
}

function groupLives(pid) {
    try {
        process.kill(-pid, 0);
        return true;
    } catch {
        return false;
    }
}

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

// Processes of the suite get a while to end by themselves (a browser's helpers do), then are killed.
async function endGroup(pid) {
    for (let waited = 0; waited < 10000 && groupLives(pid); waited += 100) {
        await sleep(100);
    }
    if (!groupLives(pid)) {
        return false;
    }
    process.kill(-pid, 'SIGKILL');
    return true;
}

const running = new Set();

function execute(suite) {
    return new Promise((resolve) => {
        const [program, ...args] = suite.command;
        const child = spawn(program, args, {
            cwd: suite.cwd ?? root,
            env: environment,
            detached: true, // a process group of its own, so that all of it can be ended
            stdio: ['ignore', 'pipe', 'pipe'],
        });
        const chunks = { out: [], all: [] };
        let hung = false;
        running.add(child.pid);
        const timer = setTimeout(() => {
            hung = true;
            process.kill(-child.pid, 'SIGKILL');
        }, HANG_MS);
        child.stdout.on('data', (chunk) => chunks.out.push(chunk) && chunks.all.push(chunk));
        child.stderr.on('data', (chunk) => chunks.all.push(chunk));
        child.on('error', (error) => resolve({ out: '', all: String(error), fault: String(error) }));
        child.on('exit', async (status, signal) => {
            clearTimeout(timer);
            const left = !hung && (await endGroup(child.pid));
            running.delete(child.pid);
            resolve({
                out: Buffer.concat(chunks.out).toString(),
                all: Buffer.concat(chunks.all).toString(),
                status,
                fault: hung
                    ? 'hung and was killed'
                    : signal
                      ? `died of ${signal}`
                      : left
                        ? 'left processes behind'
                        : null,
            });
        });
    });
}

function judge(outcome) {
    const count = countTap(outcome.out);
    if (outcome.fault) {
        count.faults.push(outcome.fault);
    } else if (outcome.status !== 0 && count.failed === 0) {
        count.faults.push(`exited with status ${outcome.status} without a failed test`);
    }
    if (count.passed + count.failed + count.skipped.length === 0) {
        count.faults.push('printed no test');
    }
    count.failed += count.faults.length;
    return count;
}

function show(suite, count, outcome, seconds) {
    const mark = count.failed > 0 ? 'FAIL' : 'ok  ';
    const numbers = `${count.passed} passed${count.failed ? `, ${count.failed} failed` : ''}`;
    console.log(`${mark} ${suite.name.padEnd(28)} ${numbers.padEnd(24)} ${seconds.toFixed(1)} s`);
    for (const skipped of count.skipped) {
        console.log(`       skipped: ${skipped}`);
    }
    for (const fault of count.faults) {
        console.log(`       ${fault}`);
    }
    if (count.failed > 0) {
        const lines = outcome.all.trimEnd().split('\n');
        if (lines.length > LOG_LINES) {
            console.log(`       (the last ${LOG_LINES} of ${lines.length} lines)`);
        }
        console.log(lines.slice(-LOG_LINES).map((line) => `     | ${line}`).join('\n'));
    }
}

for (const signal of ['SIGINT', 'SIGTERM']) {
    process.on(signal, () => {
        for (const pid of running) {
            process.kill(-pid, 'SIGKILL');
        }
        process.exit(130);
    });
}

const logs = path.join(build, 'logs');
fs.mkdirSync(logs, { recursive: true });
const total = { passed: 0, failed: 0 };
const failures = [];

async function runOne(suite) {
    const start = Date.now();
    const outcome = await execute(suite);
    fs.writeFileSync(path.join(logs, `${suite.name.replace('/', '-')}.log`), outcome.all);
    const count = judge(outcome);
    show(suite, count, outcome, (Date.now() - start) / 1000);
    total.passed += count.passed;
    total.failed += count.failed;
    if (count.failed > 0) {
        failures.push(suite.name);
    }
}

async function runAll(suites) {
    for (let suite = suites.shift(); suite; suite = suites.shift()) {
        await runOne(suite);
    }
}

const suites = findSuites();
const together = suites.filter((suite) => SIDE_BY_SIDE.includes(kindOf(suite)));
await Promise.all([runAll(together), runAll(together)]);
await runAll(suites.filter((suite) => !SIDE_BY_SIDE.includes(kindOf(suite))));
if (failures.length > 0) {
    console.log(`\nfailed: ${failures.join(', ')} (logs are in ${logs})`);
}
console.log(`${total.passed} passed, ${total.failed} failed`);
process.exitCode = total.failed > 0 || total.passed === 0 ? 1 : 0;
