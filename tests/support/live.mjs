// SPDX-License-Identifier: MIT
// A small WebSocket client (RFC 6455) that shows everything: raw handshake, close codes, reading
// that can be stopped. For tests only.
import crypto from 'node:crypto';
import net from 'node:net';
import { heard, until } from './daemon.mjs';

const TEXT = 1;
const BINARY = 2;
const CLOSE = 8;
const PING = 9;
const PONG = 10;

/** Milliseconds as Date.now() has them, with fractions. */
export const now = () => performance.timeOrigin + performance.now();

export function encodeMessage(opcode, payload) {
    const mask = crypto.randomBytes(4);
    const head =
        payload.length < 126
            ? Buffer.from([0x80 | opcode, 0x80 | payload.length])
            : payload.length < 65536
              ? Buffer.from([0x80 | opcode, 0x80 | 126, payload.length >> 8, payload.length & 255])
              : Buffer.concat([Buffer.from([0x80 | opcode, 0x80 | 127]), longLength(payload.length)]);
    const masked = Buffer.from(payload);
    for (let i = 0; i < masked.length; i += 1) {
        masked[i] ^= mask[i & 3];
    }
    return Buffer.concat([head, mask, masked]);
}

function longLength(length) {
    const bytes = Buffer.alloc(8);
    bytes.writeBigUInt64BE(BigInt(length));
    return bytes;
}

/** One message or fragment at the start of `bytes`, or null. */
function decodeMessage(bytes) {
    if (bytes.length < 2) {
        return null;
    }
    const short = bytes[1] & 127;
    const head = short === 127 ? 10 : short === 126 ? 4 : 2;
    if (bytes.length < head) {
        return null;
    }
    const length =
        short === 127
            ? Number(bytes.readBigUInt64BE(2))
            : short === 126
              ? bytes.readUInt16BE(2)
              : short;
    if (bytes.length < head + length) {
        return null;
    }
    return {
        final: bytes[0] >= 128,
        opcode: bytes[0] & 15,
        payload: bytes.subarray(head, head + length),
        used: head + length,
    };
}

export function readFrameHeader(bytes) {
    return {
        codec: { 1: 'jpeg', 2: 'png', 5: 'guide' }[bytes[5]] ?? `?${bytes[5]}`,
        still: Boolean(bytes[6] & 2),
        lossless: Boolean(bytes[6] & 4),
        stale: Boolean(bytes[6] & 8),
        depths: Boolean(bytes[6] & 16),
        delta: Boolean(bytes[6] & 32),
        number: bytes.readUInt32LE(8),
        bytes: bytes.readUInt32LE(12),
        revision: Number(bytes.readBigUInt64LE(16)),
        seq: bytes.readUInt32LE(24),
        width: bytes.readUInt16LE(28),
        height: bytes.readUInt16LE(30),
        viewWidth: bytes.readUInt16LE(32),
        viewHeight: bytes.readUInt16LE(34),
        round: bytes[36],
        rounds: bytes[37],
        chain: bytes[38],
        link: bytes[39],
        version: bytes[4],
        stagesUs: Array.from({ length: bytes[7] }, (_, stage) => bytes.readUInt32LE(40 + 4 * stage)),
    };
}

export const handshake = (port, scene, headers = {}) =>
    Object.entries({
        Host: `127.0.0.1:${port}`,
        Upgrade: 'websocket',
        Connection: 'Upgrade',
        'Sec-WebSocket-Version': '13',
        'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==',
        'Sec-WebSocket-Protocol': 'fieldcast.v1',
        ...headers,
    })
        .filter(([, value]) => value !== null)
        .reduce((text, [name, value]) => `${text}${name}: ${value}\r\n`, `GET /v1/scenes/${scene}/live HTTP/1.1\r\n`) +
    '\r\n';

/** What each client was told, as a page keeps it beside its author. */
const keys = new Map();

/**
 * A live connection. `messages` and `frames` hold what came, in order; frames are acknowledged at
 * once unless `ack: false`.
 */
export class Live {
    constructor(daemon, scene, { client, headers, ack = true } = {}) {
        this.daemon = daemon;
        this.client = client ?? `test-${crypto.randomBytes(6).toString('hex')}`;
        this.ack = ack;
        this.messages = [];
        this.frames = [];
        this.thumbnails = []; // each with the message that it came in
        this.ackThumbnails = ack;
        this.status = null;
        this.closeCode = null;
        this.closed = false;
        this.error = null; // of the socket, by its code
        this.edit = 0;
        this.seq = 0;
        this.buffer = Buffer.alloc(0);
        this.fragments = [];
        this.frame = null;
        this.socket = net.connect(daemon.port, '127.0.0.1', () =>
            this.socket.write(handshake(daemon.port, scene, headers)),
        );
        this.socket.setNoDelay(true); // as browsers do; else small messages wait for 40 ms
        this.socket.on('data', (bytes) => this.receive(bytes));
        this.socket.on('close', () => (this.closed = true));
        this.socket.on('error', ({ code }) => Object.assign(this, { closed: true, error: code }));
    }

    /**
     * Connects, says hello with the key that this client was told before (or with `key`; null: with
     * none), waits for the answer: `welcome` has the type `closed` where the server refuses.
     */
    static async open(daemon, scene, options = {}) {
        const live = new Live(daemon, scene, options);
        await until(() => live.status !== null || live.closed, 'the handshake');
        if (!live.status?.includes(' 101 ')) {
            return live;
        }
        if (options.hello !== false) {
            const { key = keys.get(live.client) ?? null } = options;
            live.say({ type: 'hello', client: live.client, ...(key === null ? {} : { key }), ...options.resume });
            live.welcome = await live.next('welcome');
            if (live.welcome.key) {
                keys.set(live.client, live.welcome.key);
            }
            live.edit = live.welcome?.last_edit ?? 0;
        }
        return live;
    }

    receive(bytes) {
        this.buffer = this.buffer.length ? Buffer.concat([this.buffer, bytes]) : bytes;
        if (this.status === null) {
            const end = this.buffer.indexOf('\r\n\r\n');
            if (end < 0) {
                return;
            }
            this.head = this.buffer.subarray(0, end).toString();
            this.status = this.head.split('\r\n')[0];
            this.buffer = this.buffer.subarray(end + 4);
        }
        for (let m; this.status.includes(' 101 ') && (m = decodeMessage(this.buffer)); ) {
            this.buffer = this.buffer.subarray(m.used);
            this.take(m);
        }
    }

    /** A ping is no sign of life: a daemon that waits for something that never comes sends them too. */
    take({ final, opcode, payload }) {
        if (opcode !== PING) {
            heard();
        }
        if (opcode === CLOSE) {
            this.closeCode = payload.length >= 2 ? payload.readUInt16BE(0) : 1005;
            this.socket.end(encodeMessage(CLOSE, payload.subarray(0, 2)));
        } else if (opcode === PING) {
            this.socket.write(encodeMessage(PONG, payload));
        } else if (opcode < CLOSE) {
            this.opcode = opcode || this.opcode;
            this.fragments.push(Buffer.from(payload));
            if (final) {
                const whole = Buffer.concat(this.fragments);
                this.fragments = [];
                if (this.opcode === TEXT) {
                    this.messages.push({ at: now(), ...JSON.parse(whole.toString()) });
                } else {
                    this.takePart(whole);
                }
            }
        }
    }

    takeThumbnails(bytes) {
        const header = { number: bytes.readUInt32LE(8), revision: Number(bytes.readBigUInt64LE(16)) };
        let at = 24;
        for (let i = 0; i < bytes.readUInt16LE(6); i += 1) {
            const idAt = at + 12;
            const pngAt = idAt + bytes[at + 1];
            const end = pngAt + bytes.readUInt32LE(at + 8);
            this.thumbnails.push({
                ...header,
                at: now(),
                kind: ['node', 'material'][bytes[at]],
                id: bytes.subarray(idAt, pngAt).toString(),
                width: bytes.readUInt16LE(at + 2),
                height: bytes.readUInt16LE(at + 4),
                png: bytes.subarray(pngAt, end),
            });
            at = end;
        }
        if (at !== bytes.length) {
            throw new Error(`thumbnails take ${at} of ${bytes.length} bytes`);
        }
        if (this.ackThumbnails) {
            this.say({ type: 'ack_thumbnails', number: header.number });
        }
    }

    takePart(bytes) {
        const magic = bytes.subarray(0, 4).toString();
        if (magic === 'FCT1') {
            this.takeThumbnails(bytes);
            return;
        }
        if (magic === 'FCF1') {
            const header = readFrameHeader(bytes);
            this.frame = { ...header, at: now(), parts: [bytes.subarray(40 + 4 * header.stagesUs.length)], got: 0 };
        } else if (magic !== 'FCFP' || bytes.readUInt32LE(4) !== this.frame?.number) {
            throw new Error(`a binary message starts with ${magic}`);
        } else {
            this.frame.parts.push(bytes.subarray(8));
        }
        const { frame } = this;
        frame.got += frame.parts.at(-1).length;
        if (frame.got === frame.bytes) {
            frame.payload = Buffer.concat(frame.parts);
            delete frame.parts;
            this.frames.push(frame);
            if (this.ack) {
                this.acknowledge(frame.number);
            }
            this.onFrame?.(frame);
        }
    }

    say(message) {
        this.sayText(JSON.stringify(message));
    }

    sayText(text) {
        this.socket.write(encodeMessage(TEXT, Buffer.from(text)));
    }

    sayBytes(bytes) {
        this.socket.write(encodeMessage(BINARY, bytes));
    }

    acknowledge(frame) {
        this.say({ type: 'ack', frame });
    }

    /** Sends a view; returns its number. */
    look(view = {}) {
        this.seq += 1;
        this.say({ type: 'view', seq: this.seq, width: 64, height: 48, ...view });
        return this.seq;
    }

    /** Sends an edit; returns its number. */
    change(ops, more = {}) {
        this.edit += 1;
        this.say({ type: 'edit', edit: this.edit, ops, ...more });
        return this.edit;
    }

    set(at, value, more) {
        return this.change([{ op: 'set', at, value }], more);
    }

    /** `undo` or `redo`; returns its number. */
    step(type) {
        this.edit += 1;
        this.say({ type, edit: this.edit });
        return this.edit;
    }

    /** The first message, from index `from` on, of a type and with these members. */
    find(type, members = {}, from = 0) {
        return this.messages
            .slice(from)
            .find((m) => m.type === type && Object.entries(members).every(([k, v]) => m[k] === v));
    }

    next(type, members = {}, from = 0) {
        return until(
            () => this.find(type, members, from) ?? (this.closed ? { type: 'closed' } : null),
            `${type} ${JSON.stringify(members)}`,
        );
    }

    nextFrame(wanted = () => true, from = 0) {
        return until(() => this.frames.slice(from).find(wanted), 'a frame');
    }

    /** Stops and restarts reading from the socket, so that the server's buffers fill. */
    stopReading() {
        this.socket.pause();
    }

    goOnReading() {
        this.socket.resume();
    }

    async close() {
        if (!this.closed) {
            this.socket.write(encodeMessage(CLOSE, Buffer.from([3, 232])));
            this.socket.end();
            await until(() => this.closed, 'the connection to close');
        }
    }
}
