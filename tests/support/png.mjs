// SPDX-License-Identifier: MIT
// Pixels of a PNG with 8-bit channels, not interlaced (W3C PNG, third edition). For tests only.
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
