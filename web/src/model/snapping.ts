/* SPDX-License-Identifier: MIT */
/* Places that a moved thing is drawn to: the middles of other nodes, where its own comes near them in
 * the picture, and the surface under the pointer. */
import { ballOf } from "./bounds.ts";
import { surfaceAt } from "./distances.ts";
import { isInside, nodeLabel, preorder, type SceneDocument } from "./document.ts";
import { axisOf, type Grip } from "./grip.ts";
import { type Guide, nodeAt } from "./guide.ts";
import type { Projection, Spot } from "./projection.ts";
import type { Schema } from "./schema.ts";
import { text } from "./texts.ts";
import { add, dot, scale, subtract, type Vector } from "./transform.ts";

export interface Target {
    readonly name: string;
    /* In the world. */
    readonly at: Vector;
}

/* Pixels of the picture. */
const NEAR = 12;

const movesWith = (document: SceneDocument, moved: readonly string[], id: string): boolean =>
    moved.some((one) => one === id || isInside(document, id, one));

/* Shapes that move with nothing of `moved`. */
export function targetsOf(
    document: SceneDocument,
    schema: Schema,
    moved: readonly string[],
): readonly Target[] {
    return preorder(document).flatMap((id) => {
        const node = document.nodes.get(id);
        return node && node.children.length === 0 && !movesWith(document, moved, id)
            ? [{ name: nodeLabel(node), at: ballOf(document, schema, [id]).center }]
            : [];
    });
}

/* The point of a picture's surface at a spot, as it was before `moved` moved; null: nothing is there,
 * or it moves itself. */
export function surfaceUnder(
    document: SceneDocument,
    guide: Guide,
    projection: Projection,
    moved: readonly string[],
    spot: Spot,
): Target | null {
    const { width, height } = projection.size;
    const id = nodeAt(guide, spot.x / width, spot.y / height);
    const node = id === null ? undefined : document.nodes.get(id);
    const at = surfaceAt(guide, projection, spot);
    const still = id === null || !movesWith(document, moved, id);
    return at && still ? { name: node ? nodeLabel(node) : text("snap.floor"), at } : null;
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
