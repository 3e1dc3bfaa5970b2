/* SPDX-License-Identifier: MIT */
/* A hand that holds something: what its way over the picture means as a move, a turn or a scaling
 * in the world. Pure functions of the start and the pointer, so a lost event costs nothing. */
import { alongLine, onPlane, type Projection, type Spot } from "./projection.ts";
import {
    add,
    cross,
    dot,
    length,
    type Matrix,
    normalize,
    scale,
    subtract,
    type Vector,
} from "./transform.ts";
import { snap } from "./units.ts";

export type Motion = "move" | "turn" | "scale";
export const MOTIONS: readonly Motion[] = ["move", "turn", "scale"];
export type Axis = 0 | 1 | 2;
export const AXES: readonly Axis[] = [0, 1, 2];

/* Along or about one axis; `plane`: along both others instead. Null: free, in the picture's plane
 * or about the direction of view; all three for a scaling. */
export interface Constraint {
    readonly motion: Motion;
    readonly axis: Axis | null;
    readonly plane: boolean;
}

export type Delta =
    | { readonly motion: "move"; readonly by: Vector }
    /* `axis` is a unit vector of the world; radians, right-handed. */
    | { readonly motion: "turn"; readonly axis: Vector; readonly angle: number }
    /* Factors along a node's own axes. */
    | { readonly motion: "scale"; readonly factors: Vector };

/* Where and how a hand took hold. */
export interface Grip {
    readonly constraint: Constraint;
    readonly pivot: Vector;
    /* Its columns are the unit vectors of the axes, in the world. */
    readonly frame: Matrix;
    readonly projection: Projection;
    readonly from: Spot;
}

/* Steps of a snapped hand: units, radians, factors. */
export const SNAP: Readonly<Record<Motion, number>> = {
    move: 0.1,
    turn: Math.PI / 12,
    scale: 0.1,
};

export function axisOf(frame: Matrix, axis: Axis): Vector {
    return [frame[0][axis], frame[1][axis], frame[2][axis]];
}

/* The normal of the plane, the way of the line, or the axis of the turn. */
export function normalOf({ constraint, frame, projection, pivot }: Grip): Vector {
    return constraint.axis === null
        ? scale(projection.towards(pivot), -1)
        : axisOf(frame, constraint.axis);
}

/* --- moving --- */

/* Nothing is brought farther than so many heights of the picture, as it spans them at the pivot: near
 * the horizon of a plane, or where an axis vanishes, a pixel is as far as all before. */
const FARTHEST = 100;

/* Along one line. */
const isSingle = ({ axis, plane }: Constraint): boolean => axis !== null && !plane;

/* The point of the constraint's line or plane under a spot; null: none is before the camera. */
function metUnder(grip: Grip, spot: Spot): Vector | null {
    const { constraint, projection, pivot } = grip;
    const ray = projection.rayAt(spot);
    const normal = normalOf(grip);
    const along = isSingle(constraint) ? alongLine(ray, pivot, normal) : null;
    const onLine = along === null ? null : add(pivot, scale(normal, along));
    const point = isSingle(constraint) ? onLine : onPlane(ray, pivot, normal);
    return point && projection.spotOf(point) ? point : null;
}

/* The hand's way within its constraint; null: it is where that is not seen. A hand that begins there
 * goes as if it had taken the pivot. */
function wayOf(grip: Grip, to: Spot): Vector | null {
    const { projection, pivot, from } = grip;
    const start = metUnder(grip, from);
    const middle = projection.spotOf(pivot);
    if (middle === null) {
        return null;
    }
    const end = metUnder(
        grip,
        start ? to : { x: middle.x + to.x - from.x, y: middle.y + to.y - from.y },
    );
    const by = end && subtract(end, start ?? pivot);
    const most = FARTHEST * projection.unitsAt(pivot) * projection.size.height;
    return by && length(by) <= most ? by : null;
}

/* A vector of the world with its parts along the frame's axes rounded to `step`. */
function snapped(frame: Matrix, by: Vector, step: number): Vector {
    return AXES.reduce<Vector>(
        (sum, axis) => {
            const along = axisOf(frame, axis);
            return add(sum, scale(along, snap(dot(by, along), step)));
        },
        [0, 0, 0],
    );
}

function move(grip: Grip, to: Spot, step: number): Delta | null {
    const { constraint, frame } = grip;
    const by = wayOf(grip, to);
    if (by === null || step === 0) {
        return by && { motion: "move", by };
    }
    if (isSingle(constraint)) {
        const along = normalOf(grip);
        return { motion: "move", by: scale(along, snap(dot(by, along), step)) };
    }
    return { motion: "move", by: snapped(frame, by, step) };
}

/* --- turning --- */

/* Rays that meet a ring's plane at a smaller angle (its sine) say little about where. */
const GRAZING = 0.2;

/* The angle between two points of the picture, seen from the pivot, radians in (-pi, pi]. */
export function angleBetween(grip: Grip, a: Spot, b: Spot): number {
    const { projection, pivot } = grip;
    const axis = normalOf(grip);
    const slant = Math.abs(dot(projection.towards(pivot), axis));
    return slant < GRAZING ? angleEdgeOn(grip, axis, a, b) : angleOnPlane(grip, axis, a, b);
}

function angleOnPlane({ projection, pivot }: Grip, axis: Vector, a: Spot, b: Spot): number {
    const arm = (spot: Spot): Vector | null => {
        const point = onPlane(projection.rayAt(spot), pivot, axis);
        return point && subtract(point, pivot);
    };
    const [u, v] = [arm(a), arm(b)];
    return u && v ? Math.atan2(dot(axis, cross(u, v)), dot(u, v)) : 0;
}

/* Pixels that turn a ring seen from its edge by one radian. */
const EDGE_RADIUS = 90;

function angleEdgeOn({ projection, pivot }: Grip, axis: Vector, a: Spot, b: Spot): number {
    /* What is in front of the pivot moves in this direction as the angle grows. */
    const way = cross(axis, scale(projection.towards(pivot), -1));
    const direction = normalize([dot(way, projection.right), -dot(way, projection.up), 0]);
    return ((b.x - a.x) * direction[0] + (b.y - a.y) * direction[1]) / EDGE_RADIUS;
}

const TURN = 2 * Math.PI;

/* The angle of a hand that goes around more than once: the one nearest to what it was before. */
export function unwrapped(angle: number, before: number): number {
    return angle + TURN * Math.round((before - angle) / TURN);
}

/* --- scaling --- */

/* Pixels that double or halve when nothing else says how far the hand is from the pivot. */
const DOUBLING = 100;
const LEAST_FACTOR = 0.01;
/* A hand that begins nearer to the pivot than so many pixels is too near for that. */
const NEAR_PIVOT = 12;
/* The sine under which an axis points at the viewer. */
const HEAD_ON = 0.05;

function factorAlong(grip: Grip, axis: Vector, to: Spot): number | null {
    const { projection, pivot, from } = grip;
    const along = (spot: Spot): number | null => {
        const point = metUnder(grip, spot);
        return point && dot(subtract(point, pivot), axis);
    };
    const [start, end] = [along(from), along(to)];
    if (start === null || Math.abs(start) < NEAR_PIVOT * projection.unitsAt(pivot)) {
        return 2 ** (pixelsAlong(projection, axis, from, to) / DOUBLING);
    }
    return end === null ? null : end / start;
}

/* How far a hand goes the way that an axis has in the picture; of one that has none, right and up. */
function pixelsAlong({ right, up }: Projection, axis: Vector, from: Spot, to: Spot): number {
    const way: Vector = [dot(axis, right), dot(axis, up), 0];
    const seen = length(way) > HEAD_ON ? normalize(way) : [Math.SQRT1_2, Math.SQRT1_2];
    return (to.x - from.x) * seen[0] + (from.y - to.y) * seen[1];
}

function factorFree({ projection, pivot, from }: Grip, to: Spot): number {
    const center = projection.spotOf(pivot);
    const start = center ? Math.hypot(from.x - center.x, from.y - center.y) : 0;
    if (!center || start < 20) {
        return 2 ** ((to.x - from.x + from.y - to.y) / DOUBLING);
    }
    return Math.hypot(to.x - center.x, to.y - center.y) / start;
}

/* Which of the three a constraint scales. */
export function scaledAxes({ axis, plane }: Constraint): readonly boolean[] {
    return AXES.map((one) => axis === null || (one === axis) !== plane);
}

function scaling(constraint: Constraint, factor: number): Delta {
    const [x, y, z] = scaledAxes(constraint).map((scaled) => (scaled ? factor : 1));
    return { motion: "scale", factors: [x ?? 1, y ?? 1, z ?? 1] };
}

function resize(grip: Grip, to: Spot, step: number): Delta | null {
    const { constraint } = grip;
    const raw = isSingle(constraint) ? factorAlong(grip, normalOf(grip), to) : factorFree(grip, to);
    return raw === null
        ? null
        : scaling(constraint, Math.max(LEAST_FACTOR, step > 0 ? snap(raw, step) : raw));
}

/* --- all of them --- */

/* What the hand's way to a point means; null: nothing, as above the horizon of a plane. `step` 0:
 * nothing snaps. `turned`: the angle before, so that a hand may go around several times. */
export function deltaTo(grip: Grip, to: Spot, step = 0, turned = 0): Delta | null {
    switch (grip.constraint.motion) {
        case "move":
            return move(grip, to, step);
        case "turn": {
            const raw = unwrapped(angleBetween(grip, grip.from, to), turned);
            const angle = step > 0 ? Math.round(raw / step) * step : raw;
            return { motion: "turn", axis: normalOf(grip), angle };
        }
        case "scale":
            return resize(grip, to, step);
    }
}

/* What a typed number means: units along the axis (the picture's right where it is free), radians, or
 * a factor. */
export function deltaOf(grip: Grip, amount: number): Delta {
    const { constraint, frame, projection } = grip;
    switch (constraint.motion) {
        case "move": {
            const { axis, plane } = constraint;
            const along = axis === null || plane ? projection.right : axisOf(frame, axis);
            return { motion: "move", by: scale(along, amount) };
        }
        case "turn":
            return { motion: "turn", axis: normalOf(grip), angle: amount };
        case "scale":
            return scaling(constraint, amount);
    }
}
