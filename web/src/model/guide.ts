/* SPDX-License-Identifier: MIT */
/* Which node each pixel of a picture shows, and how far it is: what is under the pointer is known
 * without a question, outlines are drawn by the page, and what else it draws is hidden by surfaces. */
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
    /* From the eye along the ray, in scene units, of every DISTANCE_STEPth pixel of every
     * DISTANCE_STEPth row from the first ones: infinite where nothing is hit. */
    readonly distances: Float32Array;
}

export const DISTANCE_STEP = 4;

/* That of the picture shown; null while there is none. */
export function shownGuide({ guide, frame }: LinkState): Guide | null {
    const fits =
        guide !== null &&
        !frame.outdated &&
        guide.input === frame.input &&
        guide.revision === frame.revision;
    return fits ? guide : null;
}

/* Of a side of so many. */
export const pixelOf = (part: number, side: number): number =>
    Math.min(side - 1, Math.max(0, Math.floor(part * side)));

/* At parts of the picture's width and height; null: none is there. */
export function nodeAt(guide: Guide, u: number, v: number): string | null {
    const [x, y] = [pixelOf(u, guide.width), pixelOf(v, guide.height)];
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
    const seen = new Set<number>();
    for (let y = pixelOf(top, guide.height); y <= pixelOf(bottom, guide.height); y++) {
        for (let x = pixelOf(left, guide.width); x <= pixelOf(right, guide.width); x++) {
            seen.add(guide.indices[y * guide.width + x] as number);
        }
    }
    return [...new Set(guide.ids.filter((_, i) => seen.has(i + 1)))];
}

/* Whether a pixel shows one of the nodes. */
export function isSeen(guide: Guide, nodes: ReadonlySet<string>): boolean {
    const wanted = Uint8Array.from([0, ...guide.ids.map((id) => Number(nodes.has(id)))]);
    return wanted.includes(1) && guide.indices.some((index) => wanted[index] === 1);
}

/* Ends of the segment that separates the corners of a square of four pixels, by which of them are
 * inside (1 left top, 2 right top, 4 right bottom, 8 left bottom); each end is the middle of a side:
 * 0 top, 1 right, 2 bottom, 3 left. Opposite corners have two (marching squares; Lorensen and Cline,
 * Marching Cubes, SIGGRAPH 1987, in the plane). */
const SEGMENTS: readonly (readonly number[])[] = [
    [],
    [3, 0],
    [0, 1],
    [3, 1],
    [1, 2],
    [3, 0, 1, 2],
    [0, 2],
    [3, 2],
    [2, 3],
    [2, 0],
    [0, 1, 2, 3],
    [2, 1],
    [1, 3],
    [1, 0],
    [0, 3],
    [],
];
const SIDES = [
    [0.5, 0],
    [1, 0.5],
    [0.5, 1],
    [0, 0.5],
] as const;

/* What separates the pixels of some nodes from all others: x, y, x, y of each segment, in pixels of
 * the guide. The border of the picture separates nothing. */
export function contourOf(guide: Guide, nodes: ReadonlySet<string>): readonly number[] {
    const inside = Uint8Array.from([0, ...guide.ids.map((id) => Number(nodes.has(id)))]);
    const segments: number[] = [];
    if (!inside.includes(1)) {
        return segments;
    }
    const { width, height, indices } = guide;
    const at = (i: number): number => inside[indices[i] as number] as number;
    for (let y = 0; y < height - 1; y++) {
        let row = y * width;
        let left = at(row) | (at(row + width) << 3);
        for (let x = 0; x < width - 1; x++, row++) {
            const right = (at(row + 1) << 1) | (at(row + width + 1) << 2);
            addSegments(segments, SEGMENTS[left | right] as readonly number[], x + 0.5, y + 0.5);
            left = ((right >> 1) & 1) | ((right << 1) & 8);
        }
    }
    return segments;
}

/* From the middle of the left top pixel. */
function addSegments(to: number[], sides: readonly number[], x: number, y: number): void {
    for (const side of sides) {
        const [dx, dy] = SIDES[side] as readonly [number, number];
        to.push(x + dx, y + dy);
    }
}
