// SPDX-License-Identifier: MIT
// PNG with 8-bit channels, not interlaced (W3C PNG, third edition). For tests only.
import zlib from 'node:zlib';

const CHANNELS = { 0: 1, 2: 3, 4: 2, 6: 4 };

function paeth(a, b, c) {
    const p = a + b - c;
    const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

function unfilter(raw, height, stride, step) {
    const out = Buffer.alloc(height * stride);
    for (let y = 0; y < height; y += 1) {
        const filter = raw[y * (stride + 1)];
        for (let x = 0; x < stride; x += 1) {
            const at = y * stride + x;
            const a = x >= step ? out[at - step] : 0;
            const b = y > 0 ? out[at - stride] : 0;
            const c = x >= step && y > 0 ? out[at - stride - step] : 0;
            const predicted = [0, a, b, (a + b) >> 1, paeth(a, b, c)][filter];
            out[at] = raw[y * (stride + 1) + 1 + x] + predicted;
        }
    }
    return out;
}

const CRC = Array.from({ length: 256 }, (_, n) => {
    let c = n;
    for (let k = 0; k < 8; k += 1) {
        c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    }
    return c >>> 0;
});

function chunk(type, data) {
    const body = Buffer.concat([Buffer.from(type), data]);
    const out = Buffer.alloc(body.length + 8);
    let crc = 0xffffffff;
    for (const byte of body) {
        crc = CRC[(crc ^ byte) & 255] ^ (crc >>> 8);
    }
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE((crc ^ 0xffffffff) >>> 0, body.length + 4);
    return out;
}

/** A file of black pixels, 8 bits of three channels each: the smallest that such a picture can be. */
export function blankPng(width, height) {
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2, 0, 0, 0], 8);
    return Buffer.concat([
        Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
        chunk('IHDR', header),
        chunk('IDAT', zlib.deflateSync(Buffer.alloc((3 * width + 1) * height), { level: 9 })),
        chunk('IEND', Buffer.alloc(0)),
    ]);
}

/** The same picture in another file. */
export function withText(png, text) {
    return Buffer.concat([png.subarray(0, -12), chunk('tEXt', Buffer.from(`Comment\0${text}`)), png.subarray(-12)]);
}

export function decodePng(bytes) {
    const parts = [];
    let header = null;
    for (let at = 8; at < bytes.length; ) {
        const length = bytes.readUInt32BE(at);
        const type = bytes.subarray(at + 4, at + 8).toString();
        const data = bytes.subarray(at + 8, at + 8 + length);
        if (type === 'IHDR') {
            header = data;
        } else if (type === 'IDAT') {
            parts.push(data);
        }
        at += 12 + length;
    }
    const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
    const bytesPerPixel = (CHANNELS[header[9]] * header[8]) / 8;
    const raw = zlib.inflateSync(Buffer.concat(parts));
    const pixels = unfilter(raw, height, width * bytesPerPixel, bytesPerPixel);
    return { width, height, channels: CHANNELS[header[9]], depth: header[8], pixels };
}
