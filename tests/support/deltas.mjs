// SPDX-License-Identifier: MIT
// Frames that are differences (protocol/README.md, Deltas), put together as a client does. For tests
// and benchmarks only.
import { decodePng } from './png.mjs';

const SIDE = 16;

/** The squares that have changed, by rows from the top, and the file of the picture of them. */
export function readDelta(payload) {
    const squares = [];
    const runs = payload.readUInt16LE(0);
    for (let i = 0; i < runs; i += 1) {
        const [first, count] = [payload.readUInt16LE(2 + 4 * i), payload.readUInt16LE(4 + 4 * i)];
        squares.push(...Array.from({ length: count }, (_, k) => first + k));
    }
    return { squares, atlas: payload.subarray(2 + 4 * runs) };
}

/** Puts the squares of a PNG into `picture`, as decodePng answers it. */
function drawSquares(picture, { squares, atlas }) {
    if (squares.length === 0) {
        return;
    }
    const from = decodePng(atlas);
    const { width, height, channels } = picture;
    const [across, columns] = [Math.ceil(width / SIDE), from.width / SIDE];
    squares.forEach((square, i) => {
        const [left, top] = [(square % across) * SIDE, Math.floor(square / across) * SIDE];
        const bytes = Math.min(SIDE, width - left) * channels;
        for (let y = 0; y < Math.min(SIDE, height - top); y += 1) {
            const at = ((Math.floor(i / columns) * SIDE + y) * from.width + (i % columns) * SIDE) * channels;
            from.pixels.copy(picture.pixels, ((top + y) * width + left) * channels, at, at + bytes);
        }
    });
}

/** Keeps the last picture of each chain. */
export class Composer {
    #chains = new Map();

    /** What a frame shows; null for a JPEG, which is only counted. Throws where the one before it is missing. */
    take(frame) {
        const { chain, link, delta, codec, payload, width, height } = frame;
        if (!delta) {
            const picture = codec === 'png' ? decodePng(payload) : null;
            if (chain > 0) {
                this.#chains.set(chain, { link, picture, width, height });
            }
            return picture;
        }
        const last = this.#chains.get(chain);
        if (link !== ((last?.link ?? -1) + 1) % 256 || last.width !== width || last.height !== height) {
            throw new Error(`frame ${frame.number} is not of the last picture of its chain ${chain}`);
        }
        last.link = link;
        if (last.picture) {
            drawSquares(last.picture, readDelta(payload));
        }
        return last.picture;
    }
}
