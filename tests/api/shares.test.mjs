// SPDX-License-Identifier: MIT
// Nobody waits for another's pictures: drawing time is shared by client. Counted in tiles, each of
// which takes as long as every other, so that no clock decides.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import { after, before, test } from 'node:test';
import { ask, counter, cpuSecondsOf, sleep, standStill, startDaemon, until } from '../support/daemon.mjs';
import { largeDocument } from '../support/large.mjs';
import { Live } from '../support/live.mjs';

const TILE_MS = 10;
const LARGE = { width: 4096, height: 4096 };
const PICTURES = 40;
const BETWEEN = 8; // tiles of others between a question and its answer: a question takes as long as a few
const EDITS = 10;
const PICKS = 800;
const AT_ONCE = 8; // that are answered
const VIEWS = 40; // of one who acknowledges nothing
const NEWCOMERS = 40;
const COMING = 10;
const REST_MS = 600; // after which a picture at rest would have come
const SHARE = 16; // pictures of one client in the queue
const QUEUE = 64; // of all clients
const STOPPED_MS = 600_000; // a worker that a test stops is not taken for one that hangs
const READERS = 50;
const EACH_MS = 500; // of drawing for each of them: a fifth is what one may be behind (TURNS_CREDIT_US), and as much for single pictures
const AHEAD = 300 / TILE_MS; // tiles by which urgent pictures may run ahead of one that is not (renderer/worker/turns.h)
const ball = { format: 'fieldcast/1', root: { id: 'ball', type: 'sphere' } };

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null', tileMs: TILE_MS, args: ['--worker-silence', String(STOPPED_MS)] });
    await ask(daemon, 'POST', '/v1/scenes?id=one', ball);
    await ask(daemon, 'POST', '/v1/scenes?id=two', ball);
});
after(() => daemon.stop());

const tiles = () => counter(daemon, 'tiles_total');
const image = (scene, side, more = '') => `${daemon.url}/v1/scenes/${scene}/image.png?width=${side}&height=${side}${more}`;

/** Another place to look from: every view is a new picture. */
const from = (i) => ({ camera: { position: [Math.sin(i), 1, 5] } });

/** Asks for large views for ever, until `stop`. */
async function greedy(scene) {
    const live = await Live.open(daemon, scene);
    let going = true;
    const done = (async () => {
        for (let i = 1; going; i += 1) {
            const seq = live.look({ ...LARGE, ...from(i) });
            await live.nextFrame((frame) => frame.seq >= seq || !going);
        }
    })();
    return {
        live,
        async stop() {
            going = false;
            await done;
            await live.close();
        },
    };
}

/** Tiles drawn for all while a small viewer gets so many pictures, each asked when the last is there. */
async function tilesOfPictures(scene, count) {
    const live = await Live.open(daemon, scene);
    live.look({ ...from(0) });
    await live.nextFrame();
    const start = await tiles();
    for (let i = 1; i <= count; i += 1) {
        const seq = live.look({ ...from(i) });
        await live.nextFrame((frame) => frame.seq === seq);
    }
    await live.close();
    return (await tiles()) - start;
}

/** Viewers of small pictures who look elsewhere with every picture that comes; a view is always ahead of it. */
async function readers(scenes) {
    const all = await Promise.all(scenes.map((scene) => Live.open(daemon, scene)));
    const timesUs = all.map(() => []); // that the pictures of each took to draw
    all.forEach((live, i) => {
        const look = () => live.look({ width: 64, height: 48, ...from(1000 * i + timesUs[i].length) });
        live.onFrame = ({ stagesUs }) => {
            timesUs[i].push(stagesUs.slice(1, -1).reduce((a, b) => a + b)); // without waiting, encoding
            look();
        };
        look();
        look();
    });
    await until(() => timesUs.every((times) => times.length > 0), 'a picture for each');
    return { timesUs, stop: () => Promise.all(all.map((live) => live.close())) };
}

// A picture that the machine interrupts takes longer, and its viewer waits for that, perhaps from here on: so times
// are compared, and who had such a picture may differ by what it took beyond three usual ones.
test('one beside fifty who read gets its share, and so does each of them', async (t) => {
    const { timesUs, stop } = await readers(['two', ...Array(READERS).fill('one')]);
    const before = timesUs.map((times) => times.length);
    const sums = () => timesUs.map((times, i) => times.slice(before[i]).reduce((a, b) => a + b, 0));
    const mean = () => sums().reduce((a, b) => a + b) / timesUs.length;
    await until(() => mean() >= 1000 * EACH_MS, `${EACH_MS} ms for each`);
    const parts = sums().map((sum) => sum / mean() - 1);
    const usual = timesUs.flat().sort((a, b) => a - b)[timesUs.flat().length >> 1];
    const interrupted = timesUs.map(([_first, ...times]) => Math.max(0, Math.max(...times) - 3 * usual) / mean());
    await stop();
    const most = Math.max(...parts.map((part, i) => Math.abs(part) - interrupted[i]));
    const percent = (part) => (100 * part).toFixed(0);
    t.diagnostic(`% beyond a share: ${parts.map(percent).join(' ')}; interrupted: ${interrupted.map(percent).join(' ')}`);
    assert.ok(most <= 0.2, `${percent(most)} %`);
});

test('a small picture beside ten who read has its turn', async (t) => {
    const { timesUs, stop } = await readers(Array(10).fill('one'));
    const before = timesUs.flat().length;
    const answer = await fetch(image('two', 8, '&samples=1')); // one tile, as small as tiles are
    const drawn = timesUs.flat().length - before;
    await stop();
    assert.equal(answer.status, 200);
    t.diagnostic(`${drawn} pictures of others until it was there`);
    assert.ok(drawn <= AHEAD + 2 * 10 + BETWEEN, `${drawn} pictures`);
});

for (const [scene, who] of [
    ['two', 'of another scene'],
    ['one', 'of the same scene'],
]) {
    test(`one who asks for large views for ever does not slow a viewer ${who}`, async (t) => {
        const guest = await greedy('one');
        await guest.live.nextFrame();
        const drawn = await tilesOfPictures(scene, PICTURES);
        t.diagnostic(`${drawn} tiles while ${PICTURES} pictures of one tile were asked for`);
        assert.ok(drawn <= PICTURES * (1 + BETWEEN), `${drawn} tiles for ${PICTURES} pictures`);
        await guest.stop();
    });
}

test('a small picture does not wait for large ones of the same client', async (t) => {
    const gone = new AbortController();
    const large = Array.from({ length: SHARE - 1 }, (_, i) =>
        fetch(image('one', 16384, `&camera.fov=${20 + i}`), { signal: gone.signal }).catch(() => null),
    );
    await until(async () => (await counter(daemon, 'render_queue')) === SHARE - 1, 'all to wait');
    const start = await tiles();
    const answer = await fetch(image('two', 64));
    assert.equal(answer.status, 200);
    const drawn = (await tiles()) - start;
    t.diagnostic(`${drawn} tiles until it was there`);
    assert.ok(drawn <= 1 + 2 * BETWEEN + SHARE, `${drawn} tiles`);
    gone.abort();
    await Promise.all(large);
    await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the queue to empty');
});

test('a client has a quarter of the queue, and is told when to ask again', async () => {
    const gone = new AbortController();
    const large = Array.from({ length: SHARE }, (_, i) =>
        fetch(image('one', 16384, `&camera.fov=${20 + i}`), { signal: gone.signal }).catch(() => null),
    );
    await until(async () => (await counter(daemon, 'render_queue')) === SHARE, 'all to wait');
    const refused = await fetch(image('two', 64, '&camera.fov=11'));
    assert.equal(refused.status, 429);
    assert.match(refused.headers.get('retry-after'), /^[1-9]\d*$/);
    const problem = await refused.json();
    assert.equal(problem.code, 'share');
    assert.match(problem.detail, new RegExp(`^${SHARE} pictures of this client wait already; the limit is ${SHARE}$`));
    assert.equal(problem.position, SHARE + 1);
    assert.equal(await counter(daemon, 'images_over_share_total'), 1);
    gone.abort();
    await Promise.all(large);
    await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the queue to empty');
});

test('threads that encode for later, read files, read documents or free scenes give way to those that draw', () => {
    const worker = daemon.worker();
    const tasks = fs.readdirSync(`/proc/${worker}/task`);
    // The 19th field is the priority; the second one ends with the last bracket.
    const nice = tasks.map((task) => Number(fs.readFileSync(`/proc/${worker}/task/${task}/stat`, 'utf8').split(') ')[1].split(' ')[16]));
    const own = nice[tasks.indexOf(String(worker))];
    assert.equal(nice.filter((one) => one === own + 5).length, 4, `${nice}`); // 19: those of the driver
});

/** What a client at another address is told. */
const askFrom = (localAddress, at) =>
    new Promise((done, fail) => {
        const request = http.get(`${daemon.url}${at}`, { localAddress }, (answer) => {
            let text = '';
            answer.on('data', (bytes) => (text += bytes));
            answer.on('end', () => done({ status: answer.statusCode, headers: answer.headers, text }));
        });
        request.on('error', (error) => (request.destroyed ? done(null) : fail(error)));
        leaving.push(() => request.destroy() && done(null));
    });
const leaving = [];
const queueOf = async (localAddress) => JSON.parse((await askFrom(localAddress, '/v1/queue')).text);

test('pictures that wait have a position: clients take turns, small ones of one client go first', async () => {
    const waits = (count) => until(async () => (await counter(daemon, 'images_waiting')) === count, `${count} to wait`);
    const pictures = [];
    for (const [address, side] of [['127.0.0.2', 16000], ['127.0.0.2', 15000], ['127.0.0.3', 16001], ['127.0.0.2', 14000]]) {
        pictures.push(askFrom(address, `/v1/scenes/one/image.png?width=${side}&height=${side}`));
        await waits(pictures.length);
    }
    const second = await queueOf('127.0.0.2');
    assert.deepEqual([second.waiting, second.limit, second.clients, second.own_limit], [4, QUEUE, 2, SHARE]);
    assert.deepEqual(second.own.map(({ scene, width, height, position }) => [scene, width, height, position]), [
        ['one', 16000, 16000, 4],
        ['one', 15000, 15000, 3],
        ['one', 14000, 14000, 2],
    ]);
    const third = await queueOf('127.0.0.3');
    assert.deepEqual(third.own.map(({ width, position }) => [width, position]), [[16001, 1]]);
    assert.ok(third.own.every(({ waited_ms, expected_ms }) => waited_ms >= 0 && expected_ms >= 0));
    assert.deepEqual((await queueOf('127.0.0.4')).own, []);
    leaving.splice(0).forEach((leave) => leave());
    await Promise.all(pictures);
    await waits(0);
});

test('a full queue refuses whoever asks, and tells when to ask again; who waits in it gets the picture', async () => {
    const worker = daemon.worker();
    const small = (i) => `/v1/scenes/one/image.png?width=${8 + i}&height=8`;
    const waiting = [];
    await standStill(worker);
    for (let i = 0; i < QUEUE; i += 1) {
        waiting.push(askFrom(`127.0.1.${1 + Math.floor(i / SHARE)}`, small(i)));
    }
    await until(async () => (await counter(daemon, 'images_waiting')) === QUEUE, 'all to wait');
    const refused = await askFrom('127.0.2.1', small(QUEUE));
    process.kill(worker, 'SIGCONT');
    const problem = JSON.parse(refused.text);
    const told = [refused.status, problem.code, problem.detail, problem.position];
    const clients = QUEUE / SHARE; // each has a turn before one who comes last
    assert.deepEqual(told, [503, 'unavailable', `${QUEUE} pictures wait already; the limit is ${QUEUE}`, clients + 1]);
    assert.match(refused.headers['retry-after'], /^[1-9]\d*$/);
    assert.equal(await counter(daemon, 'images_over_queue_total'), 1);
    assert.deepEqual((await Promise.all(waiting)).map(({ status }) => status), Array(QUEUE).fill(200));
    assert.equal((await askFrom('127.0.2.1', small(QUEUE))).status, 200);
});

test('one who sends large edits without end leaves half of the time to others', async (t) => {
    const children = Array.from({ length: 3000 }, (_, i) => ({ id: `n${i}`, type: 'sphere', visible: i === 0 }));
    await ask(daemon, 'POST', '/v1/scenes?id=many', { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
    const guest = await Live.open(daemon, 'many');
    const other = await Live.open(daemon, 'two');
    const value = (i) => ({ op: 'set', at: `/nodes/n${i}/params/radius`, value: 0.5 });
    const edits = Array.from({ length: EDITS }, () => guest.change(children.map((_, i) => value(i))));
    let small = 0;
    while (!guest.find('applied', { edit: edits.at(-1) })) {
        const edit = other.set('/nodes/ball/params/radius', 1 + small / 1000);
        await other.next('applied', { edit });
        small += 1;
    }
    t.diagnostic(`${small} small edits beside ${EDITS} of ${children.length} operations`);
    assert.ok(small >= 4 * EDITS, `${small} small edits`);
    // Edits that arrive together are followed by one rest.
    assert.ok((await counter(daemon, 'connection_rests_total')) > 0, 'it rests');
    await Promise.all([guest.close(), other.close()]);
});

test('who asks what is under the pointer without end leaves half of the time to others', async (t) => {
    // Each of them is asked at each step of a ray.
    const child = (_, i) => ({ type: 'sphere', params: { radius: 0.5 }, transform: { translation: [(i % 50) / 50, i / 9000, 0] } });
    const root = { id: 'root', type: 'smooth_union', params: { k: 1, kernel: 'exponential' }, children: Array.from({ length: 9000 }, child) };
    await ask(daemon, 'POST', '/v1/scenes?id=crowd', { format: 'fieldcast/1', root });
    const guest = await Live.open(daemon, 'crowd');
    guest.look({ ...from(0), width: 64, height: 64 });
    const rests = () => counter(daemon, 'pick_rests_total');
    const before = await rests();
    const [start, cpu] = [Date.now(), cpuSecondsOf(daemon.pid)];
    for (let last = AT_ONCE; (await rests()) < before + 3; last += AT_ONCE) {
        for (let pick = last - AT_ONCE + 1; pick <= last; pick += 1) {
            guest.say({ type: 'pick', pick, seq: guest.seq, x: pick % 64, y: (7 * pick) % 64 });
        }
        await guest.next('picked', { pick: last });
        if (last >= PICKS) {
            // A busy machine gives the server less than that anyway.
            const share = (1000 * (cpuSecondsOf(daemon.pid) - cpu)) / (Date.now() - start);
            assert.ok(share < 0.5, `it does not rest, and takes ${share} of a processor`);
            break;
        }
    }
    await guest.close();
});

test('who has sent much work is told how long the server rests', async () => {
    const whole = JSON.parse(largeDocument(90_000));
    await ask(daemon, 'POST', '/v1/scenes?id=whole', { ...whole, root: { id: 'all', type: 'union', children: [whole.root] } });
    const guest = await Live.open(daemon, 'whole');
    guest.change([{ op: 'remove', at: '/nodes/root' }]);
    await guest.next('applied', { edit: guest.step('undo') });
    const { level, retry_ms } = await guest.next('notice', { code: 'share' });
    assert.equal(level, 'info');
    assert.ok(retry_ms >= 250 && retry_ms <= 2000, `${retry_ms} ms`);
    await guest.close();
    await ask(daemon, 'DELETE', '/v1/scenes/whole');
});

/** As many as look before the first of them has a picture, and acknowledge none. */
async function comeAtOnce(count) {
    const scene = `looked-at-by-${count}`;
    await ask(daemon, 'POST', `/v1/scenes?id=${scene}`, ball);
    const all = await Promise.all(Array.from({ length: count }, () => Live.open(daemon, scene, { ack: false })));
    const before = await counter(daemon, 'renders_total');
    const worker = daemon.worker();
    await standStill(worker);
    all.forEach((live, i) => live.look({ width: 1024, height: 768, ...from(i) }));
    await until(async () => (await counter(daemon, 'renders_total')) === before + count, 'a picture for each');
    process.kill(worker, 'SIGCONT');
    await Promise.all(all.map((live) => live.nextFrame()));
    return all;
}

test('who acknowledges nothing gets one picture, however often it looks elsewhere', async () => {
    const all = await comeAtOnce(10);
    const before = await counter(daemon, 'renders_total');
    all.forEach((live) => live.stopReading());
    for (let i = 1; i <= VIEWS; i += 1) {
        all.forEach((live) => live.look({ width: 1024, height: 768, ...from(i) }));
        await sleep(TILE_MS);
    }
    await sleep(REST_MS);
    assert.equal((await counter(daemon, 'renders_total')) - before, 0);
    all.forEach((live) => live.socket.destroy());
});

test('of many who come at once the first pictures share what one would get', async (t) => {
    const all = await comeAtOnce(8);
    const pixels = all.map(({ frames: [first] }) => first.width * first.height);
    t.diagnostic(`pixels of the first pictures: ${pixels.join(' ')}`);
    const most = Math.max(...pixels);
    const sum = pixels.reduce((a, b) => a + b);
    assert.ok(sum <= 4 * most, `${sum} pixels, ${most} of the first`);
    await Promise.all(all.map((live) => live.close()));
});

test('who comes does not slow those who are there, however many come', async (t) => {
    const live = await Live.open(daemon, 'two');
    live.look(from(-1));
    await live.nextFrame();
    const newcomers = await Promise.all(Array.from({ length: NEWCOMERS }, () => Live.open(daemon, 'one', { ack: false })));
    const worker = daemon.worker();
    await standStill(worker);
    newcomers.forEach((one, i) => one.look({ ...LARGE, ...from(i), quality: 'sharp' }));
    await until(async () => (await counter(daemon, 'render_queue')) >= NEWCOMERS, 'all to wait');
    const start = await tiles();
    process.kill(worker, 'SIGCONT');
    for (let i = 0; i < COMING; i += 1) {
        const seq = live.look(from(i));
        await live.nextFrame((frame) => frame.seq === seq);
    }
    const drawn = (await tiles()) - start;
    t.diagnostic(`${drawn} tiles while ${COMING} pictures of one tile were asked for beside ${NEWCOMERS} newcomers`);
    assert.ok(drawn > 0 && drawn <= COMING * (1 + BETWEEN), `${drawn} tiles`); // the last ones may not be told yet
    newcomers.forEach((one) => one.socket.destroy());
    await live.close();
    await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the queue to empty');
});

test('nothing more is drawn for one whose line takes no more', async () => {
    const live = await Live.open(daemon, 'one', { ack: false });
    live.stopReading();
    for (let i = 0; i < 200; i += 1) {
        live.look({ ...LARGE, ...from(i) });
    }
    await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the queue to empty');
    const start = await tiles();
    live.look({ ...LARGE, ...from(-1) });
    assert.ok((await tilesOfPictures('two', 5)) <= 5 * (1 + BETWEEN));
    assert.ok((await tiles()) - start <= 7 * (1 + BETWEEN));
    live.goOnReading();
    await live.close();
});
