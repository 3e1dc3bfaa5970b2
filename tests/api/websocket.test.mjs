// SPDX-License-Identifier: MIT
// RFC 6455 as a hostile or careless client sees it. Numbers in the names are those of the cases that
// the Autobahn suite has of the same rule. What a server would echo there is, here, an edit that gives
// the scene a name: the text has come through if the scene has it.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { ask, startDaemon, until } from '../support/daemon.mjs';
import { BINARY, CLOSE, CONTINUATION, fragments, frame, octets, Peer, PING, PONG, reason, TEXT } from '../support/peer.mjs';

let daemon;
before(async () => {
    daemon = await startDaemon({ driver: 'null' });
    await ask(daemon, 'POST', '/v1/scenes?id=s', { from: 'example:first-steps' });
});
after(() => daemon.stop());

const bytes = (hex) => Buffer.from(hex.replaceAll(' ', ''), 'hex');

/** Text before and behind of what the scene shall be named. */
const before_name = '{"type":"edit","edit":1,"ops":[{"op":"set","at":"/name","value":"';
const behind_name = '"}]}';
const naming = (name) => Buffer.concat([Buffer.from(before_name), Buffer.from(name), Buffer.from(behind_name)]);

/** In `count` parts that are as long as each other. */
function inParts(whole, count) {
    const size = Math.ceil(whole.length / count);
    return Array.from({ length: count }, (_, i) => whole.subarray(i * size, (i + 1) * size));
}

/** Sends frames that make up naming(name); true when the server has understood them. */
async function understands(peer, name, buffers, cut) {
    await peer.send(buffers, cut);
    await until(() => peer.told('applied') || peer.ended || peer.of(CLOSE).length > 0, 'the edit');
    assert.equal(peer.told('applied')?.edit, 1, `${JSON.stringify(peer.close)}`);
    assert.equal((await ask(daemon, 'GET', '/v1/scenes/s')).name, Buffer.from(name).toString());
}

/** The connection still does what it should. */
async function lives(peer) {
    const pongs = peer.of(PONG).length;
    await peer.send(frame(PING, 'alive'));
    await until(() => peer.of(PONG).length > pongs || peer.ended, 'a pong');
    assert.equal(peer.of(PONG).at(-1)?.payload.toString(), 'alive');
    assert.equal(peer.close.code, null);
}

/** Ends with the code, as the last that the server says, and without a reset. */
async function isClosed(peer, code) {
    assert.equal((await peer.end()).code, code);
    assert.equal(peer.frames.at(-1).opcode, CLOSE);
    assert.equal(peer.error, null);
}

/**
 * Ends at once. Where the library judges a frame, it closes the socket right behind its close frame,
 * and what is unread then may make a reset that eats it.
 */
async function isCut(peer, code) {
    const { code: said } = await peer.end();
    assert.ok(said === code || said === null, `${said}`);
    assert.equal(peer.told('applied'), undefined);
}

/** A case on a connection of its own, whole and in pieces. */
function cases(number, what, run, { cuts = [0, 1] } = {}) {
    for (const cut of cuts) {
        test(`${number} ${what}${cut ? `, ${cut} byte at a time` : ''}`, async () => {
            const peer = await Peer.open(daemon, 's');
            try {
                await run(peer, cut);
            } finally {
                peer.destroy();
            }
        });
    }
}

describe('pings', () => {
    for (const [number, payload] of [['2.1', ''], ['2.2', 'Hello, world!'], ['2.3', bytes('00 ff fe fd fc fb 00 ff')], ['2.4', 'x'.repeat(125)]]) {
        cases(number, `of ${payload.length} bytes`, async (peer, cut) => {
            await peer.send(frame(PING, payload), cut);
            await until(() => peer.of(PONG).length || peer.ended, 'a pong');
            assert.deepEqual(peer.of(PONG)[0].payload, Buffer.from(payload));
        });
    }

    cases('2.7-2.9', 'pongs that nobody asked for', async (peer, cut) => {
        await peer.send([frame(PONG), frame(PONG, 'unsolicited'), frame(PING, 'alive')], cut);
        await until(() => peer.of(PONG).length || peer.ended, 'a pong');
        assert.deepEqual(peer.of(PONG).map(({ payload }) => payload.toString()), ['alive']);
    });
});

describe('reserved bits and opcodes', () => {
    for (const reserved of [1, 2, 3, 4, 5, 6, 7]) {
        cases(`3.${reserved}`, `reserved bits ${reserved}`, async (peer, cut) => {
            await peer.send(frame(TEXT, 'x', { reserved }), cut);
            await isCut(peer, 1002);
        });
    }
    for (const opcode of [3, 4, 5, 6, 7, 11, 12, 13, 14, 15]) {
        cases(`4.${opcode}`, `opcode ${opcode}`, async (peer, cut) => {
            await peer.send(frame(opcode), cut);
            await isCut(peer, 1002);
        });
    }
});

describe('fragments', () => {
    const name = 'in fragments';
    const halves = () => fragments(inParts(naming(name), 2));
    const both = { cuts: [0, 1] };

    for (const [number, opcode] of [['5.1', PING], ['5.2', PONG]]) {
        cases(number, 'a control frame in two', async (peer, cut) => {
            await peer.send(fragments(['a', 'b'], opcode), cut);
            await isCut(peer, 1002);
        });
    }

    cases('5.3-5.5', 'a text in two', (peer, cut) => understands(peer, name, halves(), cut), both);

    cases('5.6-5.8', 'a ping between two', async (peer, cut) => {
        const [first, second] = halves();
        await understands(peer, name, [first, frame(PING, 'between'), second], cut);
        assert.deepEqual(peer.of(PONG).map(({ payload }) => payload.toString()), ['between']);
    });

    for (const [number, final] of [['5.9-5.11', true], ['5.12-5.14', false]]) {
        cases(number, `a continuation of nothing, final ${final}`, async (peer, cut) => {
            await peer.send([frame(CONTINUATION, 'x', { final }), frame(TEXT, naming(name))], cut);
            await isCut(peer, 1002);
        });
    }

    cases('5.15', 'a continuation behind a whole message', async (peer) => {
        await understands(peer, name, halves());
        await peer.send([frame(CONTINUATION, 'x', { final: false }), frame(TEXT, naming('y'))]);
        const { code } = await peer.end();
        assert.ok(code === 1002 || code === null, `${code}`);
        assert.equal((await ask(daemon, 'GET', '/v1/scenes/s')).name, name);
    }, { cuts: [0] });

    for (const [number, final] of [['5.16', false], ['5.17', true]]) {
        cases(number, `a continuation of nothing twice, final ${final}`, async (peer, cut) => {
            const once = [frame(CONTINUATION, 'x', { final }), ...halves()];
            await peer.send([...once, ...once], cut);
            await isCut(peer, 1002);
        });
    }

    cases('5.18', 'a second text instead of a continuation', async (peer, cut) => {
        const [first, second] = inParts(naming(name), 2);
        await peer.send([frame(TEXT, first, { final: false }), frame(TEXT, second)], cut);
        await isCut(peer, 1002);
    });

    cases('5.19-5.20', 'a text in five with two pings between', async (peer, cut) => {
        const parts = fragments(inParts(naming(name), 5));
        await peer.send([parts[0], parts[1], frame(PING, '1')], cut);
        await until(() => peer.of(PONG).length === 1 || peer.ended, 'the first pong');
        await understands(peer, name, [parts[2], parts[3], frame(PING, '2'), parts[4]], cut);
        assert.deepEqual(peer.of(PONG).map(({ payload }) => payload.toString()), ['1', '2']);
    });

    cases('5.21', 'a text with empty parts', async (peer, cut) => {
        const [first, second] = inParts(naming(name), 2);
        await understands(peer, name, fragments(['', first, '', second, '']), cut);
    });
});

// Section 6 by its own tables: what comes, in hexadecimal.
const VALID = {
    '6.2.4': ['Greek', 'ce ba e1 bd b9 cf 83 ce bc ce b5'],
    '6.5.1': ['text of four lengths', '48 65 6c 6c 6f 2d c2 b5 40 c3 9f c3 b6 c3 a4 c3 bc c3 a0 c3 a1 2d 55 54 46 2d 38 21 21 f0 9f 98 80'],
    '6.7.2': ['the first of two bytes that is no control', 'c2 a0'],
    '6.7.3': ['the first of three bytes', 'e0 a0 80'],
    '6.7.4': ['the first of four bytes', 'f0 90 80 80'],
    '6.9.1': ['the last of one byte that is no control', '7e'],
    '6.9.2': ['the last of two bytes', 'df bf'],
    '6.9.3': ['the last of three bytes', 'ef bf bf'],
    '6.9.4': ['the last of four bytes', 'f4 8f bf bf'],
    '6.11.1': ['U+D7FF', 'ed 9f bf'],
    '6.11.2': ['U+E000', 'ee 80 80'],
    '6.11.3': ['U+FFFD', 'ef bf bd'],
    '6.11.4': ['U+10FFFF', 'f4 8f bf bf'],
    '6.22.1': ['U+FFFE', 'ef bf be'],
    '6.22.2': ['U+FFFF', 'ef bf bf'],
    ...Object.fromEntries(
        Array.from({ length: 16 }, (_, i) => [`6.22.${i + 3}`, [`U+${(i + 1).toString(16)}FFFE`, Buffer.from(String.fromCodePoint(0x1fffe + 0x10000 * i)).toString('hex')]]),
    ),
    '6.23.1': ['the byte order mark', 'ef bb bf'],
};

const INVALID = {
    '6.3.1': ['a surrogate behind Greek', 'ce ba e1 bd b9 cf 83 ce bc ce b5 ed a0 80 65 64 69 74 65 64'],
    '6.8.1': ['the first of five bytes', 'f8 88 80 80 80'],
    '6.8.2': ['the first of six bytes', 'fc 84 80 80 80 80'],
    '6.10.1': ['the last of 21 bits', 'f7 bf bf bf'],
    '6.10.2': ['the last of five bytes', 'fb bf bf bf bf'],
    '6.10.3': ['the last of six bytes', 'fd bf bf bf bf bf'],
    '6.11.5': ['U+110000', 'f4 90 80 80'],
    '6.12.1': ['a continuation byte', '80'],
    '6.12.2': ['the last continuation byte', 'bf'],
    ...Object.fromEntries([2, 3, 4, 5, 6, 7].map((n) => [`6.12.${n + 1}`, [`${n} continuation bytes`, '80 bf '.repeat(4).slice(0, 3 * n)]])),
    '6.12.9': ['all continuation bytes', Buffer.from(Array.from({ length: 63 }, (_, i) => 0x80 + i)).toString('hex')],
    '6.13.1': ['lonely starts of two bytes', Buffer.from(Array.from({ length: 64 }, (_, i) => (i & 1 ? 0x20 : 0xc0 + i / 2))).toString('hex')],
    '6.13.2': ['lonely starts of three bytes', 'e0 20 e1 20 e8 20 ef 20'],
    '6.13.3': ['lonely starts of four bytes', 'f0 20 f4 20 f7 20'],
    '6.13.4': ['lonely starts of five bytes', 'f8 20 fb 20'],
    '6.13.5': ['lonely starts of six bytes', 'fc 20 fd 20'],
    '6.14.1': ['two bytes, the last missing', 'c0'],
    '6.14.2': ['three bytes, the last missing, overlong', 'e0 80'],
    '6.14.3': ['four bytes, the last missing, overlong', 'f0 80 80'],
    '6.14.4': ['five bytes, the last missing', 'f8 80 80 80'],
    '6.14.5': ['six bytes, the last missing', 'fc 80 80 80 80'],
    '6.14.6': ['the last of two, the last missing', 'df'],
    '6.14.7': ['the last of three, the last missing', 'ef bf'],
    '6.14.8': ['the last of four, the last missing', 'f7 bf bf'],
    '6.14.9': ['the last of five, the last missing', 'fb bf bf bf'],
    '6.14.10': ['the last of six, the last missing', 'fd bf bf bf bf'],
    '6.14.11': ['a good start, the last missing', 'f4 8f bf'],
    '6.15.1': ['all of these', 'c0 e0 80 f0 80 80 f8 80 80 80 fc 80 80 80 80 df ef bf f7 bf bf fb bf bf bf fd bf bf bf bf'],
    '6.16.1': ['fe', 'fe'],
    '6.16.2': ['ff', 'ff'],
    '6.16.3': ['fe and ff', 'fe fe ff ff'],
    '6.17.1': ['an overlong slash of two', 'c0 af'],
    '6.17.2': ['an overlong slash of three', 'e0 80 af'],
    '6.17.3': ['an overlong slash of four', 'f0 80 80 af'],
    '6.17.4': ['an overlong slash of five', 'f8 80 80 80 af'],
    '6.17.5': ['an overlong slash of six', 'fc 80 80 80 80 af'],
    '6.18.1': ['the last overlong of two', 'c1 bf'],
    '6.18.2': ['the last overlong of three', 'e0 9f bf'],
    '6.18.3': ['the last overlong of four', 'f0 8f bf bf'],
    '6.18.4': ['the last overlong of five', 'f8 87 bf bf bf'],
    '6.18.5': ['the last overlong of six', 'fc 83 bf bf bf bf'],
    '6.19.1': ['an overlong NUL of two', 'c0 80'],
    '6.19.2': ['an overlong NUL of three', 'e0 80 80'],
    '6.19.3': ['an overlong NUL of four', 'f0 80 80 80'],
    '6.19.4': ['an overlong NUL of five', 'f8 80 80 80 80'],
    '6.19.5': ['an overlong NUL of six', 'fc 80 80 80 80 80'],
    ...Object.fromEntries(
        ['ed a0 80', 'ed ad bf', 'ed ae 80', 'ed af bf', 'ed b0 80', 'ed be 80', 'ed bf bf'].map((hex, i) => [`6.20.${i + 1}`, ['a surrogate', hex]]),
    ),
    ...Object.fromEntries(
        ['ed a0 80 ed b0 80', 'ed a0 80 ed bf bf', 'ed ad bf ed b0 80', 'ed ad bf ed bf bf', 'ed ae 80 ed b0 80', 'ed ae 80 ed bf bf', 'ed af bf ed b0 80', 'ed af bf ed bf bf'].map(
            (hex, i) => [`6.21.${i + 1}`, ['a pair of surrogates', hex]],
        ),
    ),
};

describe('texts', () => {
    for (const [number, parts] of [['6.1.1', ['']], ['6.1.2', ['', '', '']]]) {
        cases(number, `nothing in ${parts.length}, as the first message`, async (peer, cut) => {
            await peer.send(fragments(parts), cut);
            await until(() => peer.told('notice') || peer.ended, 'an answer');
            assert.equal(peer.told('notice').code, 'syntax');
            await lives(peer);
        });
    }

    test('6.1.1 nothing, before hello', async () => {
        const peer = await Peer.open(daemon, 's', false);
        await peer.send(frame(TEXT));
        await until(() => peer.told('notice') || peer.ended, 'an answer');
        assert.equal(peer.told('notice').code, 'syntax');
        peer.destroy();
    });

    cases('6.1.3', 'nothing before and behind', (peer, cut) => understands(peer, 'x', fragments(['', naming('x'), '']), cut));

    for (const [number, [what, hex]] of Object.entries(VALID)) {
        cases(number, what, async (peer) => {
            const whole = naming(bytes(hex));
            await understands(peer, bytes(hex), fragments(octets(whole)));
        }, { cuts: [0] });
        cases(number, what, (peer, cut) => understands(peer, bytes(hex), frame(TEXT, naming(bytes(hex))), cut));
    }

    for (const [number, [what, hex]] of Object.entries(INVALID)) {
        cases(number, what, async (peer, cut) => {
            await peer.send(frame(TEXT, bytes(hex)), cut);
            await isClosed(peer, 1007);
        });
        cases(number, `${what}, in fragments`, async (peer, cut) => {
            await peer.send(fragments(octets(naming(bytes(hex)))), cut);
            await isClosed(peer, 1007);
            assert.equal(peer.told('applied'), undefined);
        }, { cuts: [0] });
    }

    // Every beginning of a text: those that end between two characters are texts.
    const whole = VALID['6.2.4'][1];
    for (let length = 1; length <= bytes(whole).length; length += 1) {
        const start = bytes(whole).subarray(0, length);
        const isText = Buffer.from(start.toString()).equals(start);
        cases(`6.6.${length}`, `the first ${length} bytes of Greek are ${isText ? 'a' : 'no'} text`, async (peer, cut) => {
            await peer.send(frame(TEXT, start), cut);
            if (!isText) {
                return isClosed(peer, 1007);
            }
            await until(() => peer.told('notice') || peer.ended, 'an answer');
            return lives(peer);
        });
    }

    cases('6.4.1', 'is closed before the text ends', async (peer, cut) => {
        const start = frame(TEXT, bytes(VALID['6.2.4'][1]), { final: false });
        await peer.send([start, frame(CONTINUATION, bytes('f4 90 80 80'), { final: false })], cut);
        await isClosed(peer, 1007);
    });

    cases('6.4.2', 'is closed at the byte that cannot be', async (peer, cut) => {
        const start = frame(TEXT, bytes('ce ba f4'), { final: false });
        await peer.send([start, frame(CONTINUATION, bytes('90'), { final: false })], cut);
        await isClosed(peer, 1007);
    });

    cases('6.4.3', 'is closed before the frame ends', async (peer, cut) => {
        const unfinished = frame(TEXT, Buffer.concat([bytes('ce ba f4 90 80 80'), Buffer.alloc(100, 'x')]));
        await peer.send(unfinished.subarray(0, 20), cut);
        await isClosed(peer, 1007);
    });

    cases('6.24', 'a character that begins in one text does not end in the next', async (peer) => {
        await peer.send(frame(TEXT, bytes('ce')));
        await isClosed(peer, 1007);
    }, { cuts: [0] });

    cases('6.25', 'no text is as good as none: bytes are refused', async (peer, cut) => {
        await peer.send(frame(BINARY, bytes('ff')), cut);
        await isClosed(peer, 1003);
    });
});

describe('closing', () => {
    cases('7.1.1', 'behind a message', async (peer) => {
        await understands(peer, 'x', frame(TEXT, naming('x')));
        await peer.send(frame(CLOSE, reason(1000)));
        await isClosed(peer, 1000);
    }, { cuts: [0] });

    cases('7.1.2', 'twice', async (peer, cut) => {
        await peer.send([frame(CLOSE, reason(1000)), frame(CLOSE, reason(1000))], cut);
        await isCut(peer, 1000);
        assert.ok(peer.of(CLOSE).length < 2);
    });

    cases('7.1.3', 'a ping behind it is not answered', async (peer, cut) => {
        await peer.send([frame(CLOSE, reason(1000)), frame(PING, 'late')], cut);
        await isCut(peer, 1000);
        assert.deepEqual(peer.of(PONG), []);
    });

    cases('7.1.4', 'a text behind it is not read', async (peer, cut) => {
        await peer.send([frame(CLOSE, reason(1000)), frame(TEXT, naming('late'))], cut);
        await isCut(peer, 1000);
        assert.notEqual((await ask(daemon, 'GET', '/v1/scenes/s')).name, 'late');
    });

    cases('7.1.5', 'between fragments', async (peer, cut) => {
        await peer.send([frame(TEXT, 'x', { final: false }), frame(CLOSE, reason(1000)), frame(CONTINUATION, 'y')], cut);
        await isCut(peer, 1000);
    });

    // Large ones are worked on apart, and their client rests behind them: the small ones wait unread.
    test('7.1.6 behind edits that are still worked on', async () => {
        const children = Array.from({ length: 2000 }, (_, i) => ({ id: `n${i}`, type: 'sphere', visible: i === 0 }));
        await ask(daemon, 'POST', '/v1/scenes?id=many', { format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
        const peer = await Peer.open(daemon, 'many', false);
        await peer.say({ type: 'hello', client: 'peer-with-large-edits' });
        const edits = Array.from({ length: 60 }, (_, i) => {
            const large = children.map(({ id }) => ({ op: 'set', at: `/nodes/${id}/params/radius`, value: 0.5 + i / 100 }));
            const small = { op: 'set', at: '/name', value: `edit ${i}` };
            return frame(TEXT, JSON.stringify({ type: 'edit', edit: i + 1, ops: i % 20 === 0 ? [...large, small] : [small] }));
        });
        await peer.send(Buffer.concat([...edits, frame(CLOSE, reason(1000))]));
        await isClosed(peer, 1000);
        assert.equal((await ask(daemon, 'GET', '/v1/scenes/many')).name, 'edit 59');
        const { scenes } = await ask(daemon, 'GET', '/v1/scenes');
        assert.equal(scenes.find(({ id }) => id === 'many').revision, 1 + edits.length);
    });

    cases('7.3.1', 'without a code', async (peer, cut) => {
        await peer.send(frame(CLOSE), cut);
        assert.ok([1000, 1005].includes((await peer.end()).code));
        assert.equal(peer.error, null);
    });

    for (const [number, text] of [['7.3.3', ''], ['7.3.4', 'a reason'], ['7.3.5', 'x'.repeat(123)]]) {
        cases(number, `with a reason of ${text.length} bytes`, async (peer, cut) => {
            await peer.send(frame(CLOSE, reason(1000, text)), cut);
            await isClosed(peer, 1000);
        });
    }

    for (const code of [1000, 1001, 1002, 1003, 1007, 1008, 1009, 1010, 1011, 3000, 3999, 4000, 4999]) {
        cases('7.7', `with ${code}`, async (peer) => {
            await peer.send(frame(CLOSE, reason(code)));
            await isClosed(peer, code);
        }, { cuts: [0] });
    }

    for (const code of [0, 999, 1004, 1005, 1006, 1016, 1100, 2000, 2999]) {
        cases('7.9', `with ${code}, which none may say`, async (peer) => {
            await peer.send(frame(CLOSE, reason(code)));
            await isCut(peer, 1002);
        }, { cuts: [0] });
    }
});

describe('the server closes', () => {
    // Everything that the client still says is read, so that no reset eats the close.
    const late = Buffer.concat(Array.from({ length: 60 }, () => frame(TEXT, 'z'.repeat(60000))));

    for (const [what, code, offence] of [
        ['over bytes', 1003, frame(BINARY, 'x')],
        ['over a text that is none', 1007, frame(TEXT, bytes('ff'))],
        ['over what is too long', 1009, frame(TEXT, '', { length: 2 ** 40 })],
    ]) {
        test(`${what}, and is heard while the client goes on talking`, async () => {
            const peer = await Peer.open(daemon, 's');
            await peer.send([offence, ...(code === 1009 ? [Buffer.alloc(late.length, 'x')] : [late])]);
            await until(() => peer.of(CLOSE).length || peer.ended, 'a close');
            assert.equal(peer.close.code, code);
            assert.equal(peer.error, null);
            peer.destroy();
        });
    }

    test('on who answers no ping, and not on who does', async () => {
        const { limits } = (await ask(daemon, 'GET', '/v1/schema.json'))['x-fieldcast'];
        assert.ok(limits.find(({ name }) => name === 'live_silence').value <= 15);
        const [dead, alive] = [await Peer.open(daemon, 's'), await Peer.open(daemon, 's')];
        let answered = 0;
        await until(() => {
            for (; answered < alive.of(PING).length; answered += 1) {
                alive.send(frame(PONG, alive.of(PING)[answered].payload));
            }
            return dead.ended || answered === 8;
        }, 'the end of the silent one');
        assert.ok(dead.ended && answered > 1 && !alive.ended, `after ${answered} pings`);
        await lives(alive);
        alive.destroy();
    });

    test('too many small parts', async () => {
        const peer = await Peer.open(daemon, 's');
        const part = frame(CONTINUATION, ' '.repeat(60000), { final: false });
        await peer.send([frame(TEXT, ' ', { final: false }), ...Array(20).fill(part)]);
        await isClosed(peer, 1009);
    });
});

// Frames are the library's business. What it does otherwise than the RFC asks; server/README.md lists it.
describe('what libwebsockets 4.1.6 does otherwise', () => {
    cases('5.1 of the RFC', 'frames without a mask are taken', (peer, cut) =>
        understands(peer, 'unmasked', frame(TEXT, naming('unmasked'), { masked: false }), cut));

    cases('2.10', 'of ten pings in flight some may not be answered', async (peer) => {
        await peer.send(Buffer.concat(Array.from({ length: 10 }, (_, i) => frame(PING, `${i}`))));
        await until(() => peer.of(PONG).length || peer.ended, 'a pong');
        await lives(peer);
        assert.ok(peer.of(PONG).length >= 2);
    }, { cuts: [0] });

    for (const [number, what, buffer] of [
        ['2.5', 'a ping of 126 bytes', frame(PING, 'x'.repeat(126))],
        ['7.3.6', 'a close of 126 bytes', frame(CLOSE, reason(1000, 'x'.repeat(124)))],
    ]) {
        cases(number, `${what} ends the connection, mostly without a close`, async (peer, cut) => {
            await peer.send(buffer, cut);
            const { code } = await peer.end();
            assert.ok(code === null || code === 1002, `${code}`);
        });
    }

    cases('7.3.2', 'a close of one byte is answered without a code', async (peer, cut) => {
        await peer.send(frame(CLOSE, 'x'), cut);
        assert.notEqual((await peer.end()).code, 1002);
    });

    cases('7.5.1', 'a reason that is no text is answered as if it were one', async (peer, cut) => {
        await peer.send(frame(CLOSE, reason(1000, bytes('ff'))), cut);
        await isClosed(peer, 1000);
    });

    cases('7.9', 'with 65535, which none may say, is answered by the same', async (peer) => {
        await peer.send(frame(CLOSE, reason(65535)));
        await isClosed(peer, 65535);
    }, { cuts: [0] });

    for (const code of [1012, 1013, 1014]) {
        cases('7.7', `with ${code}, which is newer than the library, is answered by 1002`, async (peer) => {
            await peer.send(frame(CLOSE, reason(code)));
            await isCut(peer, 1002);
        }, { cuts: [0] });
    }
});
