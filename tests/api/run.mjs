// SPDX-License-Identifier: MIT
// Runs the requests in *.test here and compares the answers. Each file has a daemon of its own;
// its cases run in order and see what earlier ones left.
//
//   === title                 lines from here to `---` are the request: METHOD PATH, headers,
//   GET /v1/scenes            an empty line, the body
//   ---
//   200                       the answer: status, headers (absent: `Name: -`), an empty line, the
//   Content-Type: /json/      body. /.../ is a regular expression. A body in JSON is compared
//                             member by member, so members that are not named may be there.
//   {"scenes": []}            `(empty)`: no body.
//
// `# args: ...` at the top adds arguments of the daemon. {{repeat N TEXT}} repeats,
// {{file PATH}} is a file of the repository, {{text PATH}} the same as a JSON string, {{token}} the
// token behind {{token-file}}, {{port}} the port.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';

const here = path.dirname(new URL(import.meta.url).pathname);
const root = path.dirname(path.dirname(here));
const token = 'a-token-that-only-tests-know';

function expand(text, daemon) {
    return text
        .replace(/\{\{repeat (\d+) (.*?)\}\}/g, (_, count, what) => what.repeat(Number(count)))
        .replace(/\{\{file (\S+)\}\}/g, (_, name) => fs.readFileSync(path.join(root, name), 'utf8'))
        .replace(/\{\{text (\S+)\}\}/g, (_, name) =>
            JSON.stringify(fs.readFileSync(path.join(root, name), 'utf8')),
        )
        .replaceAll('{{token}}', token)
        .replaceAll('{{port}}', String(daemon?.port));
}

function splitMessage(text) {
    const at = text.indexOf('\n\n');
    const head = (at < 0 ? text : text.slice(0, at)).split('\n').filter(Boolean);
    return { first: head[0], headers: head.slice(1), body: at < 0 ? '' : text.slice(at + 2).trim() };
}

function readFile(name) {
    const text = fs.readFileSync(path.join(here, name), 'utf8');
    const args = /^# args: (.*)$/m.exec(text)?.[1].split(' ') ?? [];
    const cases = text
        .split(/^=== /m)
        .slice(1)
        .map((block) => {
            const end = block.indexOf('\n');
            const [request, answer] = block.slice(end + 1).split(/^---\n/m);
            return { title: block.slice(0, end), request: request.trim(), answer: answer.trim() };
        });
    return { args, cases };
}

function exchange(daemon, request) {
    const { first, headers, body } = splitMessage(request);
    const [method, at] = first.split(' ');
    const fields = {};
    for (const [name, value] of headers.map((h) => h.split(/:\s*(.*)/s))) {
        fields[name] = name in fields ? [fields[name], value].flat() : value; // a list: several lines
    }
    return new Promise((done, fail) => {
        const call = http.request(
            { host: '127.0.0.1', port: daemon.port, method, path: at, headers: fields, agent: false },
            (answer) => {
                const parts = [];
                answer.on('data', (bytes) => parts.push(bytes));
                answer.on('end', () =>
                    done({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(parts) }),
                );
            },
        );
        call.on('error', fail);
        call.end(body);
    });
}

function compareText(actual, expected, what) {
    const pattern = /^\/(.*)\/$/s.exec(expected);
    if (pattern) {
        assert.match(String(actual), new RegExp(pattern[1], 's'), what);
    } else {
        assert.equal(String(actual), expected, what);
    }
}

function compareJson(actual, expected, place) {
    if (typeof expected === 'string') {
        compareText(actual, expected, place);
    } else if (Array.isArray(expected)) {
        assert.equal(actual?.length, expected.length, `${place}.length`);
        expected.forEach((value, i) => compareJson(actual[i], value, `${place}/${i}`));
    } else if (expected && typeof expected === 'object') {
        assert.ok(actual && typeof actual === 'object', `${place} is no object`);
        for (const [name, value] of Object.entries(expected)) {
            compareJson(actual[name], value, `${place}/${name}`);
        }
    } else {
        assert.equal(actual, expected, place);
    }
}

function compareBody(actual, expected) {
    if (expected === '(empty)') {
        assert.equal(actual.length, 0, 'the body is not empty');
    } else if (/^[[{]/.test(expected)) {
        compareJson(JSON.parse(actual.toString()), JSON.parse(expected), '');
    } else if (expected) {
        compareText(actual.toString('latin1'), expected, 'body');
    }
}

function compare(answer, expectedText) {
    const expected = splitMessage(expectedText);
    const shown = `${answer.status} ${answer.body.toString('latin1').slice(0, 400)}`;
    compareText(answer.status, expected.first, shown);
    for (const line of expected.headers) {
        const [name, value] = line.split(/:\s*(.*)/s);
        const actual = answer.headers[name.toLowerCase()];
        if (value === '-') {
            assert.equal(actual, undefined, `${name} is there: ${actual}`);
        } else {
            assert.ok(actual !== undefined, `${name} is missing`);
            compareText(actual, value, name);
        }
    }
    compareBody(answer.body, expected.body);
}

for (const name of fs.readdirSync(here).filter((file) => file.endsWith('.test'))) {
    describe(name, () => {
        const { args, cases } = readFile(name);
        const scratch = makeDirectory();
        let daemon;
        before(async () => {
            fs.writeFileSync(path.join(scratch, 'token'), `${token}\n`);
            daemon = await startDaemon({
                driver: 'null',
                args: args.map((arg) => arg.replace('{{token-file}}', path.join(scratch, 'token'))),
            });
        });
        after(async () => {
            await daemon?.stop();
            removeDirectory(scratch);
        });
        for (const { title, request, answer } of cases) {
            test(title, async () => {
                compare(await exchange(daemon, expand(request, daemon)), expand(answer, daemon));
            });
        }
    });
}
