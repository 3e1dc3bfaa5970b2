// SPDX-License-Identifier: MIT
// What clients say that they have and can read: tags and codings. Single requests are in site.test.
import assert from 'node:assert/strict';
import http from 'node:http';
import { after, before, test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { startDaemon } from '../support/daemon.mjs';

let daemon;
before(async () => {
    daemon = await startDaemon({ ready: false });
});
after(() => daemon.stop());

/** By no more headers than these. */
const get = (at, headers = {}) =>
    new Promise((done, fail) => {
        const call = http.get(daemon.url + at, { headers, agent: false }, (answer) => {
            const parts = [];
            answer.on('data', (bytes) => parts.push(bytes));
            answer.on('end', () => done({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(parts) }));
        });
        call.on('error', fail);
    });

test('the schema is not sent again to who has it', async () => {
    const at = '/v1/schema.json';
    const { etag } = (await get(at)).headers;
    const known = await get(at, { 'If-None-Match': etag });
    assert.deepEqual([known.status, known.headers.etag, known.body.length], [304, etag, 0]);
    const other = await get(at, { 'If-None-Match': `x${etag}` });
    assert.equal(other.status, 200);
    assert.ok(JSON.parse(other.body)['x-fieldcast']);
});

const CODINGS = {
    gzip: ['gzip', 'GZIP', 'deflate, gzip', 'gzip;q=0.001', 'br;q=1, gzip ; q=0.5', '*', 'identity;q=0, *;q=0.1'],
    identity: [undefined, '', 'identity', 'br', 'gzip;q=0', 'gzip; Q=0.000, deflate', '*;q=0', '*, gzip;q=0', 'gzip;q=0, *', 'xgzip', 'gzipx'],
};

test('files of the page are compressed for those alone who ask for that', async () => {
    const whole = await get('/');
    assert.equal(whole.status, 200, 'the program has a page');
    assert.equal(whole.headers['content-encoding'], undefined);
    const script = /src="(\/assets\/[^"]+\.js)"/.exec(whole.body)[1];
    for (const at of ['/', script]) {
        const plain = (await get(at)).body;
        for (const [coding, fields] of Object.entries(CODINGS)) {
            for (const field of fields) {
                const { status, headers, body } = await get(at, field === undefined ? {} : { 'Accept-Encoding': field });
                const compressed = headers['content-encoding'] === 'gzip';
                const seen = { status, vary: headers.vary, coding: headers['content-encoding'] ?? 'identity' };
                assert.deepEqual(seen, { status: 200, vary: 'Accept-Encoding', coding }, `${at}, ${field}`);
                assert.ok((compressed ? gunzipSync(body) : body).equals(plain), `${at}, ${field}`);
                assert.ok(compressed ? body.length < plain.length : body.length === plain.length);
            }
        }
    }
});
