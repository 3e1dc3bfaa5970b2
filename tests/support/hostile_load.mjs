// SPDX-License-Identifier: MIT
// Texts of code, hostile and honest, on a machine that is busy with other things, while a viewer of
// another scene moves: what each author is told, and how long the viewer waits.
import { spawn } from 'node:child_process';
import { ask, counter, cpuSecondsOfAll, sleep, startDaemon, until } from './daemon.mjs';
import { goBack, openAuthor, placeOf, verdictOf } from './hostile_author.mjs';
import { Live } from './live.mjs';

const LOOPS = 8;
const EVERY_MS = 40;
const VIEW = { width: 128, height: 96 };

/** Processes that use as much of the processors as they get; returns how to end them. */
export function busyLoops(count) {
    const loops = Array.from({ length: count }, () => spawn('sh', ['-c', 'while :; do :; done'], { stdio: 'ignore' }));
    const end = () => loops.forEach((loop) => loop.kill('SIGKILL'));
    process.on('exit', end);
    return end;
}

/**
 * A viewer who looks elsewhere all the time. `pauses`: between two pictures of newer and newer views,
 * milliseconds, and seconds of the processors that the daemon used meanwhile.
 */
async function watch(daemon, scene) {
    const live = await Live.open(daemon, scene);
    const pauses = [];
    let going = true;
    let last = null;
    live.onFrame = (frame) => {
        const now = { at: frame.at, spent: cpuSecondsOfAll(daemon), seq: frame.seq };
        if (last && frame.seq > last.seq) {
            pauses.push({ ms: now.at - last.at, cpu: now.spent - last.spent });
        }
        last = last && frame.seq <= last.seq ? last : now;
        live.frames.length = 0;
    };
    const done = (async () => {
        for (let i = 0; going; i += 1) {
            live.look({ ...VIEW, camera: { position: [5 * Math.sin(i / 20), 1, 5 * Math.cos(i / 20)] } });
            await sleep(EVERY_MS);
        }
    })();
    await until(() => last, 'a picture of the viewer');
    return {
        live,
        pauses,
        async stop() {
            going = false;
            await done;
            await live.close();
        },
    };
}

/**
 * Sends the texts beside busy loops. `wrong`: those that were told otherwise than `verdict` says;
 * `pauses`: of the viewer, `alone` beside the loops only and `beside` the texts; `restarts`: workers
 * that ended; `dead`: the daemon has.
 */
export async function hostileLoad(texts, { options = {}, whole = false, loops = LOOPS, aloneMs = 5000, tell = () => {} } = {}) {
    const daemon = await startDaemon(options);
    await ask(daemon, 'POST', '/v1/scenes?id=other', { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } });
    const author = await openAuthor(daemon, 'hostile');
    const endLoops = busyLoops(loops);
    const viewer = await watch(daemon, 'other');
    const wrong = [];
    await sleep(aloneMs);
    const alone = viewer.pauses.splice(0);
    for (const [i, { name, code, verdict }] of texts.entries()) {
        const { refused } = await verdictOf(author, code, { whole });
        if ((refused ? 'refused' : 'drawn') !== verdict) {
            wrong.push({ name, verdict, told: refused && { code: refused.code, message: refused.message } });
        }
        if (refused?.type === 'notice' && refused.place === placeOf(code)) {
            await goBack(author, refused.place);
        }
        tell(i, name);
        author.frames.length = author.messages.length = 0;
    }
    const beside = viewer.pauses.splice(0);
    const dead = viewer.live.closed || author.closed;
    const restarts = await counter(daemon, 'worker_restarts_total');
    endLoops();
    await viewer.stop();
    await author.close();
    await daemon.stop();
    return { wrong, alone, beside, restarts, dead };
}
