/* SPDX-License-Identifier: MIT */
/* How far what a picture shows is from the eye, and where it is in the world: from its guide. */
import { DISTANCE_STEP, type Guide, pixelOf } from "./guide.ts";
import type { Projection, Spot } from "./projection.ts";
import { add, scale, type Vector } from "./transform.ts";

/* A pixel that has a distance. */
interface Sample {
    readonly far: number;
    /* Of four around a place: 1 at it, 0 where the next one is. */
    readonly weight: number;
    /* It shows the node of the place. */
    readonly same: boolean;
}

function samplesAround(guide: Guide, u: number, v: number): readonly Sample[] {
    const { width, height, indices, distances } = guide;
    const node = indices[pixelOf(v, height) * width + pixelOf(u, width)];
    const [across, down] = [width, height].map((side) => Math.ceil(side / DISTANCE_STEP));
    /* Both are from the middle of the first pixel. */
    const x = within((u * width - 0.5) / DISTANCE_STEP, across as number);
    const y = within((v * height - 0.5) / DISTANCE_STEP, down as number);
    const samples: Sample[] = [];
    for (let j = Math.floor(y); j < Math.min(y + 1, down as number); j++) {
        for (let i = Math.floor(x); i < Math.min(x + 1, across as number); i++) {
            samples.push({
                far: distances[j * (across as number) + i] as number,
                weight: (1 - Math.abs(x - i)) * (1 - Math.abs(y - j)),
                same: indices[(j * width + i) * DISTANCE_STEP] === node,
            });
        }
    }
    return samples;
}

const within = (at: number, count: number): number => Math.max(0, Math.min(count - 1, at));

/* Distances whose ratio is smaller are of one surface. */
const ONE_SURFACE = 1.1;

/* At parts of the picture's width and height, along the ray; infinite where nothing is hit. Of the
 * pixels around that have a distance, those of the same node and surface say it together, in parts
 * of the inverse, which is nearly even over a plane. */
export function distanceAt(guide: Guide, u: number, v: number): number {
    const all = samplesAround(guide, u, v);
    const alike = all.filter(({ same }) => same);
    const asked = alike.length > 0 ? alike : all;
    const nearest = asked.reduce((a, b) => (b.weight > a.weight ? b : a));
    if (alike.length === 0 || nearest.far === Number.POSITIVE_INFINITY) {
        return nearest.far;
    }
    let [sum, weights] = [0, 0];
    for (const { far, weight } of alike) {
        if (far < nearest.far * ONE_SURFACE && nearest.far < far * ONE_SURFACE) {
            sum += weight / far;
            weights += weight;
        }
    }
    return weights > 0 ? weights / sum : nearest.far;
}

/* The point of the surface that is seen at a spot, in the world; null: none is there. */
export function surfaceAt(guide: Guide, projection: Projection, spot: Spot): Vector | null {
    const { width, height } = projection.size;
    const far = distanceAt(guide, spot.x / width, spot.y / height);
    const { from, along } = projection.rayAt(spot);
    return Number.isFinite(far) ? add(from, scale(along, far)) : null;
}
