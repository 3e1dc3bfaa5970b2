/* SPDX-License-Identifier: MIT */
/* How far what a picture shows is from the eye, and where it is in the world: from its guide. */
import { DISTANCE_STEP, type Guide, pixelOf } from "./guide.ts";
import type { Projection, Spot } from "./projection.ts";
import { add, scale, type Vector } from "./transform.ts";

/* The four pixels around a place that have a distance. Written anew for each place: a grid asks for
 * thousands of them. */
const far = new Float64Array(4);
/* 1 at the place, 0 where the next one is; -1 outside of the picture. */
const weight = new Float64Array(4);
/* It shows the node of the place. */
const same = new Uint8Array(4);

function lookAround({ width, height, indices, distances }: Guide, u: number, v: number): void {
    const node = indices[pixelOf(v, height) * width + pixelOf(u, width)];
    const across = Math.ceil(width / DISTANCE_STEP);
    const down = Math.ceil(height / DISTANCE_STEP);
    /* Both are from the middle of the first pixel. */
    const x = Math.max(0, Math.min(across - 1, (u * width - 0.5) / DISTANCE_STEP));
    const y = Math.max(0, Math.min(down - 1, (v * height - 0.5) / DISTANCE_STEP));
    for (let corner = 0; corner < 4; corner++) {
        const i = Math.floor(x) + (corner & 1);
        const j = Math.floor(y) + (corner >> 1);
        const inside = i < across && j < down;
        far[corner] = distances[j * across + i] ?? 0;
        weight[corner] = inside ? (1 - Math.abs(x - i)) * (1 - Math.abs(y - j)) : -1;
        same[corner] = Number(inside && indices[(j * width + i) * DISTANCE_STEP] === node);
    }
}

/* Which of them is nearest; one of the same node goes before all others. */
function nearest(): number {
    let best = 0;
    for (let corner = 1; corner < 4; corner++) {
        const alike = (same[corner] as number) - (same[best] as number);
        const nearer = (weight[corner] as number) > (weight[best] as number);
        best = alike > 0 || (alike === 0 && nearer) ? corner : best;
    }
    return best;
}

/* Distances whose ratio is smaller are of one surface. */
const ONE_SURFACE = 1.1;

/* At parts of the picture's width and height, along the ray; infinite where nothing is hit. Of the
 * pixels around that have a distance, those of the same node and surface say it together, in parts
 * of the inverse, which is nearly even over a plane. */
export function distanceAt(guide: Guide, u: number, v: number): number {
    lookAround(guide, u, v);
    const best = nearest();
    const here = far[best] as number;
    if (same[best] === 0 || here === Number.POSITIVE_INFINITY) {
        return here;
    }
    let [sum, weights] = [0, 0];
    for (let corner = 0; corner < 4; corner++) {
        const there = far[corner] as number;
        const alike = there < here * ONE_SURFACE && here < there * ONE_SURFACE;
        if (same[corner] === 1 && alike) {
            sum += (weight[corner] as number) / there;
            weights += weight[corner] as number;
        }
    }
    return weights > 0 ? weights / sum : here;
}

/* The point of the surface that is seen at a spot, in the world; null: none is there. */
export function surfaceAt(guide: Guide, projection: Projection, spot: Spot): Vector | null {
    const { width, height } = projection.size;
    const distance = distanceAt(guide, spot.x / width, spot.y / height);
    const { from, along } = projection.rayAt(spot);
    return Number.isFinite(distance) ? add(from, scale(along, distance)) : null;
}
