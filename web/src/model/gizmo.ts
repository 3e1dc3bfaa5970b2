/* SPDX-License-Identifier: MIT */
/* The parts of the gizmo as they lie in the picture, and which of them is under the pointer. */
import { AXES, type Axis, axisOf, type Constraint, type Motion } from "./grip.ts";
import type { Projection, Spot } from "./projection.ts";
import { add, cross, dot, type Matrix, normalize, scale, type Vector } from "./transform.ts";

interface PartBase {
    readonly constraint: Constraint;
}

/* From its foot to its tip. */
export interface Shaft extends PartBase {
    readonly kind: "arrow" | "bar";
    readonly foot: Spot;
    readonly tip: Spot;
}

export type Part =
    | Shaft
    | (PartBase & { readonly kind: "square"; readonly corners: readonly Spot[] })
    /* `front[i]`: from spot i to the next it is on the side of the viewer. */
    | (PartBase & {
          readonly kind: "ring";
          readonly spots: readonly Spot[];
          readonly front: readonly boolean[];
      })
    | (PartBase & { readonly kind: "middle"; readonly at: Spot });

/* Pixels. */
export const REACH = 92;
const GAP = 20;
const PLANE_NEAR = 26;
const PLANE_FAR = 44;
const OUTER = 112;
export const MIDDLE = 8;
const RING_STEPS = 64;

/* Cosines: an arrow that points at the viewer, and a plane seen from its edge, are left out. */
const HEAD_ON = 0.985;
const EDGE_ON = 0.18;

interface Stand {
    readonly pivot: Vector;
    readonly frame: Matrix;
    readonly projection: Projection;
}

interface Drawn extends Stand {
    /* Scene units of a pixel at the pivot. */
    readonly unit: number;
    readonly view: Vector;
}

const other = (axis: Axis, by: 1 | 2): Axis => ((axis + by) % 3) as Axis;

function place({ pivot, projection, unit }: Drawn, ...arms: [Vector, number][]): Spot | null {
    const point = arms.reduce((at, [along, far]) => add(at, scale(along, far * unit)), pivot);
    return projection.spotOf(point);
}

function shafts(drawn: Drawn, motion: "move" | "scale"): Part[] {
    return AXES.flatMap((axis): Part[] => {
        const along = axisOf(drawn.frame, axis);
        const [foot, tip] = [place(drawn, [along, GAP]), place(drawn, [along, REACH])];
        if (!foot || !tip || Math.abs(dot(along, drawn.view)) > HEAD_ON) {
            return [];
        }
        const kind = motion === "move" ? "arrow" : "bar";
        return [{ kind, foot, tip, constraint: { motion, axis, plane: false } }];
    });
}

/* In the quarter that faces the viewer. */
function squares(drawn: Drawn, motion: "move" | "scale"): Part[] {
    return AXES.flatMap((axis): Part[] => {
        if (Math.abs(dot(axisOf(drawn.frame, axis), drawn.view)) < EDGE_ON) {
            return [];
        }
        const [u, v] = ([1, 2] as const).map((by) => {
            const along = axisOf(drawn.frame, other(axis, by));
            return dot(along, drawn.view) > 0 ? scale(along, -1) : along;
        }) as [Vector, Vector];
        const corners = [
            place(drawn, [u, PLANE_NEAR], [v, PLANE_NEAR]),
            place(drawn, [u, PLANE_FAR], [v, PLANE_NEAR]),
            place(drawn, [u, PLANE_FAR], [v, PLANE_FAR]),
            place(drawn, [u, PLANE_NEAR], [v, PLANE_FAR]),
        ].filter((spot) => spot !== null);
        return corners.length === 4
            ? [{ kind: "square", corners, constraint: { motion, axis, plane: true } }]
            : [];
    });
}

function ring(drawn: Drawn, normal: Vector, radius: number, axis: Axis | null): Part[] {
    const u = normalize(cross(normal, Math.abs(normal[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
    const v = cross(normal, u);
    const spots: Spot[] = [];
    const front: boolean[] = [];
    for (let i = 0; i <= RING_STEPS; i++) {
        const angle = (2 * Math.PI * i) / RING_STEPS;
        const arm = add(scale(u, Math.cos(angle)), scale(v, Math.sin(angle)));
        const spot = place(drawn, [arm, radius]);
        if (spot === null) {
            return [];
        }
        spots.push(spot);
        front.push(axis === null || dot(arm, drawn.view) < 0.05);
    }
    return [{ kind: "ring", spots, front, constraint: { motion: "turn", axis, plane: false } }];
}

function rings(drawn: Drawn): Part[] {
    const outer = ring(drawn, scale(drawn.view, -1), OUTER, null);
    return [
        ...outer,
        ...AXES.flatMap((axis) => ring(drawn, axisOf(drawn.frame, axis), REACH, axis)),
    ];
}

function middle(drawn: Drawn, motion: Motion): Part[] {
    const at = place(drawn);
    return at ? [{ kind: "middle", at, constraint: { motion, axis: null, plane: false } }] : [];
}

/* From the back to the front. None where the pivot is behind the camera. */
export function gizmoParts(stand: Stand, motion: Motion): readonly Part[] {
    const { projection, pivot } = stand;
    if (projection.spotOf(pivot) === null) {
        return [];
    }
    const drawn = { ...stand, unit: projection.unitsAt(pivot), view: projection.towards(pivot) };
    return motion === "turn"
        ? rings(drawn)
        : [...squares(drawn, motion), ...shafts(drawn, motion), ...middle(drawn, motion)];
}

/* A tip that is nearer than this to something else that is held ends so far before it; where that
 * leaves too little, so far behind it. */
const ROOM = 32;
const SHORTEST = 16;

/* The parts with shafts that leave room for what else is held at these spots. */
export function clearOf(parts: readonly Part[], spots: readonly Spot[]): readonly Part[] {
    return parts.map((part) =>
        part.kind === "arrow" || part.kind === "bar" ? clearShaft(part, spots) : part,
    );
}

function clearShaft(part: Shaft, spots: readonly Spot[]): Shaft {
    const { foot, tip } = part;
    const span = Math.hypot(tip.x - foot.x, tip.y - foot.y);
    const [dx, dy] = [(tip.x - foot.x) / span, (tip.y - foot.y) / span];
    const along = spots
        .filter(({ x, y }) => Math.hypot(x - tip.x, y - tip.y) < ROOM)
        .map(({ x, y }) => (x - foot.x) * dx + (y - foot.y) * dy);
    if (along.length === 0 || span === 0) {
        return part;
    }
    const before = Math.min(...along) - ROOM;
    const far = before < SHORTEST ? Math.max(span, Math.max(...along) + ROOM) : before;
    return { ...part, tip: { x: foot.x + far * dx, y: foot.y + far * dy } };
}

/* --- what is under the pointer --- */

function toSegment(p: Spot, a: Spot, b: Spot): number {
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const span = dx * dx + dy * dy;
    const t = span > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / span : 0;
    const near = Math.min(1, Math.max(0, t));
    return Math.hypot(p.x - a.x - near * dx, p.y - a.y - near * dy);
}

/* 0 inside a convex outline. */
function toOutline(p: Spot, corners: readonly Spot[]): number {
    let least = Number.POSITIVE_INFINITY;
    let sides = 0;
    corners.forEach((a, i) => {
        const b = corners[(i + 1) % corners.length] ?? a;
        least = Math.min(least, toSegment(p, a, b));
        sides += Math.sign((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
    });
    return Math.abs(sides) === corners.length ? 0 : least;
}

function toRing(p: Spot, part: Extract<Part, { kind: "ring" }>): number {
    let least = Number.POSITIVE_INFINITY;
    part.spots.forEach((a, i) => {
        const b = part.spots[i + 1];
        if (b && part.front[i]) {
            least = Math.min(least, toSegment(p, a, b));
        }
    });
    return least;
}

function toPart(p: Spot, part: Part): number {
    switch (part.kind) {
        case "arrow":
        case "bar":
            return toSegment(p, part.foot, part.tip);
        case "square":
            return toOutline(p, part.corners);
        case "ring":
            return toRing(p, part);
        case "middle":
            return Math.max(0, Math.hypot(p.x - part.at.x, p.y - part.at.y) - MIDDLE);
    }
}

/* The nearest part within `slop` pixels; of two that are equally near, the one in front. */
export function partAt(parts: readonly Part[], spot: Spot, slop: number): Part | null {
    let found: Part | null = null;
    let least = slop;
    for (const part of parts) {
        const far = toPart(spot, part);
        if (far <= least) {
            found = part;
            least = far;
        }
    }
    return found;
}

export function sameConstraint(a: Constraint | null, b: Constraint | null): boolean {
    return a?.motion === b?.motion && a?.axis === b?.axis && a?.plane === b?.plane;
}
