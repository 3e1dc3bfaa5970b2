/* SPDX-License-Identifier: MIT */
/* Long requests take turns, so that a click never waits for the pictures of a page. */
type Task = (signal: AbortSignal) => Promise<void>;

interface Entry {
    task: Task;
    stopped: AbortController;
}

const AT_ONCE = 2;

const queue: Entry[] = [];
let running = 0;

function next(): void {
    const entry = running < AT_ONCE ? queue.shift() : undefined;
    if (!entry) {
        return;
    }
    running += 1;
    entry
        .task(entry.stopped.signal)
        .catch(() => undefined) /* stopped, or the server is away */
        .finally(() => {
            running -= 1;
            next();
        });
    next();
}

/* The same for what needs no turn. */
export function startNow(task: Task): () => void {
    const stopped = new AbortController();
    task(stopped.signal).catch(() => undefined);
    return () => stopped.abort();
}

/* Runs `task` when its turn comes; the function answered takes it out or stops it. */
export function takeTurn(task: Task): () => void {
    const entry = { task, stopped: new AbortController() };
    queue.push(entry);
    next();
    return () => {
        const at = queue.indexOf(entry);
        if (at >= 0) {
            queue.splice(at, 1);
        }
        entry.stopped.abort();
    };
}
