// SPDX-License-Identifier: MIT
// Who is who. One of two authors is hostile and knows all that the server tells everybody: it can
// neither be the other, nor undo, end or block what is the other's.
import assert from 'node:assert/strict';
import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, beforeEach, describe, test } from 'node:test';
import { ask, makeDirectory, removeDirectory, startDaemon, until } from '../support/daemon.mjs';
import { Live } from '../support/live.mjs';

const NAME = '/nodes/ball/name';
const DOCUMENT = {
    format: 'fieldcast/1',
    root: { id: 'root', type: 'union', children: [{ id: 'ball', type: 'sphere' }] },
};
const PAGES = ['', '/image.png?width=8&height=8', '/poster.jpg'];

const data = makeDirectory();
const start = () => startDaemon({ data, driver: 'null', args: ['--log-level', 'debug'] });
let daemon;
let logs = '';
let scene;
let made = 0;
let victim;
let hostile;

const open = (options) => Live.open(daemon, scene, options);
const name = async () => (await ask(daemon, 'GET', `/v1/scenes/${scene}`)).root.children[0].name;
const applied = (live, edit) => live.next('applied', { edit, durable: true });

before(async () => {
    daemon = await start();
});
after(async () => {
    await daemon.stop();
    removeDirectory(data);
});

/* The victim has a step to undo and one to redo, all of which the hostile one has seen. */
beforeEach(async () => {
    made += 1;
    scene = `s${made}`;
    await ask(daemon, 'POST', `/v1/scenes?id=${scene}`, DOCUMENT);
    [victim, hostile] = [await open(), await open()];
    await applied(victim, victim.set(NAME, 'one'));
    await applied(victim, victim.set(NAME, 'two'));
    await applied(victim, victim.step('undo'));
    await hostile.next('changed', { revision: 4 });
});

async function close() {
    await Promise.all([victim.close(), hostile.close()]);
}

async function restart(end) {
    await close();
    await end();
    logs += daemon.errors;
    daemon = await start();
}

/** The victim goes on as if nothing had been. */
async function assertUnharmed() {
    assert.equal(victim.closed, false);
    assert.equal(victim.find('bye'), undefined);
    assert.equal(await name(), 'one');
    await applied(victim, victim.step('redo'));
    assert.equal(await name(), 'two');
}

async function assertRefused(client, key) {
    const live = await open({ client, key });
    const notice = live.find('notice');
    assert.deepEqual([notice.level, notice.code, notice.place], ['error', 'forbidden', '/key']);
    assert.equal(live.find('bye').reason, 'forbidden');
    assert.equal(live.find('bye').retry_ms, undefined);
    assert.equal(live.closeCode, 1008);
    assert.deepEqual(live.messages.map(({ type }) => type), ['notice', 'bye']);
}

/** All that a client without a secret can find out. */
async function everythingTold() {
    const texts = [JSON.stringify(hostile.messages)];
    const addresses = ['/v1/scenes', '/v1/schema.json', '/v1/examples', '/v1/assets', '/metrics', '/readyz', '/'];
    for (const at of [...addresses, ...PAGES.map((page) => `/v1/scenes/${scene}${page}`)]) {
        const answer = await fetch(daemon.url + at);
        texts.push(JSON.stringify([...answer.headers]), Buffer.from(await answer.arrayBuffer()).toString('latin1'));
    }
    return texts.join('\n');
}

describe('what is told', () => {
    test('a key to its client alone, and no client to anybody', async () => {
        const { author, key } = victim.welcome;
        assert.match(key, /^[0-9a-f]{32}$/);
        assert.notEqual(hostile.welcome.key, key);
        assert.notEqual(hostile.welcome.author, author);
        assert.equal(hostile.find('changed').author, author);
        const told = await everythingTold();
        assert.ok(told.includes(author));
        for (const secret of [key, victim.client]) {
            assert.ok(!told.includes(secret), `${secret} is told`);
        }
        await close();
    });

    test('skipped operations name nobody', async () => {
        await applied(hostile, hostile.set(NAME, 'mine'));
        await applied(victim, victim.set(NAME, 'theirs'));
        const { skipped } = await hostile.next('rejected', { edit: hostile.step('undo') });
        assert.deepEqual(skipped, [{ op: 'set', at: NAME, value: 'one' }]);
        await close();
    });

    test('no key stands in the log or on the disk', async () => {
        const keys = [victim, hostile].map((live) => live.welcome.key);
        await restart(() => daemon.stop());
        const files = fs.readdirSync(data).map((file) => fs.readFileSync(path.join(data, file)).toString('latin1'));
        for (const key of keys) {
            assert.ok(!logs.includes(key) && !files.some((file) => file.includes(key)));
        }
        assert.ok(files.some((file) => file.includes(crypto.createHash('sha256').update(keys[0]).digest('hex'))));
    });

    test('the public author stays the same over connections and restarts', async () => {
        const { author, key } = victim.welcome;
        await restart(() => daemon.kill());
        const back = await open({ client: victim.client });
        assert.match(author, /^[0-9a-f]{16}$/);
        assert.deepEqual([back.welcome.author, back.welcome.key], [author, key]);
        await back.close();
    });
});

describe('a hostile author', () => {
    test('cannot take over who is connected, even by the client that it guessed', async () => {
        const { author, session } = victim.welcome;
        const digest = crypto.createHash('sha256').update(victim.welcome.key).digest('hex').slice(0, 32);
        for (const key of [null, hostile.welcome.key, '0'.repeat(32), author.repeat(2), session.repeat(2), digest]) {
            await assertRefused(victim.client, key);
        }
        await assertUnharmed();
        await close();
    });

    test('cannot take over who has left, nor after a restart', async () => {
        await victim.close();
        await assertRefused(victim.client, null);
        await assertRefused(victim.client, hostile.welcome.key);
        await restart(() => daemon.kill());
        await assertRefused(victim.client, null);
        victim = await open({ client: victim.client });
        assert.deepEqual([victim.welcome.last_edit, victim.welcome.undo, victim.welcome.redo], [3, 1, 1]);
        await assertUnharmed();
        await close();
    });

    test('cannot undo or redo what is another’s, by whatever name is told', async () => {
        const { author, session } = victim.welcome;
        for (const client of [author, session, hostile.client]) {
            const live = client === hostile.client ? hostile : await open({ client, key: null });
            assert.deepEqual([live.welcome.last_edit, live.welcome.undo, live.welcome.redo], [0, 0, 0]);
            for (const type of ['undo', 'redo']) {
                assert.equal((await live.next('rejected', { edit: live.step(type) })).code, 'not_found');
            }
            await live.close();
        }
        await assertUnharmed();
        await close();
    });

    test('cannot end another’s connection', async () => {
        for (const client of [victim.client, victim.welcome.author, victim.welcome.session]) {
            const live = await open({ client, key: null });
            await live.close();
        }
        await assertUnharmed();
        await close();
    });

    test('cannot block another by numbers, and not even itself', async () => {
        const most = hostile.edit + 1000;
        for (const edit of [Number.MAX_SAFE_INTEGER, most + 1]) {
            hostile.say({ type: 'edit', edit, ops: [{ op: 'set', at: NAME, value: 'far' }] });
            const answered = () => hostile.find('rejected', { edit }) ?? hostile.find('applied', { edit });
            const { code, place, message } = await until(answered, 'an answer');
            assert.deepEqual([code, place], ['limit', '/edit']);
            assert.ok(message.includes(`${edit} is above the maximum ${most}`), message);
        }
        await assertUnharmed();
        hostile.edit = most - 1;
        await applied(hostile, hostile.set(NAME, 'near'));
        await applied(victim, victim.set(NAME, 'three'));
        await close();
    });

    test('cannot read another’s key by saying hello with what is no key', async () => {
        for (const key of ['', 'x', '%00', '0'.repeat(31), 'G'.repeat(32), '0'.repeat(64)]) {
            const live = await open({ hello: false });
            live.say({ type: 'hello', client: victim.client, key });
            const { type, place } = await until(() => live.find('notice') ?? live.find('welcome'), 'an answer');
            assert.deepEqual([type, place], ['notice', '/key']);
            await live.close();
        }
        await assertUnharmed();
        await close();
    });
});

describe('a key', () => {
    test('brings back its client while the older connection still stands', async () => {
        const again = await open({ client: victim.client });
        assert.equal((await victim.next('bye')).reason, 'replaced');
        assert.deepEqual([again.welcome.undo, again.welcome.redo], [1, 1]);
        await again.close();
        await close();
    });

    test('is asked for only where there is something to lose', async () => {
        const visitor = await open();
        await assertRefused(visitor.client, null);
        await visitor.close();
        const next = await open({ client: visitor.client, key: null });
        assert.notEqual(next.welcome.key, visitor.welcome.key);
        await next.close();
        await close();
    });

    test('is kept by a client that is new to a scene', async () => {
        const { key } = hostile.welcome;
        const other = `${scene}-other`;
        await ask(daemon, 'POST', `/v1/scenes?id=${other}`, DOCUMENT);
        const live = await Live.open(daemon, other, { client: hostile.client, key });
        assert.equal(live.welcome.key, key);
        await applied(live, live.set(NAME, 'x'));
        await live.close();
        await close();
    });
});

test('the edits of many numbers that were refused do not wear out a client', async () => {
    const { revision } = await applied(hostile, hostile.set(NAME, 'first'));
    for (let i = 0; i < 1500; i += 1) {
        hostile.change(i % 2 ? [{ op: 'remove', at: '/nodes/root' }] : 'no list');
        if (i % 100 === 99) {
            await hostile.next('rejected', { edit: hostile.edit });
        }
    }
    const last = await applied(hostile, hostile.set(NAME, 'last'));
    assert.equal(last.revision, revision + 1);
    await until(async () => (await name()) === 'last', 'the edit');
    await close();
});
