// SPDX-License-Identifier: MIT
// Strangers with a token in the wrong place, methods that do more than they should, and paths that
// lead out of the page: what each is told, byte by byte as it was sent.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { ask, logged, makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';

const token = 'a-token-that-only-tests-know';
const scratch = makeDirectory();
let open; // without a token
let guarded;
before(async () => {
    fs.writeFileSync(path.join(scratch, 'token'), token);
    open = await startDaemon({ driver: 'null' });
    guarded = await startDaemon({ driver: 'null', args: ['--log-level', 'debug', '--token-file', path.join(scratch, 'token')] });
});
after(async () => {
    await open.stop();
    await guarded.stop();
    removeDirectory(scratch);
});

/** The whole answer to one request on a connection of its own. */
const exchange = (daemon, line, fields = '') =>
    new Promise((done, fail) => {
        let text = '';
        const socket = net.connect(daemon.port, '127.0.0.1');
        socket.on('data', (bytes) => (text += bytes.toString('latin1')));
        socket.on('end', () => done(text));
        socket.on('error', fail);
        socket.write(`${line} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n${fields}\r\n`);
    });
const statusOf = (text) => Number(/^HTTP\/1\.1 (\d+)/.exec(text)?.[1]);

test('a token counts once, whole and in its place', async () => {
    const bearer = `Authorization: Bearer ${token}\r\n`;
    for (const [what, at, fields, status] of [
        ['as it should be', '/v1/scenes', bearer, 200],
        ['doubled', '/v1/scenes', bearer + bearer, 400],
        ['behind another one', '/v1/scenes', `Authorization: Bearer ${token}x\r\n${bearer}`, 400],
        ['twice in one field', '/v1/scenes', `Authorization: Bearer ${token}, Bearer ${token}\r\n`, 401],
        ['twice in one value', '/v1/scenes', `Authorization: Bearer ${token} ${token}\r\n`, 401],
        ['without its scheme', '/v1/scenes', `Authorization: ${token}\r\n`, 401],
        ['in the query', `/v1/scenes?token=${token}`, '', 401],
        ['in the query, as OAuth had it', `/v1/scenes?access_token=${token}`, '', 401],
        ['in a cookie', '/v1/scenes', `Cookie: token=${token}; Authorization=Bearer ${token}\r\n`, 401],
        ['as a subprotocol of no handshake', '/v1/scenes?x', `X-Authorization: Bearer ${token}\r\n`, 401],
    ]) {
        assert.equal(statusOf(await exchange(guarded, `GET ${at}`, fields)), status, what);
    }
    await logged(guarded, /GET \/v1\/scenes 401[^]*GET \/v1\/scenes 401/);
    assert.equal(guarded.errors.includes(token), false, 'the token is in the log');
});

test('TRACE tells nothing back, CONNECT leads nowhere, no header changes the method', async () => {
    const secret = 'X-Secret: said-to-nobody\r\n';
    for (const [line, status] of [
        ['TRACE /', 405],
        ['TRACE /healthz', 405],
        ['TRACE /v1/scenes', 405],
        ['CONNECT /', 405],
        ['CONNECT example.com:80', 400],
        ['CONNECT 127.0.0.1:22', 400],
    ]) {
        const text = await exchange(open, line, secret);
        assert.equal(statusOf(text), status, line);
        assert.equal(text.includes('said-to-nobody'), false, line);
    }
    await ask(open, 'POST', '/v1/scenes?id=kept', { from: 'example:first-steps' });
    for (const name of ['X-HTTP-Method-Override', 'X-HTTP-Method', 'X-Method-Override']) {
        assert.equal(statusOf(await exchange(open, 'GET /v1/scenes/kept?_method=DELETE', `${name}: DELETE\r\n`)), 200, name);
    }
    assert.equal(statusOf(await exchange(open, 'GET /v1/scenes/kept')), 200);
});

test('no path leads out of the page, and none becomes a header', async () => {
    const up = ['..', '%2e%2e', '.%2e', '%252e%252e', '%c0%ae%c0%ae', '....', '..;', '%u002e%u002e'];
    const paths = [
        ...up.flatMap((one) => [`/${one}/${one}/etc/passwd`, `/assets/${one}/${one}/etc/passwd`, `/s/${one}/${one}/etc/passwd`]),
        ...['/..\\..\\etc\\passwd', '/%5c..%5c..%5cetc%5cpasswd', '//etc/passwd', '///etc/passwd', '/..%2f..%2fetc/passwd'],
        ...['/v1/examples/../../etc/passwd', '/v1/assets/../../etc/passwd', '/v1/reference/../etc/passwd.jpg', '/./etc/passwd'],
        ...['/%00', '/index.html%00.js', '/%0d%0aX-Split:%20yes', '/v1/scenes/%0d%0aX-Split:%20yes', '/?a=%0d%0aX-Split:%20yes'],
    ];
    for (const at of paths) {
        const text = await exchange(open, `GET ${at}`);
        assert.ok([400, 404].includes(statusOf(text)), `${at}: ${text.slice(0, 40)}`);
        assert.equal(/root:|\r\nX-Split:/.test(text), false, at);
    }
});
