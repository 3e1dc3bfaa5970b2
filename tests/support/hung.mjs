// SPDX-License-Identifier: MIT
// What a process waits for that ought to have ended, as far as the kernel and gdb (if there) tell.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';

const STACK_LINES = 60;

function read(name) {
    try {
        return fs.readFileSync(name, 'utf8').trim();
    } catch {
        return ''; // it has ended, or the kernel does not tell
    }
}

/** Where a process writes its errors: what it starts has the same. Empty where it is gone. */
export function errorsOf(pid) {
    try {
        return fs.readlinkSync(`/proc/${pid}/fd/2`);
    } catch {
        return '';
    }
}

/** Processes that write their errors to `place`; none where it is empty. */
export const writersTo = (place) =>
    fs
        .readdirSync('/proc')
        .filter((pid) => /^\d+$/.test(pid) && place !== '' && errorsOf(pid) === place)
        .map(Number);

/** Tells what processes are at, and kills them. */
export function killAndDescribe(pids) {
    const text = pids.map(describeProcess).join('\n');
    for (const pid of pids) {
        try {
            process.kill(pid, 'SIGKILL');
        } catch {
            // It has ended meanwhile.
        }
    }
    return text;
}

function describeThread(pid, task) {
    const folder = `/proc/${pid}/task/${task}`;
    const [state, name] = ['State', 'Name'].map((member) =>
        new RegExp(`^${member}:\\s+(.*)`, 'm').exec(read(`${folder}/status`))?.[1],
    );
    const stack = read(`${folder}/stack`).replace(/^/gm, '      ');
    return `  ${task} ${name}: ${state}, in ${read(`${folder}/wchan`)}\n${stack}`;
}

function describeProcess(pid) {
    const command = read(`/proc/${pid}/cmdline`).replaceAll('\0', ' ');
    const threads = fs.existsSync(`/proc/${pid}/task`) ? fs.readdirSync(`/proc/${pid}/task`) : [];
    const gdb = spawnSync('gdb', ['-p', String(pid), '-batch', '-ex', 'thread apply all bt'], { encoding: 'utf8' });
    const stacks = (gdb.stdout ?? '').trim().split('\n').slice(-STACK_LINES);
    return [`${pid}: ${command}`, ...threads.map((task) => describeThread(pid, task)), ...stacks].join('\n');
}
