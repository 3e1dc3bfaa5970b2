/* SPDX-License-Identifier: MIT */
/* Builders of the edits that menus, keys, palette and tree share: wrap, duplicate, reorder, move
 * elsewhere, dissolve. Each answers operations, the undo label, what to select. */
import {
    freeId,
    nodeLabel,
    parentOf,
    preorder,
    type SceneDocument,
    siblingAfter,
    topmost,
} from "./document.ts";
import { printNode, treeOf } from "./documentJson.ts";
import { isObject, type JsonObject, listOf, textOf } from "./json.ts";
import { placeOf, released, SETTINGS, targetOf } from "./modelParams.ts";
import type { Operation } from "./operation.ts";
import type { Schema } from "./schema.ts";
import { transformOf, transformUnder } from "./transform.ts";
import { tidy, tidyAngle } from "./units.ts";

export interface Edit {
    readonly ops: readonly Operation[];
    readonly label: string;
    /* Node ids to select afterwards. */
    readonly select: readonly string[];
}

/* Where something new goes. */
export interface Spot {
    readonly into: string;
    readonly before: string | null;
}

const wordsOf = (type: string): string => type.replaceAll("_", " ");

/* "head", or "3 nodes". */
export function nameAll(document: SceneDocument, ids: readonly string[]): string {
    const node = document.nodes.get(ids[0] ?? "");
    return ids.length === 1 && node ? nodeLabel(node) : `${ids.length} nodes`;
}

/* Those of `ids` that an edit can move or remove: no root, no node inside another of them. */
export function movable(document: SceneDocument, ids: readonly string[]): string[] {
    return topmost(document, ids).filter((id) => document.nodes.get(id)?.parent !== null);
}

/* Names ids that are free, each once. */
export function freshIds(document: SceneDocument): (stem: string) => string {
    const taken = new Set<string>();
    return (stem) => {
        const id = freeId(document, stem, taken);
        taken.add(id);
        return id;
    };
}

/* Names nodes as people read them: "Round cylinder", and "Round cylinder 2" where that is taken. */
export function freshNames(document: SceneDocument): (stem: string) => string {
    const taken = new Set(
        [...document.nodes.values()].map((node) => nodeLabel(node).toLowerCase()),
    );
    return (stem) => {
        const words = wordsOf(stem).replace(/ \d+$/, "");
        const base = `${words.charAt(0).toUpperCase()}${words.slice(1)}`;
        let name = base;
        for (let n = 2; taken.has(name.toLowerCase()); n++) {
            name = `${base} ${n}`;
        }
        taken.add(name.toLowerCase());
        return name;
    };
}

/* Puts a new node of `type` around the given ones, at the place of the first. */
export function wrap(document: SceneDocument, ids: readonly string[], type: string): Edit {
    const inside = movable(document, ids);
    const first = document.nodes.get(inside[0] ?? "");
    if (!first || first.parent === null) {
        return { ops: [], label: "", select: [] };
    }
    const id = freshIds(document)(type);
    const insert: Operation = {
        op: "insert",
        into: `/nodes/${first.parent}`,
        before: first.id,
        value: { id, type, name: freshNames(document)(type) },
    };
    const parent = first.parent;
    const moves = inside.flatMap((child) => [
        ...keepPlace(document, child, parent),
        moveTo(child, { into: id, before: null }),
    ]);
    const label = `wrap ${nameAll(document, inside)} in ${wordsOf(type)}`;
    return { ops: [insert, ...moves], label, select: [id] };
}

/* Puts a node elsewhere. */
export function moveTo(id: string, spot: Spot): Operation {
    return { op: "move", at: `/nodes/${id}`, into: `/nodes/${spot.into}`, before: spot.before };
}

/* Sets the transform so that the node stays where it is in the world under a new parent. */
export function keepPlace(document: SceneDocument, id: string, parent: string): Operation[] {
    const node = document.nodes.get(id);
    const wanted = node && node.parent !== parent ? transformUnder(document, id, parent) : null;
    if (!node || !wanted) {
        return [];
    }
    const now = transformOf(node);
    const ops: Operation[] = [];
    for (const name of ["translation", "rotation", "scale"] as const) {
        const value = wanted[name].map(name === "rotation" ? tidyAngle : tidy);
        if (value.some((x, i) => Math.abs(x - (now[name][i] ?? 0)) > 1e-6)) {
            ops.push({ op: "set", at: `/nodes/${id}/transform/${name}`, value });
        }
    }
    return ops;
}

/* Moves nodes to another parent or place, in their order; they stay where they are in the world. */
export function moveNodes(document: SceneDocument, ids: readonly string[], spot: Spot): Edit {
    const moved = movable(document, ids);
    /* A node cannot stand in front of one that moves along. */
    let before = spot.before;
    while (before !== null && moved.includes(before)) {
        before = siblingAfter(document, before);
    }
    const ops = moved.flatMap((id) => [
        ...keepPlace(document, id, spot.into),
        moveTo(id, { into: spot.into, before }),
    ]);
    return { ops, label: `move ${nameAll(document, moved)}`, select: moved };
}

/* One step up or down among the siblings; null at the end. */
export function reorder(document: SceneDocument, id: string, direction: -1 | 1): Edit | null {
    const node = document.nodes.get(id);
    const siblings = (node && parentOf(document, node)?.children) ?? [];
    const index = siblings.indexOf(id);
    const target = index + direction;
    if (!node || node.parent === null || index < 0 || target < 0 || target >= siblings.length) {
        return null;
    }
    const before = siblings[direction < 0 ? target : target + 1] ?? null;
    const ops = [moveTo(id, { into: node.parent, before })];
    return { ops, label: `reorder ${nodeLabel(node)}`, select: [id] };
}

/* A node's JSON with new ids throughout, and new names where `name` gives them. */
export function renamed(
    json: JsonObject,
    fresh: (stem: string) => string,
    name?: (stem: string) => string,
): JsonObject {
    const stem = typeof json.id === "string" ? json.id : String(json.type);
    const label = typeof json.name === "string" && json.name !== "" ? json.name : stem;
    const children = listOf(json.children)
        .filter(isObject)
        .map((child) => renamed(child, fresh, name));
    const { children: _old, ...own } = json;
    return {
        ...own,
        id: fresh(stem),
        ...(name ? { name: name(label) } : {}),
        ...(children.length > 0 ? { children } : {}),
    };
}

/* A model's JSON with new ids throughout; what its parameters set goes along. */
export function renamedModel(json: JsonObject, fresh: (stem: string) => string): JsonObject {
    const ids = new Map<string, string>();
    const own = treeOf(json);
    const tree = renamed(own, (stem) => {
        const id = fresh(stem);
        ids.set(stem, id);
        return id;
    });
    const follow = (row: JsonObject): JsonObject => {
        const target = targetOf(textOf(row.sets));
        const node = target && ids.get(target.node);
        return target && node ? { ...row, sets: placeOf({ ...target, node }) } : row;
    };
    return own === json
        ? tree
        : { ...json, [SETTINGS]: listOf(json[SETTINGS]).filter(isObject).map(follow), root: tree };
}

/* Copies with ids and names of their own. */
export function copyInto(
    document: SceneDocument,
    nodes: readonly JsonObject[],
    spotOf: (index: number) => Spot,
    fresh: (stem: string) => string,
): { ops: Operation[]; select: string[] } {
    const select: string[] = [];
    const name = freshNames(document);
    const ops = nodes.map((json, index): Operation => {
        const value = renamed(json, fresh, name);
        const spot = spotOf(index);
        select.push(String(value.id));
        return { op: "insert", into: `/nodes/${spot.into}`, before: spot.before, value };
    });
    return { ops, select };
}

/* Copies in place, each behind its original. */
export function duplicate(document: SceneDocument, ids: readonly string[]): Edit {
    const originals = movable(document, ids);
    const copies = copyInto(
        document,
        originals.map((id) => printNode(document, id)),
        (index) => {
            const id = originals[index] ?? "";
            const into = document.nodes.get(id)?.parent ?? document.root;
            return { into, before: siblingAfter(document, id) };
        },
        freshIds(document),
    );
    return { ...copies, label: `duplicate ${nameAll(document, originals)}` };
}

/* Removes nodes; selects the neighbour, so that Delete can be pressed again. */
export function removeNodes(document: SceneDocument, schema: Schema, ids: readonly string[]): Edit {
    const gone = movable(document, ids);
    const last = document.nodes.get(gone.at(-1) ?? "");
    const siblings = (last && parentOf(document, last)?.children) ?? [];
    const rest = siblings.filter((id) => !gone.includes(id));
    const index = siblings
        .slice(0, siblings.indexOf(last?.id ?? ""))
        .filter((id) => rest.includes(id)).length;
    const next = rest[index] ?? rest.at(-1) ?? last?.parent ?? null;
    return {
        ops: [
            ...released(
                schema,
                document,
                gone.flatMap((id) => preorder(document, id)),
            ),
            ...gone.map((id): Operation => ({ op: "remove", at: `/nodes/${id}` })),
        ],
        label: `delete ${nameAll(document, gone)}`,
        select: next === null || document.nodes.get(next)?.parent === null ? [] : [next],
    };
}

/* Takes a node away and leaves its children in its place. */
export function dissolve(document: SceneDocument, schema: Schema, id: string): Edit {
    const node = document.nodes.get(id);
    if (!node || node.parent === null) {
        return { ops: [], label: "", select: [] };
    }
    const into = node.parent;
    const moves = node.children.flatMap((child) => [
        ...keepPlace(document, child, into),
        moveTo(child, { into, before: id }),
    ]);
    return {
        ops: [...released(schema, document, [id]), ...moves, { op: "remove", at: `/nodes/${id}` }],
        label: `dissolve ${nodeLabel(node)}`,
        select: node.children,
    };
}

export function rename(document: SceneDocument, id: string, name: string): Edit {
    const node = document.nodes.get(id);
    const value = name.trim() === "" || name.trim() === id ? null : name.trim();
    return {
        ops: [{ op: "set", at: `/nodes/${id}/name`, value }],
        label: `rename ${node ? nodeLabel(node) : id}`,
        select: [id],
    };
}

/* Shows or hides; what is visible by default is written as nothing. */
export function setVisible(
    document: SceneDocument,
    ids: readonly string[],
    visible: boolean,
): Edit {
    return {
        ops: ids.map((id) => ({
            op: "set",
            at: `/nodes/${id}/visible`,
            value: visible ? null : false,
        })),
        label: `${visible ? "show" : "hide"} ${nameAll(document, ids)}`,
        select: ids,
    };
}
