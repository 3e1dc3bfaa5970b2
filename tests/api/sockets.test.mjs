// SPDX-License-Identifier: MIT
// Raw sockets against the acceptor: heads in pieces, requests in a row, shapes that two parsers
// could read differently, handshakes that must be refused, clients that are slow or leave.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import net from 'node:net';
import { after, before, describe, test } from 'node:test';
import { ask, counter, cpuSecondsOf, memoryOf, sleep, startDaemon, until } from '../support/daemon.mjs';
import { encodeMessage, handshake, Live } from '../support/live.mjs';

const SLOW_BYTES = 16 << 20; // more memory of the daemon while many are slow

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null', tileMs: 5 });
    await ask(daemon, 'POST', '/v1/scenes?id=s', { from: 'example:first-steps' });
});
after(() => daemon.stop());

/** A connection that collects what comes. */
function connect(to = daemon) {
    const peer = { text: '', ended: false };
    peer.socket = net.connect({ port: to.port, host: '127.0.0.1', allowHalfOpen: true });
    peer.socket.on('data', (bytes) => (peer.text += bytes.toString('latin1')));
    peer.socket.on('end', () => (peer.ended = true));
    peer.socket.on('close', () => (peer.ended = true));
    peer.socket.on('error', () => (peer.ended = true));
    peer.statuses = () => [...peer.text.matchAll(/HTTP\/1\.[01] (\d+)/g)].map((m) => Number(m[1]));
    peer.end = () => until(() => peer.ended, 'the server to close');
    peer.close = () => peer.socket.destroy();
    return peer;
}

/** Sends bytes, waits for `count` answers or the end; gives the statuses. */
async function statuses(bytes, count = 1) {
    const peer = connect();
    peer.socket.write(Buffer.from(bytes, 'latin1'));
    await until(() => peer.ended || peer.statuses().length >= count, 'an answer');
    await sleep(20); // a second answer to one request would come at once
    peer.close();
    return peer.statuses();
}

const get = (more = '', at = '/healthz') => `GET ${at} HTTP/1.1\r\nHost: localhost\r\n${more}\r\n`;

describe('heads', () => {
    test('whole', async () => assert.deepEqual(await statuses(get()), [200]));

    test('byte by byte', async () => {
        const peer = connect();
        peer.socket.setNoDelay(true);
        for (const c of get('X-Long: abc\r\n')) {
            peer.socket.write(c);
            await sleep(1);
        }
        await until(() => peer.statuses().length === 1, 'an answer');
        peer.close();
        assert.deepEqual(peer.statuses(), [200]);
    });

    test('behind empty lines', async () =>
        assert.deepEqual(await statuses(`\r\n\r\n${get()}`), [200]));

    test('five in a row', async () =>
        assert.deepEqual(await statuses(get().repeat(5), 5), [200, 200, 200, 200, 200]));

    test('with bodies in a row', async () => {
        const body = '{"from":"example:first-steps"}';
        const post = `POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: ${body.length}\r\n\r\n${body}`;
        assert.deepEqual(await statuses(post + post + get(), 3), [201, 201, 200]);
    });

    // libmicrohttpd's own answer, where the extension does not fit into its buffer.
    test('an extension of a chunk: up to 20 kB it is passed over, with 64 KiB it is refused', async () => {
        const head = 'POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n';
        const body = '{"from":"example:first-steps"}';
        const chunked = (bytes) => `${head}${body.length.toString(16)};x=${'a'.repeat(bytes)}\r\n${body}\r\n0\r\n\r\n`;
        assert.deepEqual(await statuses(chunked(20_000) + get(), 2), [201, 200]);
        assert.deepEqual(await statuses(chunked(65_536) + get(), 2), [500]);
        assert.deepEqual(await statuses(get()), [200]);
    });

    test('a body in chunks', async () =>
        assert.deepEqual(
            await statuses(
                'POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n' +
                    '10\r\n{"from":"example\r\ne\r\n:first-steps"}\r\n0\r\n\r\n',
            ),
            [201],
        ));

    test('long, below the limit', async () =>
        assert.deepEqual(await statuses(get(`X-Long: ${'x'.repeat(12000)}\r\n`)), [200]));

    test('too long', async () =>
        assert.deepEqual(await statuses(get(`X-Long: ${'x'.repeat(20000)}\r\n`)), [431]));

    test('HTTP/1.0 without Host', async () =>
        assert.deepEqual(await statuses('GET /healthz HTTP/1.0\r\n\r\n'), [200]));

    test('an expectation is met', async () => {
        const peer = connect();
        const body = '{"from":"example:first-steps"}';
        peer.socket.write(
            `POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nExpect: 100-continue\r\nContent-Length: ${body.length}\r\n\r\n`,
        );
        await until(() => peer.statuses()[0] === 100, '100 Continue');
        peer.socket.write(body);
        await until(() => peer.statuses().length === 2, 'an answer');
        peer.close();
        assert.deepEqual(peer.statuses(), [100, 201]);
    });

    test('an expectation that cannot be met is refused before the body', async () =>
        assert.deepEqual(
            await statuses(
                'POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nExpect: 100-continue\r\nContent-Length: 99999999\r\n\r\n',
            ),
            [413],
        ));

    for (const [where, before] of [['first', ''], ['second', get()]]) {
        test(`white space around values is no part of them, in the ${where} request`, async () => {
            const body = '{"from":"example:first-steps"}';
            const post = `POST /v1/scenes HTTP/1.1\r\nHost:\t localhost \t\r\nX: \t a b \t\r\nNone:\r\nBlank: \t\r\nContent-Type:application/json\t\r\nContent-Length:\t${body.length}\r\n\r\n${body}`;
            assert.equal((await statuses(before + post, before ? 2 : 1)).at(-1), 201);
        });
    }

    test('half-closed behind a whole request is served', async () => {
        const peer = connect();
        peer.socket.end(get('Connection: close\r\n'));
        await peer.end();
        assert.deepEqual(peer.statuses(), [200]);
    });

    const slow = '/v1/scenes/s/image.png?width=4096&height=512&samples=4'; // a second of tiles

    for (const [where, before] of [['first', ''], ['second', get()]]) {
        test(`half-closed behind a picture that takes a while gets it, as the ${where} request`, async () => {
            const peer = connect();
            const statuses = before ? [200, 100, 200] : [100, 200];
            peer.socket.end(before + get('Connection: close\r\n', `${slow}&camera.fov=${20 + before.length}`));
            await peer.end();
            assert.deepEqual(peer.statuses(), statuses);
            const length = Number(peer.text.match(/Content-Length: (\d+)\r\n(?:[^\r\n]+\r\n)*\r\n\x89PNG/)[1]);
            assert.equal(peer.text.length - peer.text.lastIndexOf('\r\n\r\n\x89PNG') - 4, length);
        });
    }

    test('half-closed behind a picture that was drawn before gets it without a word between', async () => {
        await (await fetch(daemon.url + slow)).arrayBuffer();
        const peer = connect();
        peer.socket.end(get('Connection: close\r\n', slow));
        await peer.end();
        assert.deepEqual(peer.statuses(), [200]);
    });

    test('half-closed behind a document that waits for its commit gets the answer', async () => {
        const body = '{"from":"example:first-steps"}';
        for (let i = 0; i < 20; i += 1) {
            const peer = connect();
            peer.socket.end(`POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: ${body.length}\r\n\r\n${body}`);
            await peer.end();
            assert.deepEqual(peer.statuses(), [201]);
        }
    });

    test('half-closed by HTTP/1.0, which knows no interim answers, is taken for gone', async () => {
        const peer = connect();
        peer.socket.end('GET /v1/scenes/s/image.png?width=4096&height=4096&samples=4 HTTP/1.0\r\n\r\n');
        await peer.end();
        assert.deepEqual(peer.statuses().filter((status) => status !== 503), []);
        await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the end of the order');
    });

    test('half-closed in front of a whole request is closed', async () => {
        const peer = connect();
        peer.socket.end('GET /healthz HTTP/1.1\r\n');
        await peer.end();
        assert.deepEqual(peer.statuses(), []);
    });
});

// Each is refused with one clean answer, after which the connection closes.
const malformed = {
    'Host twice': [400, get('Host: localhost\r\n')],
    'no Host': [400, 'GET /healthz HTTP/1.1\r\n\r\n'],
    'Host with a user': [400, 'GET / HTTP/1.1\r\nHost: a@localhost\r\n\r\n'],
    'Host with a blank': [400, 'GET / HTTP/1.1\r\nHost: local host\r\n\r\n'],
    'two lengths': [400, get('Content-Length: 3\r\nContent-Length: 3\r\n') + 'abc'],
    'length and chunked': [400, get('Content-Length: 3\r\nTransfer-Encoding: chunked\r\n') + '0\r\n\r\n'],
    'length with a sign': [400, get('Content-Length: +3\r\n') + 'abc'],
    'length as a list': [400, get('Content-Length: 3, 3\r\n') + 'abc'],
    'a blank behind the length': [400, get('Content-Length: 3 \r\n') + 'abc'],
    'a tab behind the length': [400, get('Content-Length:\t3\t\r\n') + 'abc'],
    'a tab behind the coding': [400, get('Transfer-Encoding: chunked\t\r\n')],
    'length in hexadecimal': [400, get('Content-Length: 0x3\r\n') + 'abc'],
    'an empty length': [400, get('Content-Length:\r\n')],
    'an endless length': [400, get(`Content-Length: ${'9'.repeat(30)}\r\n`)],
    'unknown coding': [400, get('Transfer-Encoding: gzip\r\n')],
    'chunked twice': [400, get('Transfer-Encoding: chunked, chunked\r\n')],
    'chunked with a tail': [400, get('Transfer-Encoding: chunked;q=1\r\n')],
    'chunked behind a tab': [400, get('Transfer-Encoding:\x0bchunked\r\n')],
    'chunked in HTTP/1.0': [400, 'POST / HTTP/1.0\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n'],
    'a blank before the colon': [400, get('Content-Length : 3\r\n')],
    'a header without colon': [400, get('Nonsense\r\n')],
    'a header without name': [400, get(': x\r\n')],
    'a folded header': [400, get('X: a\r\n b\r\n')],
    'a folded length': [400, get('Content-Length: 3\r\n 0\r\n') + get()],
    'a length in the fold': [400, get('Content-Length:\r\n\t30\r\n') + get()],
    'a folded coding': [400, get('Transfer-Encoding:\r\n chunked\r\n') + '0\r\n\r\n'],
    'a fold of blanks': [400, get('X: a\r\n \t\r\n')],
    'a line of blanks first': [400, 'GET / HTTP/1.1\r\n \r\nHost: localhost\r\n\r\n'],
    'a tab in the request line': [400, 'GET\t/ HTTP/1.1\r\nHost: localhost\r\n\r\n'],
    'a blank behind the version': [400, 'GET / HTTP/1.1 \r\nHost: localhost\r\n\r\n'],
    'a blank before the method': [400, ' GET / HTTP/1.1\r\nHost: localhost\r\n\r\n'],
    'a Host of blanks': [400, 'GET / HTTP/1.1\r\nHost: \t \r\n\r\n'],
    'a length of blanks': [400, get('Content-Length: \t\r\n')],
    'a fold first': [400, 'GET / HTTP/1.1\r\n Host: localhost\r\n\r\n'],
    'NUL in a header': [400, get('X: a\0b\r\n')],
    'NUL in a name': [400, get('X\0: a\r\n')],
    'CR alone': [400, get('X: a\rY: b\r\n')],
    'LF alone': [400, 'GET / HTTP/1.1\nHost: localhost\n\n'],
    'a control character': [400, get('X: a\x01b\r\n')],
    'a control character in the target': [400, get('', '/a\x07b')],
    'a fragment in the target': [400, get('', '/a#b')],
    'a target that is no path': [400, get('', 'healthz')],
    'two blanks': [400, 'GET  / HTTP/1.1\r\nHost: localhost\r\n\r\n'],
    'no version': [400, 'GET /\r\nHost: localhost\r\n\r\n'],
    'an odd version': [400, 'GET / HTTP/1.1x\r\nHost: localhost\r\n\r\n'],
    'another version': [505, 'GET / HTTP/2.0\r\nHost: localhost\r\n\r\n'],
    'HTTP/2 at once': [505, 'PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n'],
    'a method with brackets': [400, '<GET> / HTTP/1.1\r\nHost: localhost\r\n\r\n'],
    'TLS': [400, '\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\n\n'],
};

describe('malformed', () => {
    for (const [name, [status, bytes]] of Object.entries(malformed)) {
        test(name, async () => {
            const peer = connect();
            peer.socket.write(Buffer.from(bytes, 'latin1'));
            await peer.end();
            assert.deepEqual(peer.statuses(), [status]);
            assert.match(peer.text, /application\/problem\+json/);
            assert.match(peer.text, /\r\nConnection: close\r\n/i);
            assert.match(peer.text, /\r\nX-Content-Type-Options: nosniff\r\n/i);
            assert.match(peer.text, /\r\nCross-Origin-Resource-Policy: same-origin\r\n/i);
            peer.close();
        });
    }

    test('all of these are counted', async () => {
        const count = await counter(daemon, 'connections_malformed_total');
        assert.ok(count >= Object.keys(malformed).length, `${count}`);
        assert.equal(await counter(daemon, 'connections_over_limit_total'), 0);
    });

    // The second request of a connection is parsed by libmicrohttpd; it must not get farther, and what
    // would be its body is no third one.
    const later = ['Host twice', 'two lengths', 'length and chunked', 'unknown coding', 'a tab behind the coding', 'a blank before the colon'];
    for (const name of [...later, 'a folded header', 'a folded length', 'a length in the fold', 'a folded coding', 'a fold of blanks']) {
        test(`${name}, as the second request`, async () => {
            const peer = connect();
            peer.socket.write(Buffer.from(get() + malformed[name][1], 'latin1'));
            await peer.end();
            assert.equal(peer.statuses()[0], 200);
            assert.ok(peer.statuses().slice(1).every((s) => s === 400), peer.text);
            peer.close();
        });
    }
});

// A handshake that is not what the server speaks is answered by HTTP, which says why.
const refused = {
    'another version': [426, { 'Sec-WebSocket-Version': '8' }],
    'no version': [426, { 'Sec-WebSocket-Version': null }],
    'a short key': [426, { 'Sec-WebSocket-Key': 'YWJj' }],
    'no key': [426, { 'Sec-WebSocket-Key': null }],
    'another subprotocol': [426, { 'Sec-WebSocket-Protocol': 'chat' }],
    'no subprotocol': [426, { 'Sec-WebSocket-Protocol': null }],
    'no upgrade': [426, { Upgrade: null }],
    'another upgrade': [426, { Upgrade: 'h2c' }],
    'no connection': [426, { Connection: 'keep-alive' }],
    'another site': [403, { Origin: 'https://evil.example' }],
    'another host': [403, { Host: 'evil.example' }],
};

describe('handshakes', () => {
    for (const [name, [status, headers]] of Object.entries(refused)) {
        test(name, async () =>
            assert.deepEqual(await statuses(handshake(daemon.port, 's', headers)), [status]));
    }

    test('a scene that is not there', async () =>
        assert.deepEqual(await statuses(handshake(daemon.port, 'nobody')), [404]));

    test('a second request on a connection cannot become one', async () =>
        assert.deepEqual(await statuses(get() + handshake(daemon.port, 's'), 2), [200, 426]));

    test('in pieces', async () => {
        const peer = connect();
        for (const part of handshake(daemon.port, 's').match(/.{1,17}/gs)) {
            peer.socket.write(part);
            await sleep(1);
        }
        await until(() => peer.statuses().length === 1, 'an answer');
        assert.deepEqual(peer.statuses(), [101]);
        assert.match(peer.text, /Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK\+xOo=/i);
        assert.match(peer.text, /Sec-WebSocket-Protocol: fieldcast\.v1/i);
        assert.doesNotMatch(peer.text, /Sec-WebSocket-Extensions/i);
        peer.close();
    });

    test('with odd headers beside, and extensions offered', async () => {
        const live = await Live.open(daemon, 's', {
            headers: { 'X-F': '1', A: 'b', 'Sec-WebSocket-Extensions': 'permessage-deflate', Cookie: 'x'.repeat(4000) },
        });
        assert.equal(live.welcome.scene, 's');
        assert.doesNotMatch(live.head, /Extensions/i);
        await live.close();
    });

    test('one that goes away at once leaves nothing', async () => {
        for (let i = 0; i < 20; i += 1) {
            const peer = connect();
            peer.socket.write(handshake(daemon.port, 's'));
            await sleep(i % 4);
            peer.close();
        }
        await until(async () => (await counter(daemon, 'sessions')) === 0, 'sessions to end');
    });
});

/** Others are answered while `turns` goes on, and little is held and done for those. */
async function isServedAsEver(turns) {
    await until(() => turns() >= 5, 'the slow to begin');
    const memory = memoryOf(daemon.pid);
    for (const first = turns(); turns() < first + 10; ) {
        assert.deepEqual(await statuses(get()), [200]);
        await ask(daemon, 'PUT', '/v1/scenes/beside', { format: 'fieldcast/1', root: { type: 'sphere' } });
    }
    const start = Date.now();
    const cpu = cpuSecondsOf(daemon.pid);
    const next = turns() + 20;
    await until(() => turns() >= next, 'the slow to go on');
    const used = cpuSecondsOf(daemon.pid) - cpu;
    const seconds = (Date.now() - start) / 1000;
    assert.ok(used < 0.5 * seconds, `${used} s of processor time in ${seconds} s`);
    assert.ok(memoryOf(daemon.pid) - memory < SLOW_BYTES, 'little memory');
}

describe('slow clients', () => {
    test('a head that does not end is answered 408, and costs nothing meanwhile', async () => {
        const peers = Array.from({ length: 50 }, () => connect());
        for (const peer of peers) {
            peer.socket.write('GET /healthz HTTP/1.1\r\nHost: localhost\r\nX-Slow: ');
        }
        const cpu = cpuSecondsOf(daemon.pid);
        const start = Date.now();
        const trickle = setInterval(() => peers[0].socket.writable && peers[0].socket.write('x'), 300);
        await Promise.all(peers.map((peer) => peer.end()));
        clearInterval(trickle);
        const seconds = (Date.now() - start) / 1000;
        assert.ok(peers.every((peer) => peer.statuses()[0] === 408));
        assert.ok((await counter(daemon, 'connections_late_total')) >= peers.length);
        assert.ok(seconds > 4, `408 came after ${seconds} s`);
        assert.ok(cpuSecondsOf(daemon.pid) - cpu < 0.5 * seconds, 'waiting costs processor time');
    });

    test('a body without an end is cut', async () => {
        const peer = connect();
        peer.socket.write('POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n');
        const chunk = Buffer.concat([Buffer.from('100000\r\n'), Buffer.alloc(1 << 20, 'x'), Buffer.from('\r\n')]);
        let sent = 0;
        for (; !peer.ended && sent < 200; sent += 1) {
            await new Promise((done) => {
                peer.socket.write(chunk, done);
                peer.socket.once('close', done);
            });
        }
        await peer.end();
        assert.ok(sent >= 32 && sent < 60, `cut after ${sent} MiB, of 16 allowed`);
    });

    test('bodies that drip hold up nobody, and cost nothing', async () => {
        const head = 'POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n';
        const peers = Array.from({ length: 60 }, (_, i) => {
            const peer = connect();
            peer.socket.setNoDelay(true);
            peer.socket.write(`${head}${i % 2 ? 'Transfer-Encoding: chunked' : 'Content-Length: 9999'}\r\n\r\n`);
            peer.drop = i % 2 ? '1\r\n \r\n' : ' ';
            return peer;
        });
        let dripping = true;
        let drops = 0;
        const drip = (async () => {
            for (; dripping; drops += 1) {
                peers.forEach((peer) => peer.socket.write(peer.drop));
                await sleep(50);
            }
        })();
        try {
            await isServedAsEver(() => drops);
            assert.ok(peers.every((peer) => !peer.ended && !peer.statuses().length), 'they drip on');
        } finally {
            dripping = false;
            await drip;
            peers.forEach((peer) => peer.close());
        }
    });

    test('readers of one byte at a time hold up nobody, and cost nothing', async () => {
        const reading = Array.from({ length: 40 }, (_, i) => {
            const reader = { bytes: 0 };
            const onread = { buffer: Buffer.alloc(1), callback: () => ((reader.bytes += 1), false) };
            reader.socket = net.connect({ port: daemon.port, host: '127.0.0.1', onread });
            reader.socket.on('error', () => {});
            reader.socket.write(i % 2 ? get('', '/v1/schema.json') : handshake(daemon.port, 's'));
            reader.socket.write(i % 2 ? '' : encodeMessage(1, Buffer.from(`{"type":"hello","client":"slow-${i}-reader"}`)));
            return reader;
        });
        let going = true;
        let turns = 0;
        const read = (async () => {
            for (; going; turns += 1) {
                reading.forEach(({ socket }) => socket.resume());
                await sleep(50);
            }
        })();
        try {
            await isServedAsEver(() => turns);
            assert.ok(reading.every(({ bytes }) => bytes > 0 && bytes < 20_000));
        } finally {
            going = false;
            await read;
            reading.forEach(({ socket }) => socket.destroy());
        }
        await until(async () => (await counter(daemon, 'sessions')) === 0, 'sessions to end');
    });

    test('a line that is silent while a picture is drawn is probed within seconds', async () => {
        const peer = connect();
        peer.socket.write(get('', '/v1/scenes/s/image.png?width=4096&height=4096&samples=4'));
        await until(async () => (await counter(daemon, 'render_queue')) === 1, 'the order');
        const hex = (port) => port.toString(16).toUpperCase().padStart(4, '0');
        const ends = new RegExp(`:${hex(daemon.port)} \\S+:${hex(peer.socket.localPort)} (?:\\S+ ){2}02:([0-9A-F]{8})`);
        // 02: the next thing that the kernel does is a probe, after so many hundredths of a second.
        const [, when] = await until(() => ends.exec(fs.readFileSync('/proc/net/tcp', 'latin1')), 'a probe to be planned');
        assert.ok(parseInt(when, 16) <= 500, `in ${parseInt(when, 16)} hundredths of a second`);
        peer.close();
        await until(async () => (await counter(daemon, 'render_queue')) === 0, 'the end of the order');
    });

    test('a client that leaves before its picture is there frees the renderer: no more tiles of it are drawn', async () => {
        const tiles = () => counter(daemon, 'tiles_total');
        const before = await tiles();
        const peer = connect();
        peer.socket.write(get('', '/v1/scenes/s/image.png?width=4096&height=4096&samples=4'));
        await until(async () => (await tiles()) > before, 'its first tiles');
        peer.close();
        await until(async () => (await counter(daemon, 'render_queue')) === 0, 'its end');
        // The render process tells its tiles now and then. Of two such reports the second has those of others only.
        let others = 0;
        const other = async () => {
            others += 1;
            const at = `/v1/scenes/s/image.png?width=${64 + others}&height=48`; // a new one, of one tile
            assert.equal((await fetch(daemon.url + at)).status, 200);
        };
        const report = async () => {
            for (const known = await tiles(); (await tiles()) === known; ) {
                await other();
            }
            return tiles();
        };
        await other(); // after it the first one's end is known there
        const first = await report();
        const more = (await report()) - first;
        assert.ok(more <= others, `${more} tiles beside ${others} pictures of one tile`);
    });
});

describe('too many', () => {
    test('bodies in memory: what is above the limit is answered 503, small ones go on', async () => {
        const { limits } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
        const limit = limits.find(({ name }) => name === 'bodies_bytes').value;
        const size = 15 << 20;
        const body = Buffer.alloc(size - 1, 'x');
        const count = Math.ceil(limit / size) + 3;
        const head = `POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Length: ${size}\r\n\r\n`;
        const peers = Array.from({ length: count }, () => connect());
        await Promise.all(
            peers.map((peer) => new Promise((done) => peer.socket.write(head, () => peer.socket.write(body, done)))),
        );
        await ask(daemon, 'PUT', '/v1/scenes/small', { format: 'fieldcast/1', root: { type: 'sphere' } });
        peers.forEach((peer) => peer.socket.write('x'));
        await until(() => peers.every((peer) => peer.statuses().length), 'answers');
        const refused = peers.filter((peer) => peer.statuses()[0] === 503);
        assert.ok((count - refused.length) * size <= limit && refused.length < count / 2, `${refused.length}`);
        assert.equal(await counter(daemon, 'bodies_over_limit_total'), refused.length);
        assert.ok(refused.every((peer) => /\r\nRetry-After: 1\r\n/i.test(peer.text) && /the limit is 268435456/.test(peer.text)));
        const last = connect();
        last.socket.write(head);
        last.socket.write(body);
        last.socket.write('x');
        await until(() => last.statuses().length, 'an answer');
        assert.deepEqual(last.statuses(), [400], 'there is room again');
        [...peers, last].forEach((peer) => peer.close());
    });

    /** Asks, and reads nothing more once the answer has begun. */
    const askAndStop = (at) => {
        const peer = connect();
        peer.socket.once('data', () => peer.socket.pause());
        peer.socket.write(get('', at));
        return peer;
    };

    test('answers in memory: those who read the same file share its copy', async () => {
        const body = Buffer.alloc(32 << 20, 1);
        Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2048 +X 4000\n').copy(body);
        const { id } = await (await fetch(`${daemon.url}/v1/assets`, { method: 'POST', body })).json();
        const one = askAndStop(`/v1/assets/${id}`);
        await until(() => one.statuses().length, 'an answer');
        const before = memoryOf(daemon.pid);
        const peers = Array.from({ length: 16 }, () => askAndStop(`/v1/assets/${id}`));
        await until(() => peers.every((peer) => peer.statuses()[0] === 200), 'answers');
        const more = memoryOf(daemon.pid) - before;
        assert.ok(more < 8 * body.length, `${more} bytes`);
        [one, ...peers].forEach((peer) => peer.close());
    });

    test('HTTP connections: the last ones are answered 503, and there is room again when some leave', async () => {
        const peers = [];
        while (peers.length < 560) {
            const some = Array.from({ length: 140 }, () => connect()); // fewer than may wait at once
            some.forEach((peer) => peer.socket.write(get()));
            await until(() => some.every((peer) => peer.statuses().length === 1), 'answers');
            peers.push(...some);
        }
        const counts = { 200: 0, 503: 0 };
        peers.forEach((peer) => (counts[peer.statuses()[0]] += 1));
        assert.ok(counts[200] > 256 && counts[200] <= 512 && counts[503] === 560 - counts[200], JSON.stringify(counts));
        peers.forEach((peer) => peer.close());
        await until(async () => (await statuses(get()))[0] === 200, 'room');
        assert.ok((await counter(daemon, 'connections_over_limit_total')) >= counts[503]);
    });

    test('four hundred connections that wait for another request: others are served, and each of them', async () => {
        const peers = [];
        const ask = async (some, times) => {
            some.forEach((peer) => peer.socket.write(get()));
            await until(() => some.every((peer) => peer.ended || peer.statuses().length === times), 'answers');
        };
        while (peers.length < 400) {
            const some = Array.from({ length: 100 }, () => connect());
            await ask(some, 1);
            peers.push(...some);
        }
        assert.ok(peers.every((peer) => peer.statuses()[0] === 200), 'all are served');
        assert.deepEqual(await statuses(get()), [200]);
        const live = await Live.open(daemon, 's');
        live.look({ width: 32, height: 24 });
        await live.nextFrame();
        await live.close();
        const open = peers.filter((peer) => !peer.ended); // whoever waited for 15 s is closed
        await ask(open, 2);
        assert.ok(open.every((peer) => peer.ended || peer.statuses()[1] === 200), 'served again');
        peers.forEach((peer) => peer.close());
    });

    test('heads that never end: who comes later is served', async () => {
        const peers = Array.from({ length: 900 }, () => connect());
        peers.forEach((peer) => peer.socket.write('GET /healthz HTTP/1.1\r\n'));
        await until(() => peers.some((peer) => peer.statuses().length), 'the first to be refused');
        assert.deepEqual(peers.find((peer) => peer.statuses().length).statuses(), [503]);
        for (let i = 0; i < 12; i += 1) {
            assert.deepEqual(await statuses(get()), [200]);
        }
        assert.ok(peers.filter((peer) => !peer.statuses().length).length >= 500, 'most still wait');
        assert.ok((await counter(daemon, 'connections_over_waiting_total')) > 0);
        peers.forEach((peer) => peer.close());
    });

    test('live connections: the next is answered 503', async () => {
        const lives = await Promise.all(
            Array.from({ length: 256 }, () => Live.open(daemon, 's', { hello: false })),
        );
        assert.ok(lives.every((live) => live.status.includes(' 101 ')));
        assert.deepEqual(await statuses(handshake(daemon.port, 's')), [503]);
        assert.equal(await counter(daemon, 'sessions_over_limit_total'), 1);
        await Promise.all(lives.map((live) => live.close()));
        await until(async () => (await counter(daemon, 'sessions')) === 0, 'sessions to end');
    });

    test('a live connection that says nothing is closed', async () => {
        const live = await Live.open(daemon, 's', { hello: false });
        await until(() => live.closed, 'the end');
        assert.equal(live.closeCode, 1008);
    });
});

test('without free descriptors there is still an answer', async () => {
    const tight = await startDaemon({ driver: 'null', limits: 'ulimit -n 64' });
    try {
        const peers = Array.from({ length: 100 }, () => connect(tight));
        peers.forEach((peer) => peer.socket.write('GET /healthz HTTP/1.1\r\n'));
        await until(() => peers.some((peer) => peer.statuses()[0] === 503), 'a 503');
        peers.forEach((peer) => peer.close());
        await until(async () => {
            const answer = await fetch(`${tight.url}/healthz`).catch(() => null);
            return answer?.status === 200;
        }, 'recovery');
        assert.ok((await counter(tight, 'connections_over_descriptors_total')) > 0);
    } finally {
        await tight.stop();
    }
});
