// SPDX-License-Identifier: MIT
// One kind of guest of guests.mjs, in a process of its own, as clients elsewhere are: the viewer that
// is measured shares no event loop with it, and its processor time counts last.
//
//   node tests/bench/guest.mjs PORT NAME     it comes, and leaves at the end of the standard input
import net from 'node:net';
import os from 'node:os';
import { fileURLToPath } from 'node:url';
import { sleep } from '../support/daemon.mjs';
import { largeDocument } from '../support/large.mjs';
import { handshake, Live } from '../support/live.mjs';
import { blankPng, withText } from '../support/png.mjs';
import { EVERY_MS, place, VIEW } from './moving.mjs';

const LARGE = { width: 4096, height: 4096 };
const FLOOD = 20; // messages at a time

const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

/** Does something again and again until it is told to stop. */
function repeat(act) {
    let going = true;
    const done = (async () => {
        for (let i = 0; going; i += 1) {
            await act(i, () => !going);
        }
    })();
    return () => {
        going = false;
        return done;
    };
}

/** A viewer that looks from everywhere; those that read ask for the next picture when one is there. */
async function viewer(daemon, scene, view, { reads = true } = {}) {
    const live = await Live.open(daemon, scene, { ack: reads });
    const stop = repeat(async (i) => {
        live.look({ ...view, ...place(i) });
        await sleep(EVERY_MS);
        live.frames.splice(0, Math.max(0, live.frames.length - 2));
    });
    if (!reads) {
        live.stopReading();
    }
    return async () => {
        await stop();
        live.socket.destroy();
    };
}

const several = async (count, make) => {
    const all = await Promise.all(Array.from({ length: count }, (_, i) => make(i)));
    return () => Promise.all(all.map((stop) => stop()));
};

const picture = (daemon, body) =>
    fetch(`${daemon.url}/v1/render`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) })
        .then((answer) => answer.arrayBuffer())
        .catch(() => null);

export const GUESTS = {
    'ten viewers that never read': (daemon) => several(10, () => viewer(daemon, 'other', { width: 1024, height: 768 }, { reads: false })),
    'fifty viewers that never read': (daemon) => several(50, () => viewer(daemon, 'other', { width: 1024, height: 768 }, { reads: false })),
    'ten viewers that read': (daemon) => several(10, () => viewer(daemon, 'other', VIEW)),
    'a view of 4096 by 4096': (daemon) => viewer(daemon, 'other', LARGE),
    'twenty pictures of 16384 by 16384': (daemon) => {
        const gone = new AbortController();
        const all = Array.from({ length: 20 }, (_, i) =>
            fetch(`${daemon.url}/v1/scenes/other/image.png?width=16384&height=16384&camera.fov=${20 + i}`, { signal: gone.signal }).catch(() => null),
        );
        return () => gone.abort() || Promise.all(all);
    },
    'large pictures of zeros': async (daemon) => {
        const png = blankPng(8192, 4096);
        return repeat(async (i) => {
            const body = withText(png, `${process.pid} ${performance.now()} ${i}`); // it is read anew
            const posted = await fetch(`${daemon.url}/v1/assets`, { method: 'POST', body, headers: { 'content-type': 'image/png' } });
            const { id } = await posted.json();
            await picture(daemon, { scene: { ...ball, environment: { type: 'image', image: id } }, width: 16, height: 16 });
        });
    },
    'code that is new each time': (daemon) =>
        repeat((i) =>
            picture(daemon, {
                scene: { format: 'fieldcast/1', root: { id: 'a', type: 'field', params: { code: `float sdf(vec3 p) { float a = p.x; for (int i = 0; i < 40; i++) { a = sin(a + ${i}.0); } return length(p) - 0.5 - 0.001 * a; }` } } },
                width: 16,
                height: 16,
            }),
        ),
    'edits of 5,500 operations': async (daemon) => {
        const live = await Live.open(daemon, 'many');
        const ops = Array.from({ length: 5500 }, (_, i) => ({ op: 'set', at: `/nodes/n${i}/params/radius`, value: 0.5 }));
        const stop = repeat(async () => {
            const edit = live.change(ops);
            await live.next('applied', { edit });
            live.messages.length = 0;
        });
        return async () => {
            await stop();
            await live.close();
        };
    },
    'a flood of views': async (daemon) => {
        const live = await Live.open(daemon, 'other');
        const stop = repeat(async (i) => {
            for (let k = 0; k < FLOOD; k += 1) {
                live.look({ ...VIEW, ...place(FLOOD * i + k) });
            }
            live.frames.length = 0;
            await sleep(1);
        });
        return async () => {
            await stop();
            live.socket.destroy();
        };
    },
    'a flood of picks': async (daemon) => {
        const live = await Live.open(daemon, 'other');
        live.look(VIEW);
        const stop = repeat(async (i) => {
            for (let k = 0; k < FLOOD; k += 1) {
                live.say({ type: 'pick', pick: FLOOD * i + k + 1, seq: live.seq, x: k, y: k });
            }
            live.messages.length = 0;
            await sleep(1);
        });
        return async () => {
            await stop();
            live.socket.destroy();
        };
    },
    'documents of 100,000 nodes': (daemon) => {
        const document = largeDocument(99_000);
        return repeat(() => fetch(`${daemon.url}/v1/scenes/large`, { method: 'PUT', headers: { 'content-type': 'application/json' }, body: document }).catch(() => null));
    },
    'pictures of documents of 30,000 nodes': (daemon) => {
        const scene = largeDocument(30_000);
        return repeat((i) =>
            fetch(`${daemon.url}/v1/render`, {
                method: 'POST',
                headers: { 'content-type': 'application/json' },
                body: `{"scene":${scene},"width":${16 + (i % 16)},"height":16}`,
            })
                .then((answer) => answer.arrayBuffer())
                .catch(() => null),
        );
    },
    'seven hundred half-open connections': (daemon) => {
        const sockets = Array.from({ length: 700 }, () => {
            const socket = net.connect(daemon.port, '127.0.0.1', () => socket.write(handshake(daemon.port, 'other').slice(0, 40)));
            socket.on('error', () => {});
            return socket;
        });
        return () => sockets.forEach((socket) => socket.destroy());
    },
};

const [port, name] = process.argv.slice(2);
if (process.argv[1] === fileURLToPath(import.meta.url)) {
    os.setPriority(10);
    const leave = await GUESTS[name]({ port: Number(port), url: `http://127.0.0.1:${port}` });
    process.stdout.write('here\n');
    process.stdin.resume().on('end', async () => {
        await leave();
        process.exit(0);
    });
}
