/* SPDX-License-Identifier: MIT */
/* Depths of a picture's blocks, from what stands behind its bytes, or from a guide. */
import { DISTANCE_STEP, type Guide } from "../model/guide.ts";
import type { Depths } from "../model/warp.ts";
import { inflate } from "./inflate.ts";
import type { FrameHeader } from "./protocol.ts";

const TAIL_BYTES = 10;
const NEAREST = 255;

export interface SplitPayload {
    readonly picture: Blob;
    /* Null where they are damaged. */
    readonly depths: Depths | null;
}

function unfold(plain: Uint8Array, columns: number): Uint8Array {
    const all = new Uint8Array(plain.length);
    for (let i = 0; i < all.length; i++) {
        const inner = i % columns > 0;
        const left = inner ? (all[i - 1] as number) : 0;
        const above = i >= columns ? (all[i - columns] as number) : 0;
        const corner = inner && i > columns ? (all[i - columns - 1] as number) : 0;
        all[i] = (plain[i] as number) + left + above - corner;
    }
    return all;
}

/* Of a payload with the flag of depths. */
export async function splitDepths(payload: Blob, header: FrameHeader): Promise<SplitPayload> {
    const end = payload.size - TAIL_BYTES;
    const tail = new DataView(await payload.slice(end).arrayBuffer());
    const start = end - tail.getUint32(6, true);
    const [nearest, side] = [tail.getFloat32(0, true), tail.getUint16(4, true)];
    const [columns, rows] = [Math.ceil(header.width / side), Math.ceil(header.height / side)];
    const plain = await inflate(payload.slice(start, end)).catch(() => new ArrayBuffer(0));
    const picture = payload.slice(0, start, payload.type);
    if (plain.byteLength !== columns * rows) {
        return { picture, depths: null };
    }
    const unit = nearest > 0 ? 1 / (NEAREST * nearest) : 0;
    const inverses = Float32Array.from(
        unfold(new Uint8Array(plain), columns),
        (depth) => depth * unit,
    );
    const [across, down] = [side / header.width, side / header.height];
    return { picture, depths: { columns, rows, across, down, inverses } };
}

/* More would only take time. */
const MOST_BLOCKS = 16384;

export function depthsOfGuide({ width, height, distances }: Guide): Depths {
    const [wide, high] = [width, height].map((side) => Math.ceil(side / DISTANCE_STEP)) as [
        number,
        number,
    ];
    const samples = Math.ceil(Math.sqrt((wide * high) / MOST_BLOCKS));
    const [columns, rows] = [Math.ceil(wide / samples), Math.ceil(high / samples)];
    const inverses = new Float32Array(columns * rows);
    distances.forEach((far, i) => {
        const [x, y] = [i % wide, Math.floor(i / wide)];
        const block = Math.floor(y / samples) * columns + Math.floor(x / samples);
        inverses[block] = Math.max(inverses[block] as number, 1 / far);
    });
    const side = samples * DISTANCE_STEP;
    return { columns, rows, across: side / width, down: side / height, inverses };
}
