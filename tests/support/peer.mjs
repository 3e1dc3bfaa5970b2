// SPDX-License-Identifier: MIT
// A WebSocket client below the rules of RFC 6455: any bits in any order, cut anywhere. It answers
// nothing by itself. For tests only.
import crypto from 'node:crypto';
import net from 'node:net';
import { heard, until } from './daemon.mjs';
import { handshake } from './live.mjs';

export const CONTINUATION = 0;
export const TEXT = 1;
export const BINARY = 2;
export const CLOSE = 8;
export const PING = 9;
export const PONG = 10;

const bytesOf = (payload) => (typeof payload === 'string' ? Buffer.from(payload) : Buffer.from(payload));

/** One frame. `length`: what the head says, where that is not the truth; `wide`: bytes of the length. */
export function frame(opcode, payload = '', { final = true, reserved = 0, masked = true, length, wide } = {}) {
    const body = bytesOf(payload);
    const told = length ?? body.length;
    const width = wide ?? (told < 126 ? 0 : told < 65536 ? 2 : 8);
    const head = Buffer.alloc(2 + width);
    head[0] = (final ? 0x80 : 0) | (reserved << 4) | opcode;
    head[1] = (masked ? 0x80 : 0) | (width === 0 ? told : width === 2 ? 126 : 127);
    if (width === 2) {
        head.writeUInt16BE(told, 2);
    } else if (width === 8) {
        head.writeBigUInt64BE(BigInt(told), 2);
    }
    if (!masked) {
        return Buffer.concat([head, body]);
    }
    const mask = crypto.randomBytes(4);
    return Buffer.concat([head, mask, body.map((byte, i) => byte ^ mask[i & 3])]);
}

/** The payload of a close frame. */
export const reason = (code, text = '') => Buffer.concat([Buffer.from([code >> 8, code & 255]), bytesOf(text)]);

/** A message in fragments. */
export const fragments = (parts, opcode = TEXT) =>
    parts.map((part, i) => frame(i ? CONTINUATION : opcode, part, { final: i === parts.length - 1 }));

export const octets = (bytes) => Array.from(bytesOf(bytes), (byte) => Buffer.from([byte]));

export class Peer {
    constructor(daemon, scene) {
        this.frames = []; // what came: {final, opcode, payload}
        this.head = null;
        this.ended = false;
        this.error = null;
        this.buffer = Buffer.alloc(0);
        this.socket = net.connect({ port: daemon.port, host: '127.0.0.1', allowHalfOpen: true });
        this.socket.setNoDelay(true);
        this.socket.write(handshake(daemon.port, scene));
        this.socket.on('data', (bytes) => this.receive(bytes));
        this.socket.on('end', () => (this.ended = true));
        this.socket.on('close', () => (this.ended = true));
        this.socket.on('error', ({ code }) => Object.assign(this, { ended: true, error: code }));
    }

    static async open(daemon, scene, hello = true) {
        const peer = new Peer(daemon, scene);
        await until(() => peer.head || peer.ended, 'the handshake');
        if (hello) {
            peer.say({ type: 'hello', client: `peer-${crypto.randomBytes(6).toString('hex')}` });
            await until(() => peer.told('document'), 'the document');
        }
        return peer;
    }

    receive(bytes) {
        heard();
        this.buffer = Buffer.concat([this.buffer, bytes]);
        if (!this.head) {
            const end = this.buffer.indexOf('\r\n\r\n');
            if (end < 0) {
                return;
            }
            this.head = this.buffer.subarray(0, end).toString();
            this.buffer = this.buffer.subarray(end + 4);
        }
        while (this.take());
    }

    take() {
        const { buffer } = this;
        const short = buffer.length < 2 ? 0 : buffer[1] & 127;
        const head = short === 127 ? 10 : short === 126 ? 4 : 2;
        if (buffer.length < head) {
            return false;
        }
        const length = head === 10 ? Number(buffer.readBigUInt64BE(2)) : head === 4 ? buffer.readUInt16BE(2) : short;
        if (buffer.length < head + length) {
            return false;
        }
        this.frames.push({
            final: buffer[0] >= 128,
            opcode: buffer[0] & 15,
            payload: Buffer.from(buffer.subarray(head, head + length)),
        });
        this.buffer = buffer.subarray(head + length);
        return true;
    }

    /** Whole buffers, one after another; with `cut`, in pieces of so many bytes. */
    async send(buffers, cut = 0) {
        for (const buffer of [buffers].flat()) {
            for (let at = 0; at < buffer.length; at += cut || buffer.length) {
                await new Promise((done) => {
                    this.socket.write(buffer.subarray(at, at + (cut || buffer.length)), done);
                });
                await new Promise(setImmediate);
            }
        }
    }

    say(message) {
        return this.send(frame(TEXT, JSON.stringify(message)));
    }

    of(opcode) {
        return this.frames.filter((one) => one.opcode === opcode);
    }

    /** Messages of a type (none of what this sends makes the server cut texts). */
    told(type, from = 0) {
        return this.of(TEXT)
            .slice(from)
            .map((one) => JSON.parse(one.payload.toString()))
            .find((message) => message.type === type);
    }

    /** Code and reason of the server's close; code null without one, 1005 where it says none. */
    get close() {
        const payload = this.of(CLOSE)[0]?.payload;
        return {
            code: !payload ? null : payload.length < 2 ? 1005 : payload.readUInt16BE(0),
            text: payload?.subarray(2).toString() ?? '',
        };
    }

    /** Waits for the end, answering the server's close as a client has to. */
    async end() {
        await until(() => this.ended || this.of(CLOSE).length > 0, 'a close');
        if (!this.ended) {
            await this.send(frame(CLOSE, this.of(CLOSE)[0].payload));
            await until(() => this.ended, 'the end of the connection');
        }
        this.destroy();
        return this.close;
    }

    destroy() {
        this.socket.destroy();
    }
}
