// SPDX-License-Identifier: MIT
// The texts of Nicolas Seriot's JSONTestSuite (MIT licence, github.com/nst/JSONTestSuite), whose names say
// whether they are JSON: n_, no; y_, yes. What is none is refused with its place, and what is one is read,
// but for ten that limits of ours refuse.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { ask, startDaemon } from '../support/daemon.mjs';

const texts = Object.entries(JSON.parse(fs.readFileSync(new URL('../support/json_suite.json', import.meta.url), 'utf8')));
const LIMITS = {
    y_number: 'limit',
    y_number_double_close_to_zero: 'limit',
    y_number_real_capital_e: 'limit',
    y_number_real_exponent: 'limit',
    y_number_real_fraction_exponent: 'limit',
    y_object_duplicated_key: 'syntax',
    y_object_duplicated_key_and_value: 'syntax',
    y_object_escaped_null_in_key: 'syntax',
    y_object_extreme_numbers: 'limit',
    y_string_null_escape: 'syntax',
};

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null', ready: false });
});
after(() => daemon.stop());

/** The bytes of a text; where it is no UTF-8 the file has U+FFFD. */
function bytesOf(name, text) {
    const whole = typeof text === 'string' ? text : text.repeat.repeat(text.times);
    const bytes = Buffer.from(whole);
    return name.startsWith('n_') ? Buffer.from(bytes.toString('latin1').replaceAll('\xef\xbf\xbd', '\xe5'), 'latin1') : bytes;
}

/** What is said of it as JSON: none of these documents is a scene. */
async function verdictOf(name, text) {
    const answer = await fetch(`${daemon.url}/v1/scenes`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: bytesOf(name, text) });
    const { code, place } = await answer.json();
    assert.ok(answer.status === 400 || answer.status === 422, `${name}: ${answer.status}`);
    const refused = code === 'syntax' || code === 'limit';
    if (refused) {
        assert.match(place, /^line [1-9]\d*, column [1-9]\d*$/, name);
    }
    return refused ? code : 'read';
}

for (const [kind, count, what] of [
    ['n_', 188, 'what is no JSON is refused'],
    ['y_', 95, 'what is JSON is read, but for ten limits'],
]) {
    test(what, async () => {
        const own = texts.filter(([name]) => name.startsWith(kind));
        assert.equal(own.length, count);
        for (const [name, text] of own) {
            const verdict = await verdictOf(name, text);
            assert.ok(kind === 'n_' ? verdict !== 'read' : verdict === (LIMITS[name] ?? 'read'), `${name}: ${verdict}`);
        }
    });
}

test('the daemon goes on', async () => {
    assert.deepEqual((await ask(daemon, 'GET', '/v1/scenes')).scenes, []);
});
