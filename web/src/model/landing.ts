/* SPDX-License-Identifier: MIT */
/* Where something comes to stand that is dropped on the picture: on the surface that is pointed at,
 * with its y axis along the normal, and beside which node. */
import { pathTo, type SceneDocument } from "./document.ts";
import { type JsonObject, listOf } from "./json.ts";
import { nodeType, type Schema } from "./schema.ts";
import { standingUnder, type Vector, vectorOf } from "./transform.ts";
import { tidy, tidyAngle } from "./units.ts";

/* A point of a surface in the world, and the unit vector that leaves it there. */
export interface Ground {
    readonly at: Vector;
    readonly normal: Vector;
    /* Scale of what is to stand there; absent: its own. */
    readonly size?: number;
}

/* The nodes that it is combined with, as a selection: what is selected where it is pointed at, else
 * the shape that is seen. Below a modifier the world's places are not known, so it is the outermost
 * modifier then. Empty: whatever the scene holds. */
export function landingBeside(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    seen: string | null,
): readonly string[] {
    const path = seen === null ? [] : pathTo(document, seen);
    if (path[0]?.id !== document.root) {
        return [];
    }
    const warp = path.findIndex(({ type }) => nodeType(schema, type)?.group === "modifier");
    const reachable = (warp < 0 ? path : path.slice(0, warp + 1)).slice(1);
    const chosen = reachable.filter(({ id }) => selection.includes(id)).at(-1);
    const node = chosen ?? reachable.at(-1);
    return node ? [node.id] : [];
}

/* The transform of what stands there as a child of `parent`; `turned` is what it brings itself, in
 * a document's form. */
export function landingTransform(
    document: SceneDocument,
    parent: string,
    { at, normal, size }: Ground,
    own: JsonObject = {},
): JsonObject {
    const turned = vectorOf(listOf(own.rotation).map(Number));
    const { translation, rotation } = standingUnder(document, parent, at, normal, turned);
    const { rotation: _, ...rest } = own;
    return {
        ...rest,
        translation: translation.map(tidy),
        ...(rotation.some((angle) => angle !== 0) ? { rotation: rotation.map(tidyAngle) } : {}),
        ...(size === undefined ? {} : { scale: size }),
    };
}
