/* SPDX-License-Identifier: MIT */
/* The patch of an implicit surface alone, as one edit: its sheet, where that is within the
 * parametric surface of twice the thickness. */
import { paramAt, type SceneDocument, type SceneNode } from "./document.ts";
import { freshIds, wrap } from "./edits.ts";
import { isObject, type JsonObject } from "./json.ts";
import type { Operation } from "./operation.ts";
import { type Schema, valueIn } from "./schema.ts";
import { readSurface } from "./surface.ts";

const isPatch = (node: SceneNode | undefined): boolean => node?.type === "parametric";

/* Whether the parent has it cut by a patch. */
function isTrimmed(document: SceneDocument, node: SceneNode): boolean {
    const parent = document.nodes.get(node.parent ?? "");
    const beside = parent?.children.map((id) => document.nodes.get(id)) ?? [];
    return parent?.type === "intersection" && beside.some(isPatch);
}

const patchOf = (document: SceneDocument, params: JsonObject, more: JsonObject): JsonObject => ({
    id: freshIds(document)("parametric"),
    type: "parametric",
    ...more,
    params,
});

/* A root stays, with its place and material, and cuts what it was. */
function cutRoot(document: SceneDocument, node: SceneNode, patch: JsonObject): Operation[] {
    const at = `/nodes/${node.id}`;
    const sheet = {
        id: freshIds(document)(node.type),
        type: node.type,
        params: { ...node.params, mode: "sheet" },
    };
    return [
        { op: "set", at: `${at}/type`, value: "intersection" },
        { op: "insert", into: at, before: null, value: sheet },
        { op: "insert", into: at, before: null, value: patchOf(document, patch, {}) },
    ];
}

function cutChild(document: SceneDocument, node: SceneNode, patch: JsonObject): Operation[] {
    const [insert, ...moves] = wrap(document, [node.id], "intersection").ops;
    const into = insert?.op === "insert" && isObject(insert.value) ? String(insert.value.id) : "";
    const { material } = node.common;
    const value = patchOf(document, patch, {
        ...(material === undefined ? {} : { material }),
        ...(Object.keys(node.transform).length > 0 ? { transform: node.transform } : {}),
    });
    return [
        ...(insert ? [insert] : []),
        ...moves,
        { op: "set", at: `/nodes/${node.id}/params/mode`, value: "sheet" },
        { op: "insert", into: `/nodes/${into}`, before: null, value },
    ];
}

/* null: there is no surface beside the equation, or it is so already. */
export function keepPatch(
    schema: Schema,
    document: SceneDocument,
    id: string,
): readonly Operation[] | null {
    const node = document.nodes.get(id);
    const surface = node?.params.parametric;
    const thickness = paramAt(schema, document, `/nodes/${id}/params/thickness`);
    if (
        !node ||
        surface === undefined ||
        readSurface(surface) === null ||
        !thickness ||
        isTrimmed(document, node)
    ) {
        return null;
    }
    const params = { surface, thickness: 2 * Number(valueIn(thickness.values, thickness.param)) };
    return node.parent === null
        ? cutRoot(document, node, params)
        : cutChild(document, node, params);
}
