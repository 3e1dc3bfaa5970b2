// SPDX-License-Identifier: MIT
// Radiance files whose rows are runs of each component (Ward: Real pixels, Graphics Gems II, 1991).
// For tests only.
import assert from 'node:assert/strict';

function readComponent(bytes, from, out, component, width) {
    let at = from;
    for (let x = 0; x < width; ) {
        const count = bytes[at];
        const same = count > 128;
        const n = same ? count - 128 : count;
        for (let i = 0; i < n; i += 1) {
            out[4 * (x + i) + component] = bytes[at + (same ? 1 : 1 + i)];
        }
        at += same ? 2 : 1 + n;
        x += n;
    }
    return at;
}

/** {width, height, values, steps}: three numbers for each pixel, and by how much they may be off. */
export function readHdr(bytes) {
    const head = /^#\?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y (\d+) \+X (\d+)\n/.exec(bytes.toString('latin1', 0, 200));
    const [height, width] = [Number(head[1]), Number(head[2])];
    const values = [];
    const steps = [];
    let at = head[0].length;
    for (let y = 0; y < height; y += 1) {
        const row = new Uint8Array(4 * width);
        assert.deepEqual([...bytes.subarray(at, at + 4)], [2, 2, width >> 8, width & 255]);
        at += 4;
        for (let component = 0; component < 4; component += 1) {
            at = readComponent(bytes, at, row, component, width);
        }
        for (let x = 0; x < width; x += 1) {
            const unit = row[4 * x + 3] ? 2 ** (row[4 * x + 3] - 136) : 0;
            values.push(...[0, 1, 2].map((k) => row[4 * x + k] * unit));
            steps.push(unit / 2);
        }
    }
    assert.equal(at, bytes.length);
    return { width, height, values, steps };
}
