// SPDX-License-Identifier: MIT
// Starts and ends `fieldcast serve` for a test, in a directory of its own; waits for what it does.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { errorsOf, killAndDescribe, writersTo } from './hung.mjs';
import { descendantsOf, Patience } from './patience.mjs';

const root = path.dirname(path.dirname(path.dirname(new URL(import.meta.url).pathname)));
export const program = process.env.FIELDCAST ?? path.join(root, 'build/release/fieldcast');

export const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

const IDLE_SECONDS = 60;
const BUSY_SECONDS = 900;
const ASK_MS = 10;
const ASK_LATER_MS = 50;
const LATER_MS = 2000;

let news = 0;

/** Something was received: who waits goes on waiting. */
export const heard = () => (news += 1);

/**
 * Asks until the answer is true, or the daemon and whatever else this process started hang. Half of the
 * time is left to those who work for it.
 */
export async function until(question, what) {
    const start = Date.now();
    let patience = null;
    for (let known = news; ; ) {
        const asked = Date.now();
        const answer = await question();
        const took = Date.now() - asked;
        if (answer) {
            return answer;
        }
        if (Date.now() - start > LATER_MS) {
            patience ??= new Patience(() => descendantsOf(process.pid), {
                idleSeconds: IDLE_SECONDS,
                busySeconds: BUSY_SECONDS,
            });
            if (news !== known) {
                known = news;
                patience.heard();
            }
            const reason = patience.isOver();
            if (reason) {
                throw new Error(`waited in vain for ${what}: ${reason}\n${patience}`);
            }
        }
        await sleep(Math.max(took, patience ? ASK_LATER_MS : ASK_MS));
    }
}

export const makeDirectory = () => fs.mkdtempSync(path.join(os.tmpdir(), 'fieldcast-test-'));
export const removeDirectory = (name) => fs.rmSync(name, { recursive: true, force: true });

const textOf = (name) => {
    try {
        return fs.readFileSync(name, 'utf8');
    } catch {
        return ''; // whoever it was has ended
    }
};

/** Child processes of a process. */
export const childrenOf = (pid) =>
    fs
        .readdirSync(`/proc/${pid}/task`)
        .flatMap((task) => textOf(`/proc/${pid}/task/${task}/children`).split(' '))
        .filter(Boolean)
        .map(Number);

export const memoryOf = (pid) =>
    Number(/VmRSS:\s+(\d+)/.exec(fs.readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) * 1024;

/** Seconds of processor time that a process has used. */
export function cpuSecondsOf(pid) {
    const fields = fs.readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
    return (Number(fields[11]) + Number(fields[12])) / 100;
}

/** The same of a daemon, with what it started, also where that has ended. */
export const cpuSecondsOfAll = (daemon) =>
    [daemon.pid, ...childrenOf(daemon.pid)]
        .map((pid) => textOf(`/proc/${pid}/stat`).split(') ')[1]?.split(' ') ?? [])
        .reduce((sum, fields) => sum + fields.slice(11, 15).reduce((all, ticks) => all + Number(ticks) / 100, 0), 0);

const statesOf = (pid) =>
    fs.readdirSync(`/proc/${pid}/task`).map((task) => textOf(`/proc/${pid}/task/${task}/stat`).split(') ')[1]?.[0]);

/** Stops a process, and waits for each of its threads to stand: they go on until one of them has seen the signal. */
export async function standStill(pid) {
    process.kill(pid, 'SIGSTOP');
    await until(() => statesOf(pid).every((state) => state === 'T'), `process ${pid} to stand still`);
}

/** The linker would go on without one that is missing. */
function driverFile(name) {
    const file = path.join(path.dirname(program), `tests/support/drivers/${name}_driver.so`);
    fs.accessSync(file);
    return file;
}

/** What a program needs in its environment to have drivers in front of its own (support/drivers). */
export const driverEnvironment = (...names) => ({
    LD_PRELOAD: names.map(driverFile).join(' '),
    FIELDCAST_STAGE: 'compute', // else they have nothing to draw
    ASAN_OPTIONS: `${process.env.ASAN_OPTIONS ?? ''}:verify_asan_link_order=0`,
});

/** Waits for the log to say it: its bytes are on their way when what they tell of has happened. */
export const logged = (daemon, pattern) => until(() => pattern.test(daemon.errors), `${pattern} in the log`);

/** Waits for the end of a daemon; where it does not come, all who write to `errors` are told and killed. */
async function untilEnded(ended, errors, what) {
    try {
        await until(ended, what);
    } catch (error) {
        error.message += `\n${killAndDescribe(writersTo(errors))}`;
        throw error;
    }
}

const LAST_WORDS = 6000; // characters of its log, shown where it ended by itself

/**
 * Resolves when the daemon listens. `ready: true` waits for the render process too. The data
 * directory is a fresh one, removed by stop(), unless one is given. `driver: 'null'` draws nothing
 * that anybody could look at, at once or with `tileMs` for each tile; several are loaded in front of
 * each other. stop(status = 0) throws where the daemon ended with another status, unless the test
 * killed it.
 */
export async function startDaemon(options = {}) {
    const { data, args = [], ready = true, limits = '', driver = [], tileMs = 0, environment = {} } = options;
    const directory = data ?? makeDirectory();
    const all = ['serve', '--port', '0', '--data', directory, ...args];
    const drivers = [driver].flat();
    const env = {
        ...process.env,
        ...(drivers.length > 0 && driverEnvironment(...drivers)),
        NULL_DRIVER_TILE_MS: String(tileMs),
        ...environment,
    };
    // AddressSanitizer would keep freed memory for a while, and with it what tests measure.
    env.ASAN_OPTIONS = `${env.ASAN_OPTIONS ?? ''}:quarantine_size_mb=1`;
    const child = limits
        ? spawn('sh', ['-c', `${limits}; exec "$0" "$@"`, program, ...all], { env })
        : spawn(program, all, { env });
    const daemon = { child, data: directory, errors: '', output: '' };
    child.stderr.on('data', (bytes) => heard() && (daemon.errors += bytes));
    child.stdout.on('data', (bytes) => heard() && (daemon.output += bytes));
    let gone = false;
    let asked = null; // the signal by which the test ended it
    let closed = false; // nobody holds its pipes any more
    daemon.exited = new Promise((done) =>
        child.on('exit', (status, signal) => {
            gone = true;
            done({ status, signal });
        }),
    );
    child.on('close', (status, signal) => {
        closed = true;
        if (!asked) {
            console.log(`the daemon ended with ${status ?? signal}:\n${daemon.errors.slice(-LAST_WORDS)}`);
        }
    });
    child.on('error', (error) => {
        gone = closed = true;
        daemon.errors += error;
    });
    const match = await until(() => {
        if (gone) {
            throw new Error(`the daemon ended:\n${daemon.errors}`);
        }
        return /listening on (http:\/\/\S+:(\d+)\/)/.exec(daemon.output);
    }, 'the daemon to listen');
    daemon.url = match[1].slice(0, -1);
    daemon.port = Number(match[2]);
    daemon.pid = child.pid;
    const errors = errorsOf(daemon.pid);
    daemon.worker = () => childrenOf(daemon.pid)[0];
    daemon.kill = async (signal = 'SIGKILL') => {
        asked = signal;
        child.kill(signal);
        await untilEnded(() => gone, errors, `the daemon to end after ${signal}`);
        return daemon.exited;
    };
    daemon.stop = async (expected = 0) => {
        const result = gone ? await daemon.exited : await daemon.kill('SIGTERM');
        await untilEnded(() => closed, errors, 'what the daemon started to end');
        if (!data) {
            removeDirectory(directory);
        }
        if (asked !== 'SIGKILL' && result.status !== expected) {
            throw new Error(`the daemon ended with ${result.status ?? result.signal}:\n${daemon.errors}`);
        }
        return result;
    };
    if (ready) {
        await until(async () => (await fetch(`${daemon.url}/readyz`)).ok, 'the render process');
    }
    return daemon;
}

/** JSON over HTTP; throws where the status is no success. */
export async function ask(daemon, method, at, body, headers = {}) {
    const answer = await fetch(daemon.url + at, {
        method,
        headers: body === undefined ? headers : { 'content-type': 'application/json', ...headers },
        body: body === undefined ? undefined : JSON.stringify(body),
    });
    const text = await answer.text();
    if (!answer.ok) {
        throw new Error(`${method} ${at}: ${answer.status} ${text}`);
    }
    return text ? JSON.parse(text) : null;
}

export async function counter(daemon, name) {
    const text = await (await fetch(`${daemon.url}/metrics`)).text();
    return Number(new RegExp(`^fieldcast_${name} (\\S+)$`, 'm').exec(text)[1]);
}
