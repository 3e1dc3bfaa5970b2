/* SPDX-License-Identifier: MIT */
/* Places that a moved thing is drawn to: the middles of other nodes, where its own comes near them in
 * the picture. */
import { ballOf } from "./bounds.ts";
import { isInside, nodeLabel, preorder, type SceneDocument } from "./document.ts";
import { axisOf, type Grip } from "./grip.ts";
import type { Projection } from "./projection.ts";
import type { Schema } from "./schema.ts";
import { add, dot, scale, subtract, type Vector } from "./transform.ts";

export interface Target {
    readonly name: string;
    /* In the world. */
    readonly at: Vector;
}

/* Pixels of the picture. */
const NEAR = 12;

/* Shapes that move with nothing of `moved`. */
export function targetsOf(
    document: SceneDocument,
    schema: Schema,
    moved: readonly string[],
): readonly Target[] {
    const moves = (id: string): boolean =>
        moved.some((one) => one === id || isInside(document, id, one));
    return preorder(document).flatMap((id) => {
        const node = document.nodes.get(id);
        return node && node.children.length === 0 && !moves(id)
            ? [{ name: nodeLabel(node), at: ballOf(document, schema, [id]).center }]
            : [];
    });
}

/* The way as far as the constraint lets it go. */
function allowed({ constraint, frame }: Grip, by: Vector): Vector {
    const { axis, plane } = constraint;
    if (axis === null) {
        return by;
    }
    const along = axisOf(frame, axis);
    const part = scale(along, dot(by, along));
    return plane ? subtract(by, part) : part;
}

export interface Snapped {
    readonly target: Target;
    readonly by: Vector;
}

/* The move nearest to `by`, among those that bring the pivot to a target or beside it; null: none is
 * near in the picture. */
export function snapTo(grip: Grip, by: Vector, targets: readonly Target[]): Snapped | null {
    let best: Snapped | null = null;
    let least = NEAR;
    for (const target of targets) {
        const way = allowed(grip, subtract(target.at, grip.pivot));
        const far = pixelsBetween(grip.projection, add(grip.pivot, by), add(grip.pivot, way));
        if (far < least) {
            least = far;
            best = { target, by: way };
        }
    }
    return best;
}

function pixelsBetween(projection: Projection, a: Vector, b: Vector): number {
    const [from, to] = [projection.spotOf(a), projection.spotOf(b)];
    return from && to ? Math.hypot(to.x - from.x, to.y - from.y) : Number.POSITIVE_INFINITY;
}
