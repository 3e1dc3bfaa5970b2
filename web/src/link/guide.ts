/* SPDX-License-Identifier: MIT */
/* Guides from the bytes of their frames. */
import { DISTANCE_STEP, type Guide } from "../model/guide.ts";
import type { Frame } from "./decode.ts";
import { inflate } from "./inflate.ts";

const MOST = 65535;

/* A row that is above the first one is 0 throughout, as is what is left of a row. */
function unfold(low: Uint8Array, high: Uint8Array, width: number): Uint16Array {
    const depths = new Uint16Array(low.length);
    for (let i = 0; i < depths.length; i++) {
        const folded = (low[i] as number) | ((high[i] as number) << 8);
        const apart = (folded >> 1) ^ -(folded & 1);
        const inner = i % width > 0;
        const left = inner ? (depths[i - 1] as number) : 0;
        const above = i >= width ? (depths[i - width] as number) : 0;
        const corner = inner && i > width ? (depths[i - width - 1] as number) : 0;
        depths[i] = left + above - corner + apart;
    }
    return depths;
}

function distancesOf(depths: Uint16Array, nearest: number, farthest: number): Float32Array {
    const rate = Math.log(nearest / farthest) / (MOST - 1);
    return Float32Array.from(depths, (depth) =>
        depth === 0 ? Number.POSITIVE_INFINITY : farthest * Math.exp(rate * (depth - 1)),
    );
}

/* Rejects where the payload is damaged. */
export async function decodeGuide({ header, parts }: Frame): Promise<Guide> {
    const whole = await new Blob([...parts]).arrayBuffer();
    const view = new DataView(whole);
    const ids: string[] = [];
    let at = 2;
    for (let count = view.getUint16(0, true); count > 0; count--) {
        const start = at + 1;
        at = start + view.getUint8(at);
        ids.push(new TextDecoder().decode(new Uint8Array(whole, start, at - start)));
    }
    const [nearest, farthest] = [view.getFloat32(at, true), view.getFloat32(at + 4, true)];
    const bytes = await inflate(new Blob([whole.slice(at + 8)]));
    const { input, revision, width, height } = header;
    const across = Math.ceil(width / DISTANCE_STEP);
    const [pixels, depths] = [width * height, across * Math.ceil(height / DISTANCE_STEP)];
    if (bytes.byteLength !== 2 * (pixels + depths)) {
        throw new Error("a guide of another size than its pixels");
    }
    const words = new DataView(bytes);
    const indices = Uint16Array.from({ length: pixels }, (_, i) => words.getUint16(2 * i, true));
    const low = new Uint8Array(bytes, 2 * pixels, depths);
    const high = new Uint8Array(bytes, 2 * pixels + depths, depths);
    const distances = distancesOf(unfold(low, high, across), nearest, farthest);
    return { input, revision, width, height, ids, indices, distances };
}
