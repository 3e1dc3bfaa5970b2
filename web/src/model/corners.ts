/* SPDX-License-Identifier: MIT */
/* Corners of flat shapes: the points of a row of type `points`, in the plane of their node. They are
 * dragged within it, put in on an edge, and taken away. */
import type { Dragged, Handle, HandleChange, Owner } from "./handles.ts";
import { onPlane, type Projection, type Spot } from "./projection.ts";
import { type Param, type Value, valueIn } from "./schema.ts";
import { cross, length, normalize, subtract, type Vector } from "./transform.ts";
import { shortNumber, snap, tidy } from "./units.ts";
import { COORDINATE, pointsOf } from "./values.ts";

type Corner = readonly [number, number];

const SNAP = 0.1;
const NO_CORNERS: readonly Corner[] = [];

function cornersIn({ values }: Owner, param: Param): readonly Corner[] {
    return param.type === "points" ? pointsOf(valueIn(values, param)) : NO_CORNERS;
}

const inSpace = ([x, y]: Corner): Vector => [x, y, 0];

/* A corner of a row of points, with the way to the corner after it. */
export function cornerHandles(dragged: Dragged, projection: Projection): Handle[] {
    const { owner, param } = dragged;
    const corners = cornersIn(owner, param);
    const spots = corners.map((corner) => projection.spotOf(owner.toWorld(inSpace(corner))));
    return corners.flatMap((corner, index) => {
        const [spot, next] = [spots[index], spots[(index + 1) % spots.length] ?? null];
        return spot
            ? [
                  {
                      ...dragged,
                      key: `${param.name}.${index}`,
                      spot,
                      component: index,
                      texts: inSpace(corner).map(String),
                      look: { kind: "corner" as const, next },
                  },
              ]
            : [];
    });
}

export const isCorner = (handle: Handle): boolean => handle.look.kind === "corner";

/* "point 3 of 6: 0.5 1". */
export function cornerLabel({ owner, param, component }: Handle, value?: Value): string {
    const corners = value === undefined ? cornersIn(owner, param) : pointsOf(value);
    const place = (corners[component ?? 0] ?? []).map(shortNumber).join(" ");
    return `point ${(component ?? 0) + 1} of ${corners.length}: ${place}`;
}

/* Where the ray through a spot meets the plane of the points; null where it does not. */
function underSpot(owner: Owner, projection: Projection, spot: Spot): Corner | null {
    const [origin, x, y] = [
        owner.toWorld([0, 0, 0]),
        owner.toWorld([1, 0, 0]),
        owner.toWorld([0, 1, 0]),
    ];
    const across = cross(subtract(x, origin), subtract(y, origin));
    if (length(across) === 0) {
        return null;
    }
    const point = onPlane(projection.rayAt(spot), origin, normalize(across));
    if (point === null || projection.spotOf(point) === null) {
        return null;
    }
    const own = owner.fromWorld(point);
    return [own[0], own[1]];
}

function changeTo({ at }: Handle, points: readonly Corner[]): HandleChange["op"] {
    return { op: "set", at, value: points };
}

const bounded = (x: number): number => tidy(Math.min(COORDINATE, Math.max(-COORDINATE, x)));

/* What a drag makes of the points: the corner goes with the spot, within its plane. */
export function dragCorner(
    handle: Handle,
    projection: Projection,
    spot: Spot,
    snaps: boolean,
): HandleChange | null {
    const there = underSpot(handle.owner, projection, spot);
    if (there === null) {
        return null;
    }
    const [x, y] = there.map((part) => bounded(snaps ? snap(part, SNAP) : part));
    const points = cornersIn(handle.owner, handle.param).map(
        (corner, i): Corner => (i === handle.component ? [x ?? 0, y ?? 0] : corner),
    );
    return { op: changeTo(handle, points), label: cornerLabel(handle, points) };
}

/* --- edges --- */

/* A place on the way from a corner to the next. */
export interface EdgeSpot {
    readonly handle: Handle;
    readonly spot: Spot;
}

function nearestOn(a: Spot, b: Spot, { x, y }: Spot): Spot {
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const square = dx * dx + dy * dy;
    const part = square === 0 ? 0 : ((x - a.x) * dx + (y - a.y) * dy) / square;
    const t = Math.min(1, Math.max(0, part));
    return { x: a.x + t * dx, y: a.y + t * dy };
}

/* The nearest place on an edge within `slop` pixels. */
export function edgeAt(handles: readonly Handle[], at: Spot, slop: number): EdgeSpot | null {
    let [best, least]: [EdgeSpot | null, number] = [null, slop];
    for (const handle of handles) {
        const next = handle.look.kind === "corner" ? handle.look.next : null;
        const spot = next && nearestOn(handle.spot, next, at);
        const far = spot ? Math.hypot(spot.x - at.x, spot.y - at.y) : Number.POSITIVE_INFINITY;
        if (spot && far <= least) {
            [best, least] = [{ handle, spot }, far];
        }
    }
    return best;
}

/* What an edit of the number of points comes to; or the number that it may not pass. */
export type CornerEdit =
    | HandleChange["op"]
    | { readonly most: number }
    | { readonly least: number };

/* A point more, at a place on an edge. */
export function putCorner({ handle, spot }: EdgeSpot, projection: Projection): CornerEdit | null {
    const { owner, param, component } = handle;
    const corners = cornersIn(owner, param);
    const most = param.max ?? Number.POSITIVE_INFINITY;
    if (corners.length >= most) {
        return { most };
    }
    const index = component ?? 0;
    const [a, b] = [corners[index], corners[(index + 1) % corners.length]];
    const there = underSpot(owner, projection, spot);
    if (!a || !b || !there) {
        return null;
    }
    /* The nearest point of the edge in its plane: the shape stays what it was. */
    const on = nearestOn({ x: a[0], y: a[1] }, { x: b[0], y: b[1] }, { x: there[0], y: there[1] });
    const fresh: Corner = [bounded(on.x), bounded(on.y)];
    return changeTo(handle, [...corners.slice(0, index + 1), fresh, ...corners.slice(index + 1)]);
}

/* Without a corner. */
export function dropCorner(handle: Handle): CornerEdit {
    const corners = cornersIn(handle.owner, handle.param);
    const least = handle.param.min ?? 0;
    return corners.length > least
        ? changeTo(
              handle,
              corners.filter((_, i) => i !== handle.component),
          )
        : { least };
}
