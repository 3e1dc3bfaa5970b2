/* SPDX-License-Identifier: MIT */
/* Moves of nodes between the inputs of others, which the tree and the graph share: which of them
 * fit, the edits that they make, and the shelf, a hidden group at the root for what is not in
 * use. */
import { isInside, nodeLabel, pathTo, type SceneDocument, type SceneNode } from "./document.ts";
import { type Edit, freshIds, keepPlace, movable, moveNodes, moveTo, nameAll } from "./edits.ts";
import type { Operation } from "./operation.ts";
import { apply } from "./operations.ts";
import { isContainer } from "./placing.ts";
import { nodeType, type Schema } from "./schema.ts";
import { modelsHeldBy } from "./usage.ts";

/* Can nodes become children of `into`? It must be made to hold others; no node and no model may
 * come to hold itself. */
export function fits(
    schema: Schema,
    document: SceneDocument,
    ids: readonly string[],
    into: string,
): boolean {
    const row = nodeType(schema, document.nodes.get(into)?.type ?? "");
    return (
        row !== null &&
        isContainer(row) &&
        !ids.some((id) => isInside(document, into, id)) &&
        !ids.some((id) => modelsHeldBy(schema, document, id, into))
    );
}

/* Makes nodes the inputs of `into` from the one numbered `index` on; null where they are that. */
export function connect(
    document: SceneDocument,
    ids: readonly string[],
    into: string,
    index: number,
): Edit | null {
    const moved = movable(document, ids);
    const old = document.nodes.get(into)?.children ?? [];
    const others = old.filter((id) => !moved.includes(id));
    const next = [...others.slice(0, index), ...moved, ...others.slice(index)];
    const same = next.length === old.length && next.every((id, i) => id === old[i]);
    return same || moved.length === 0
        ? null
        : moveNodes(document, moved, { into, before: others[index] ?? null });
}

/* Puts a node between `child` and its parent; both stay where they are in the world. Null where it
 * does not fit there. */
export function insertBetween(
    schema: Schema,
    document: SceneDocument,
    id: string,
    child: string,
): Edit | null {
    const node = document.nodes.get(id);
    const into = document.nodes.get(child)?.parent ?? null;
    const row = nodeType(schema, node?.type ?? "");
    if (!node || into === null || row === null || !isContainer(row)) {
        return null;
    }
    const put = moveNodes(document, [id], { into, before: child }).ops;
    const then = apply(document, put, schema);
    if (put.length === 0 || !then.ok) {
        return null;
    }
    const held = [
        ...keepPlace(then.document, child, id),
        moveTo(child, { into: id, before: null }),
    ];
    return { ops: [...put, ...held], label: `insert ${nodeLabel(node)}`, select: [id] };
}

/* --- the shelf --- */

const SHELF = "Shelf";

/* The shelf of the tree in which a node is; null where there is none yet. */
function shelfOf(document: SceneDocument, id: string): SceneNode | null {
    const [top] = pathTo(document, id);
    const found = top?.children.find((child) => {
        const node = document.nodes.get(child);
        return node?.type === "group" && nodeLabel(node) === SHELF && node.common.visible === false;
    });
    return document.nodes.get(found ?? "") ?? null;
}

/* Is a node on the shelf, or below one that is? */
export function isParked(document: SceneDocument, id: string): boolean {
    const shelf = shelfOf(document, id);
    return shelf !== null && shelf.id !== id && isInside(document, id, shelf.id);
}

/* Those of `ids` that can be put on the shelf. */
export function parkable(document: SceneDocument, ids: readonly string[]): string[] {
    return movable(document, ids).filter(
        (id) => !isParked(document, id) && shelfOf(document, id)?.id !== id,
    );
}

/* Those of the tree in which the first one is. */
function ofOneTree(document: SceneDocument, ids: readonly string[]): readonly string[] {
    const rootOf = (id: string) => pathTo(document, id)[0]?.id;
    return ids.filter((id) => rootOf(id) === rootOf(ids[0] ?? ""));
}

/* Puts nodes of one tree on its shelf, which is made where there is none. */
export function park(document: SceneDocument, ids: readonly string[]): Edit | null {
    const parked = ofOneTree(document, parkable(document, ids));
    const root = pathTo(document, parked[0] ?? "")[0]?.id;
    if (root === undefined) {
        return null;
    }
    const old = shelfOf(document, root)?.id;
    const shelf = old ?? freshIds(document)(SHELF.toLowerCase());
    const value = { id: shelf, type: "group", name: SHELF, visible: false };
    const insert: Operation = { op: "insert", into: `/nodes/${root}`, before: null, value };
    const moves = parked.flatMap((id) => [
        ...keepPlace(document, id, old ?? root),
        moveTo(id, { into: shelf, before: null }),
    ]);
    const ops = old === undefined ? [insert, ...moves] : moves;
    return { ops, label: `put ${nameAll(document, parked)} on the shelf`, select: parked };
}

/* Takes nodes off the shelf of a tree: to the root, in front of it. */
export function unpark(document: SceneDocument, ids: readonly string[]): Edit | null {
    const parked = movable(document, ids).filter((id) => isParked(document, id));
    const taken = ofOneTree(document, parked);
    const shelf = shelfOf(document, taken[0] ?? "");
    if (shelf?.parent == null) {
        return null;
    }
    const edit = moveNodes(document, taken, { into: shelf.parent, before: shelf.id });
    return { ...edit, label: `take ${nameAll(document, taken)} off the shelf` };
}
