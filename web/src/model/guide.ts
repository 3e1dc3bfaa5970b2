/* SPDX-License-Identifier: MIT */
/* Which node each pixel of a picture shows: what is under the pointer is known without a question,
 * and outlines are drawn by the page. */
import type { LinkState } from "./stores.ts";

export interface Guide {
    /* The picture that it belongs to: `seq` of the view, revision of the scene. */
    readonly input: number;
    readonly revision: number;
    readonly width: number;
    readonly height: number;
    readonly ids: readonly string[];
    /* For each pixel, rows from the top: 0 no node, else an index into the ids, from 1. */
    readonly indices: Uint16Array;
}

/* That of the picture shown; null while there is none. */
export function shownGuide({ guide, frame }: LinkState): Guide | null {
    const fits =
        guide !== null &&
        !frame.outdated &&
        guide.input === frame.input &&
        guide.revision === frame.revision;
    return fits ? guide : null;
}

/* At parts of the picture's width and height; null: none is there. */
export function nodeAt(guide: Guide, u: number, v: number): string | null {
    const x = Math.min(guide.width - 1, Math.max(0, Math.floor(u * guide.width)));
    const y = Math.min(guide.height - 1, Math.max(0, Math.floor(v * guide.height)));
    return guide.ids[(guide.indices[y * guide.width + x] ?? 0) - 1] ?? null;
}

/* The nodes that are seen in a rectangle, from its left top to its right bottom, in parts of the
 * picture's width and height. */
export function nodesIn(
    guide: Guide,
    left: number,
    top: number,
    right: number,
    bottom: number,
): readonly string[] {
    const pixel = (part: number, side: number): number =>
        Math.min(side - 1, Math.max(0, Math.floor(part * side)));
    const seen = new Set<number>();
    for (let y = pixel(top, guide.height); y <= pixel(bottom, guide.height); y++) {
        for (let x = pixel(left, guide.width); x <= pixel(right, guide.width); x++) {
            seen.add(guide.indices[y * guide.width + x] as number);
        }
    }
    return [...new Set(guide.ids.filter((_, i) => seen.has(i + 1)))];
}

/* The pixels of some nodes: opaque in the smallest box around them, in pixels of the guide. */
export interface Mask {
    readonly left: number;
    readonly top: number;
    readonly width: number;
    readonly height: number;
    /* Red, green, blue, alpha. */
    readonly pixels: Uint8ClampedArray<ArrayBuffer>;
}

interface Box {
    left: number;
    top: number;
    right: number;
    bottom: number;
}

function boxOf({ width, height, indices }: Guide, wanted: Uint8Array): Box {
    const box = { left: width, top: height, right: -1, bottom: -1 };
    for (let y = 0, i = 0; y < height; y++) {
        for (let x = 0; x < width; x++, i++) {
            if (wanted[indices[i] as number]) {
                box.left = Math.min(box.left, x);
                box.right = Math.max(box.right, x);
                box.top = Math.min(box.top, y);
                box.bottom = y;
            }
        }
    }
    return box;
}

/* Null: none of them is seen. */
export function maskOf(guide: Guide, nodes: ReadonlySet<string>): Mask | null {
    const wanted = Uint8Array.from([0, ...guide.ids.map((id) => Number(nodes.has(id)))]);
    if (!wanted.includes(1)) {
        return null;
    }
    const { left, top, right, bottom } = boxOf(guide, wanted);
    const [width, height] = [right - left + 1, bottom - top + 1];
    if (width <= 0) {
        return null;
    }
    const pixels = new Uint8ClampedArray(4 * width * height);
    for (let y = 0, to = 3; y < height; y++) {
        let from = (top + y) * guide.width + left;
        for (let x = 0; x < width; x++, to += 4) {
            pixels[to] = wanted[guide.indices[from++] as number] ? 255 : 0;
        }
    }
    return { left, top, width, height, pixels };
}
