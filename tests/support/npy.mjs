// SPDX-License-Identifier: MIT
// Arrays of NPY files, version 1.0 (numpy.lib.format). For tests only.
import assert from 'node:assert/strict';

const ARRAYS = { '<f4': Float32Array, '<u4': Uint32Array };

/** {type, shape, values} */
export function readNpy(bytes) {
    assert.equal(bytes.subarray(0, 8).toString('latin1'), '\x93NUMPY\x01\x00');
    const start = 10 + bytes.readUInt16LE(8);
    const [, type, shape] = /^\{'descr': '(.+?)', 'fortran_order': False, 'shape': \((.+?)\), \}\s*\n$/.exec(
        bytes.subarray(10, start).toString(),
    );
    const sides = shape.split(',').map(Number);
    const data = Uint8Array.from(bytes.subarray(start));
    const values = new ARRAYS[type](data.buffer);
    assert.equal(
        values.length,
        sides.reduce((a, b) => a * b),
    );
    return { type, shape: sides, values };
}
