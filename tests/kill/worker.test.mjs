// SPDX-License-Identifier: MIT
// The render process is killed, stopped, and killed again by a scene, while clients drag.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { ask, counter, cpuSecondsOfAll, logged, sleep, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';
import net from 'node:net';

const KILLS = 5;
const MOST_SECONDS = 2; // of the processors, from the loss of a worker until its clients have pictures
const RADIUS = '/nodes/ball/params/radius';
const DOCUMENT = {
    format: 'fieldcast/1',
    lights: [{ id: 'sun', type: 'directional' }],
    root: { id: 'ball', type: 'sphere', params: { radius: 1 } },
};

let daemon;
before(async () => {
    daemon = await startDaemon({ args: ['--worker-silence', '1500'], driver: 'null', tileMs: 5 });
    await ask(daemon, 'POST', '/v1/scenes?id=s', DOCUMENT);
});
after(() => daemon.stop());

test('it finds in its environment that malloc() asks for huge pages', () => {
    const environment = fs.readFileSync(`/proc/${daemon.worker()}/environ`, 'utf8').split('\0');
    assert.ok(environment.some((each) => /^GLIBC_TUNABLES=(.*:)?glibc\.malloc\.hugetlb=\d/.test(each)), `${environment}`);
});

test('whoever lists processes reads the name of the program', () => {
    for (const id of [daemon.pid, daemon.worker()]) {
        assert.equal(fs.readFileSync(`/proc/${id}/comm`, 'utf8').trim(), 'fieldcast');
    }
});

/** Moves the camera and a number until stop() is called. */
function drag(live) {
    let going = true;
    const done = (async () => {
        for (let i = 0; going; i += 1) {
            live.look({ width: 160, height: 120, camera: { position: [Math.sin(i / 20), 1, 5] } });
            live.set(RADIUS, 1 + (i % 50) / 100, { group: `g${Math.floor(i / 50)}` });
            await sleep(25);
        }
    })();
    return { stop: () => ((going = false), done) };
}

/** Milliseconds from the loss of the worker until a client gets a picture of the next one. */
async function pictureAfter(live, lost) {
    const from = live.frames.length;
    const frame = await live.nextFrame(() => true, from);
    return frame.at - lost;
}

async function interrupt(signal, t) {
    const clients = [await Live.open(daemon, 's'), await Live.open(daemon, 's')];
    const drags = clients.map(drag);
    await Promise.all(clients.map((live) => live.nextFrame()));
    const waits = [];
    const spent = [];
    for (let i = 0; i < KILLS; i += 1) {
        const pid = daemon.worker();
        const lost = Date.now();
        const before = cpuSecondsOfAll(daemon);
        process.kill(pid, signal);
        await until(() => daemon.worker() && daemon.worker() !== pid, 'another worker');
        waits.push(...(await Promise.all(clients.map((live) => pictureAfter(live, lost)))));
        spent.push(cpuSecondsOfAll(daemon) - before);
        await sleep(200);
    }
    await Promise.all(drags.map((one) => one.stop()));
    for (const live of clients) {
        await live.next('applied', { edit: live.edit, durable: true });
        assert.equal(live.closed, false, 'nobody is disconnected');
        const durable = live.messages.filter((m) => m.type === 'applied' && m.durable);
        assert.equal(new Set(durable.map((m) => m.edit)).size, live.edit, 'no edit is lost');
        assert.ok(live.find('notice', { code: 'worker_restarting' }), 'clients are told');
        assert.ok(live.find('notice', { code: 'worker_ready' }));
    }
    const total = clients[0].edit + clients[1].edit;
    await clients[0].nextFrame((frame) => frame.lossless && frame.revision > total);
    await Promise.all(clients.map((live) => live.close()));
    t.diagnostic(`${KILLS} × ${signal}: pictures again after ${Math.max(...waits)} ms at most, ${Math.max(...spent)} s of the processors, ${total} edits`);
    assert.ok(Math.max(...spent) <= MOST_SECONDS, `${spent}`);
    return total;
}

test('kill -9 while two clients drag', async (t) => {
    const before = (await ask(daemon, 'GET', '/v1/scenes')).scenes[0].revision;
    const total = await interrupt('SIGKILL', t);
    const { revision } = (await ask(daemon, 'GET', '/v1/scenes')).scenes[0];
    assert.equal(revision - before, total, 'each edit is in once');
    assert.ok((await counter(daemon, 'worker_restarts_total')) >= KILLS);
});

test('a worker that crashes is replaced', async (t) => {
    await interrupt('SIGSEGV', t);
});

test('a worker that hangs is replaced', async (t) => {
    await interrupt('SIGSTOP', t);
});

test('a picture that was asked for is drawn by the next worker', async () => {
    const answer = fetch(`${daemon.url}/v1/scenes/s/image.png?width=2048&height=1536&samples=4`);
    await until(async () => (await counter(daemon, 'render_queue')) === 1, 'the order');
    process.kill(daemon.worker(), 'SIGKILL');
    assert.equal((await answer).status, 200);
});

test('a scene that ends workers is suspended until it is edited, others go on', async () => {
    await ask(daemon, 'POST', '/v1/scenes?id=bad', DOCUMENT);
    const bad = await Live.open(daemon, 'bad');
    const good = await Live.open(daemon, 's');
    good.look();
    await good.nextFrame((frame) => frame.lossless);
    // Large pictures of `bad` are under way whenever the worker is killed.
    for (let i = 0; i < 2; i += 1) {
        bad.look({ width: 4096, height: 2304 + i });
        await until(async () => (await counter(daemon, 'render_queue')) > 0, 'the order');
        const pid = daemon.worker();
        process.kill(pid, 'SIGKILL');
        await until(() => daemon.worker() && daemon.worker() !== pid, 'another worker');
        await until(async () => (await fetch(`${daemon.url}/readyz`)).ok, 'it to be ready');
    }
    const notice = await bad.next('notice', { code: 'scene_left_out' });
    assert.deepEqual([notice.level, notice.reason], ['error', 'crashed']);
    const refused = await fetch(`${daemon.url}/v1/scenes/bad/image.png?width=8&height=8`);
    assert.equal(refused.status, 503);
    const from = good.frames.length;
    good.set(RADIUS, 1.01);
    await good.nextFrame((frame) => frame.lossless, from);
    bad.look({ width: 64, height: 48 });
    bad.set(RADIUS, 1.5);
    await bad.nextFrame((frame) => frame.revision === 2 && frame.lossless);
    await Promise.all([bad.close(), good.close()]);
});

test('where nothing can be drawn the daemon ends and says why', async () => {
    const daemon = await startDaemon({ args: ['--device-index', '200'], ready: false });
    await daemon.exited;
    await logged(daemon, /device/i);
    await daemon.stop(1);
});

test('where no descriptor is free the next worker still starts', async () => {
    const tight = await startDaemon({ driver: 'null', limits: 'ulimit -n 64' });
    await ask(tight, 'POST', '/v1/scenes?id=s', DOCUMENT);
    const lives = [await Live.open(tight, 's')];
    lives[0].look();
    await lives[0].nextFrame();
    while (lives.at(-1).status.includes(' 101 ')) {
        lives.push(await Live.open(tight, 's'));
    }
    assert.match(lives.at(-1).status, / 503 /);
    // Whatever becomes free is taken at once.
    const greedy = setInterval(() => lives.push(new Live(tight, 's')), 5);
    const pid = tight.worker();
    process.kill(pid, 'SIGKILL');
    await until(() => tight.worker() && tight.worker() !== pid, 'another worker');
    clearInterval(greedy);
    assert.notEqual(tight.worker(), pid);
    const from = lives[0].frames.length;
    lives[0].look({ camera: { position: [0, 1, 9] } });
    await lives[0].nextFrame(() => true, from);
    lives.forEach((live) => live.socket.destroy());
    await tight.stop();
});
