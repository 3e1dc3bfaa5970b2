// SPDX-License-Identifier: MIT
// Runs every suite and adds up their TAP. The last line is `N passed, N failed`. Suites run two at a
// time, but for those that bring a load of their own or look at what a process costs: they run alone.
//
//   node tests/run.mjs BUILD [WORD]...    BUILD: the folder with the program (build/asan); only
//                                         suites whose name holds one of the words
//
// A suite is a C program BUILD/tests/*/test_*, a script tests/*/{run,*.test}.{mjs,sh}, or the page's
// own tests (vitest). A suite fails as well when it prints no test, fewer than it planned, crashes, exits with a status
// that its results do not explain, hangs (support/patience.mjs), or leaves processes behind.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { groupOf, Patience } from './support/patience.mjs';
import { countTap } from './support/tap.mjs';

const IDLE_SECONDS = Number(process.env.TEST_IDLE_SECONDS ?? 300);
const BUSY_SECONDS = Number(process.env.TEST_BUSY_SECONDS ?? 1800);
const PATIENCE = {
    idleSeconds: IDLE_SECONDS,
    busySeconds: BUSY_SECONDS,
    periodMs: 1000 * Math.min(1, IDLE_SECONDS / 4),
};
const LEFT_IDLE_SECONDS = 4;
const LEFT_BUSY_SECONDS = 30;
const TICKS = 100; // of /proc, in a second
const LOG_LINES = 100; // shown of the end of a suite that failed
const REPORT_LINES = 30; // shown of each test that failed
const REPORTS = 5;
// The longest are not the last: nothing would run beside them.
const ORDER = ['unit', 'lint', 'cli', 'web', 'e2e', 'property', 'golden', 'api', 'kill', 'fault'];
const ALONE = ['api/hostile_load', 'kill/worker'];
const NOT_SUITES = ['bench', 'support', 'invalid'];

const root = path.dirname(path.dirname(new URL(import.meta.url).pathname));
const build = path.resolve(process.argv[2] ?? 'build/asan');
const words = process.argv.slice(3);

const environment = {
    ...process.env,
    FIELDCAST: path.join(build, 'fieldcast'),
    FIELDCAST_BUILD: build,
    CMOCKA_MESSAGE_OUTPUT: 'TAP',
    // Freed memory is held back a little only, so that tests may watch how a process grows. It is not
    // given back to the kernel, which would hand it out again page by page when a driver compiles more.
    // Looking for leaks reads the storage of threads, and now and then crashes over one that has just
    // ended; without this interceptor it does not know that of drivers.
    ASAN_OPTIONS: [
        'detect_leaks=1',
        'detect_stack_use_after_return=1',
        'quarantine_size_mb=8',
        'allocator_release_to_os_interval_ms=-1',
        'intercept_tls_get_addr=0',
    ].join(':'),
    UBSAN_OPTIONS: 'print_stacktrace=1:halt_on_error=1',
    LSAN_OPTIONS: `suppressions=${path.join(root, 'tests/support/lsan.supp')}:print_suppressions=0`,
    TSAN_OPTIONS: `suppressions=${path.join(root, 'tests/support/tsan.supp')}:atexit_sleep_ms=0`,
    // Nothing of the user's is read or written; compiled shaders are kept between runs.
    XDG_CONFIG_HOME: path.join(build, 'home/config'),
    XDG_DATA_HOME: path.join(build, 'home/data'),
    XDG_CACHE_HOME: path.join(build, 'home/cache'),
    // One cache for the program and for C tests, which ask the driver without it.
    FIELDCAST_CACHE: path.join(build, 'home/cache'),
    MESA_SHADER_CACHE_DIR: path.join(build, 'home/cache'),
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
    const patience = new Patience(() => groupOf(pid), { idleSeconds: LEFT_IDLE_SECONDS, busySeconds: LEFT_BUSY_SECONDS });
    while (groupLives(pid) && !patience.isOver()) {
        await sleep(50);
    }
    if (!groupLives(pid)) {
        return false;
    }
    process.kill(-pid, 'SIGKILL');
    return true;
}

// Pictures are the same without the optimizer of the software driver, which takes a third of the time
// that compiling takes. Users have it, and so have the golden pictures; and the suites that draw the
// same scenes, which so find their programs in the cache.
const OPTIMIZED = ['golden/test_golden', 'property/test_oracle', 'property/test_seen'];
const optimized = (suite) => OPTIMIZED.includes(suite.name);

// What costs much and finds nothing that other suites with the same code do not find. Numbers: they call
// the same few functions for minutes, and wait for compilers of drivers, whose freed memory fills what is
// held back of ours within a moment, of whatever size that is. Faults: hundreds of processes that live
// for a moment and copy each page that they touch.
const ASAN_OF_NUMBERS = ':detect_stack_use_after_return=0:quarantine_size_mb=1';
const ASAN_OF_KIND = {
    property: ASAN_OF_NUMBERS,
    golden: ASAN_OF_NUMBERS,
    fault: ':quarantine_size_mb=1:thread_local_quarantine_size_kb=64',
};
const asanOptions = (suite) => environment.ASAN_OPTIONS + (ASAN_OF_KIND[kindOf(suite)] ?? '');

// Of ThreadSanitizer. The render process can write below the cache alone, and is killed in the end.
const reportsOf = (suite) => path.join(environment.FIELDCAST_CACHE, `tsan-${suite.name.replace('/', '-')}`);

/** The texts of the reports of races in a suite and in what it started; removes their files. */
function takeReports(suite) {
    const folder = path.dirname(reportsOf(suite));
    const files = fs.readdirSync(folder).filter((name) => name.startsWith(`${path.basename(reportsOf(suite))}.`));
    return files.map((name) => {
        const file = path.join(folder, name);
        const text = fs.readFileSync(file, 'utf8');
        fs.unlinkSync(file);
        return text;
    });
}

const running = new Set();

/** Ends a suite that hangs, with all that it started. `onHung` is told why. */
function watch(pid, onHung) {
    const patience = new Patience(() => groupOf(pid), PATIENCE);
    const ask = () => {
        const reason = patience.isOver();
        if (reason) {
            clearInterval(timer);
            onHung(`hung, ${reason}, and was killed`, String(patience));
            for (const one of groupOf(pid)) {
                kill(one.pid);
            }
        }
    };
    // Words that wait in the pipe, because this process did not run, are read first.
    const timer = setInterval(() => setImmediate(ask), PATIENCE.periodMs);
    return { heard: () => patience.heard(), end: () => clearInterval(timer) };
}

function kill(pid) {
    try {
        process.kill(pid, 'SIGKILL');
    } catch {
        // It has ended meanwhile.
    }
}

let cpuBefore = 0;

/** Processor time of the children that ended since the last call, with theirs. */
function takeCpuSeconds() {
    const fields = fs.readFileSync('/proc/self/stat', 'utf8').split(') ').pop().split(' ').map(Number);
    const all = (fields[13] + fields[14]) / TICKS;
    const since = all - cpuBefore;
    cpuBefore = all;
    return since;
}

function execute(suite) {
    return new Promise((resolve) => {
        const [program, ...args] = suite.command;
        const child = spawn(program, args, {
            cwd: suite.cwd ?? root,
            env: {
                ...environment,
                ASAN_OPTIONS: asanOptions(suite),
                TSAN_OPTIONS: `${environment.TSAN_OPTIONS}:log_path=${reportsOf(suite)}`,
                ...(!optimized(suite) && { GALLIVM_PERF: 'nopt' }),
            },
            detached: true, // a process group of its own, so that all of it can be ended
            stdio: ['ignore', 'pipe', 'pipe'],
        });
        const chunks = { out: [], all: [] };
        let hung = null;
        child.on('error', (error) => resolve({ out: '', all: String(error), fault: String(error), cpu: 0 }));
        if (!child.pid) {
            return;
        }
        running.add(child.pid);
        const watched = watch(child.pid, (why, processes) => {
            hung = why;
            chunks.all.push(Buffer.from(`${processes}\n`));
        });
        child.stdout.on('data', (chunk) => watched.heard() || (chunks.out.push(chunk) && chunks.all.push(chunk)));
        child.stderr.on('data', (chunk) => watched.heard() || chunks.all.push(chunk));
        child.on('exit', async (status, signal) => {
            watched.end();
            const cpu = takeCpuSeconds();
            const left = !hung && (await endGroup(child.pid));
            const reports = takeReports(suite);
            running.delete(child.pid);
            resolve({
                out: Buffer.concat(chunks.out).toString(),
                all: Buffer.concat(chunks.all).toString() + reports.join(''),
                status,
                cpu,
                reports: reports.length,
                fault: hung ?? (signal ? `died of ${signal}` : left ? 'left processes behind' : null),
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
    if (outcome.reports > 0) {
        count.faults.push(`${outcome.reports} processes with data races`);
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
    const times = `${seconds.toFixed(1).padStart(6)} s ${outcome.cpu.toFixed(1).padStart(7)} s of CPU`;
    console.log(`${mark} ${suite.name.padEnd(28)} ${numbers.padEnd(24)} ${times}`);
    for (const skipped of count.skipped) {
        console.log(`       skipped: ${skipped}`);
    }
    for (const fault of count.faults) {
        console.log(`       ${fault}`);
    }
    if (count.failed > 0) {
        showLog(outcome.all.trimEnd().split('\n'));
    }
}

/** Why a daemon ended and the tests that failed first: whoever reads may see a part of this only. */
function showLog(lines) {
    const failed = lines.flatMap((line, at) => (/^ *not ok\b|^the daemon ended/.test(line) ? [at] : []));
    const print = (some) => console.log(some.map((line) => `     | ${line}`).join('\n'));
    for (const at of failed.slice(0, REPORTS)) {
        print(lines.slice(at, at + REPORT_LINES));
    }
    if (lines.length > LOG_LINES) {
        console.log(`       (the last ${LOG_LINES} of ${lines.length} lines)`);
    }
    print(lines.slice(-LOG_LINES));
}

for (const signal of ['SIGINT', 'SIGTERM']) {
    process.on(signal, () => {
        for (const pid of running) {
            process.kill(-pid, 'SIGKILL');
        }
        process.exit(130);
    });
}

// The driver makes no more than the last folder of the name.
fs.mkdirSync(environment.MESA_SHADER_CACHE_DIR, { recursive: true });
const logs = path.join(build, 'logs');
fs.mkdirSync(logs, { recursive: true });
const total = { passed: 0, failed: 0, cpu: 0 };
const failures = [];

async function runOne(suite) {
    const start = Date.now();
    const outcome = await execute(suite);
    fs.writeFileSync(path.join(logs, `${suite.name.replace('/', '-')}.log`), outcome.all);
    const count = judge(outcome);
    show(suite, count, outcome, (Date.now() - start) / 1000);
    total.passed += count.passed;
    total.failed += count.failed;
    total.cpu += outcome.cpu;
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
const together = suites.filter((suite) => !ALONE.includes(suite.name));
await Promise.all([runAll(together), runAll(together)]);
await runAll(suites.filter((suite) => ALONE.includes(suite.name)));
if (failures.length > 0) {
    console.log(`\nfailed: ${failures.join(', ')} (logs are in ${logs})`);
}
console.log(`${Math.round(total.cpu)} s of CPU`);
console.log(`${total.passed} passed, ${total.failed} failed`);
process.exitCode = total.failed > 0 || total.passed === 0 ? 1 : 0;
