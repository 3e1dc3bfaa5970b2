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

/* null: there is no surface beside the equation, nowhere to put it, or it is so already. */
export function keepPatch(
    schema: Schema,
    document: SceneDocument,
    id: string,
): readonly Operation[] | null {
    const node = document.nodes.get(id);
    const surface = node?.params.parametric;
    const thickness = paramAt(schema, document, `/nodes/${id}/params/thickness`);
    if (!node || readSurface(surface) === null || !thickness || isTrimmed(document, node)) {
        return null;
    }
    const [insert, ...moves] = wrap(document, [id], "intersection").ops;
    if (insert?.op !== "insert" || !isObject(insert.value)) {
        return null;
    }
    const into = String(insert.value.id);
    const params = { surface, thickness: 2 * Number(valueIn(thickness.values, thickness.param)) };
    const { material } = node.common;
    const patch = {
        id: freshIds(document)("parametric"),
        type: "parametric",
        ...(material === undefined ? {} : { material }),
        ...(Object.keys(node.transform).length > 0 ? { transform: node.transform } : {}),
        params,
    } as JsonObject;
    return [
        insert,
        ...moves,
        { op: "set", at: `/nodes/${id}/params/mode`, value: "sheet" },
        { op: "insert", into: `/nodes/${into}`, before: null, value: patch },
    ];
}
