/* SPDX-License-Identifier: MIT */
/* Arrays as NumPy writes them (format 1.0 of numpy.lib.format), as far as the server sends them. */

const ASCII = new TextDecoder("latin1");
const HEAD = 10;

/* The numbers of an array, row by row; null where it is none that is known here. */
export function readNpy(file: ArrayBuffer): readonly number[] | null {
    const view = new DataView(file);
    if (file.byteLength < HEAD || ASCII.decode(new Uint8Array(file, 1, 5)) !== "NUMPY") {
        return null;
    }
    const start = HEAD + view.getUint16(8, true);
    const head = ASCII.decode(new Uint8Array(file, HEAD, start - HEAD));
    const type = /'descr': '([^']+)'/.exec(head)?.[1];
    const data = file.slice(start);
    switch (type) {
        case "<f4":
            return [...new Float32Array(data)];
        case "<u4":
            return [...new Uint32Array(data)];
        case "<i4":
            return [...new Int32Array(data)];
        case "|u1":
            return [...new Uint8Array(data)];
        default:
            return null;
    }
}
