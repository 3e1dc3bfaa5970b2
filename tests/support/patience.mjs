// SPDX-License-Identifier: MIT
// Tells what hangs from what is slow, by what processes do and not by the clock. A hang is silent and
// uses (almost) no processor for a long time, or uses very much of it without a word. Who waits for
// the processor or for a disk is slow.
import fs from 'node:fs';

const TICKS = 100; // of /proc, in a second
const IDLE_RATE = 0.2; // below this part of a processor a process only waits and asks
const PAID_BACK = 5; // idle seconds that a busy one makes good

/** What /proc tells of all processes: pid, parent, group, name, state, processor time in seconds. */
function readProcesses() {
    const processes = [];
    for (const pid of fs.readdirSync('/proc')) {
        if (/^\d+$/.test(pid)) {
            try {
                const text = fs.readFileSync(`/proc/${pid}/stat`, 'utf8');
                const name = text.slice(text.indexOf('(') + 1, text.lastIndexOf(')'));
                const [state, ...fields] = text.slice(text.lastIndexOf(')') + 2).split(' ');
                const numbers = fields.map(Number);
                const seconds = (numbers[10] + numbers[11] + numbers[12] + numbers[13]) / TICKS;
                processes.push({ pid: Number(pid), parent: numbers[0], group: numbers[1], name, state, seconds });
            } catch {
                // It has ended meanwhile.
            }
        }
    }
    return processes;
}

/** A process group with all that its members started, in whatever groups. */
export function groupOf(leader) {
    return withDescendants((one) => one.group === leader);
}

/** What a process started, without itself. */
export function descendantsOf(pid) {
    return withDescendants((one) => one.parent === pid && one.pid !== pid);
}

function withDescendants(isRoot) {
    const all = readProcesses();
    const found = new Map(all.filter(isRoot).map((one) => [one.pid, one]));
    for (let before = -1; before < found.size; ) {
        before = found.size;
        for (const one of all) {
            if (found.has(one.parent)) {
                found.set(one.pid, one);
            }
        }
    }
    return [...found.values()];
}

/** Whether a thread of it waits for the processor or for a disk. */
function isHeldUp(pid) {
    try {
        return fs.readdirSync(`/proc/${pid}/task`).some((task) => {
            const text = fs.readFileSync(`/proc/${pid}/task/${task}/stat`, 'utf8');
            return /^[RD]/.test(text.slice(text.lastIndexOf(')') + 2));
        });
    } catch {
        return false;
    }
}

/**
 * Patience with the processes that `list` gives. Ask isOver() about every `periodMs`; a pause of the
 * whole machine counts as one period.
 */
export class Patience {
    constructor(list, { idleSeconds, busySeconds, periodMs = 1000 }) {
        Object.assign(this, { list, idleSeconds, busySeconds, periodMs });
        this.last = { at: Date.now(), seconds: this.spent() };
        this.heard();
    }

    spent() {
        this.processes = this.list();
        return this.processes.reduce((sum, one) => sum + one.seconds, 0);
    }

    /** There is a sign of life. What was used before it, since the last isOver(), was not silent. */
    heard() {
        this.isHeard = true;
        this.idle = 0;
        this.busy = 0;
    }

    /** False, or why nothing more is to be expected. */
    isOver() {
        const at = Date.now();
        const elapsed = (at - this.last.at) / 1000;
        if (elapsed * 1000 < this.periodMs) {
            return false;
        }
        const seconds = this.spent();
        const used = Math.max(0, seconds - this.last.seconds);
        const counted = Math.min(elapsed, (2 * this.periodMs) / 1000);
        this.last = { at, seconds };
        if (this.isHeard) {
            this.isHeard = false;
            return false;
        }
        this.busy += used;
        if (used >= IDLE_RATE * elapsed) {
            this.idle = Math.max(0, this.idle - PAID_BACK * counted);
        } else if (!this.processes.some((one) => isHeldUp(one.pid))) {
            this.idle += counted;
        }
        return this.verdict();
    }

    verdict() {
        if (this.idle >= this.idleSeconds) {
            return `silent and idle for ${this.idleSeconds} s`;
        }
        return this.busy >= this.busySeconds && `silent for ${this.busySeconds} s of processor time`;
    }

    /** The processes, one a line. */
    toString() {
        return this.processes
            .map(({ pid, name, state, seconds }) => `${pid} ${name} ${state}, ${seconds.toFixed(1)} s of CPU`)
            .join('\n');
    }
}
