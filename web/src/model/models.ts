/* SPDX-License-Identifier: MIT */
/* Edits about models: making one of a part of the scene, and taking an instance apart again. */
import { typeNaming } from "./add.ts";
import { findResource, freeName, modelNamed, nodeLabel, type SceneDocument } from "./document.ts";
import { printNode } from "./documentJson.ts";
import { type Edit, freshIds, keepPlace, movable, moveTo, renamed } from "./edits.ts";
import { isObject, type JsonObject, listOf } from "./json.ts";
import { treeWith } from "./modelParams.ts";
import type { Operation } from "./operation.ts";
import { ID_PATTERN } from "./places.ts";
import type { ResourceEdit } from "./resources.ts";
import type { Schema } from "./schema.ts";

/* The root of a model: structure and nothing else. */
const ROOT_TYPE = "group";

/* A name like the label of what is made a model. */
function nameFor(document: SceneDocument, label: string): string {
    const free = ID_PATTERN.test(label) && findResource(document, "models", label) === null;
    return free ? label : freeName(document, "models", label);
}

/* Moves nodes into a new model and puts an instance in their place. One node alone leaves its
 * transform to the instance, so that further instances begin at the origin. `label`: what to call
 * it; as the first node, where it is left out. */
export function makeModel(
    document: SceneDocument,
    schema: Schema,
    ids: readonly string[],
    label?: string,
): ResourceEdit | null {
    const inside = movable(document, ids);
    const first = document.nodes.get(inside[0] ?? "");
    const type = typeNaming(schema, "model");
    const param = type?.params.find((row) => row.type === "model");
    if (!first || first.parent === null || !type || !param) {
        return null;
    }
    const { parent } = first;
    const alone = inside.length === 1;
    const name = nameFor(document, label ?? nodeLabel(first));
    const fresh = freshIds(document);
    const rootId = fresh(`${name}-root`);
    const instance: JsonObject = {
        id: fresh(name),
        type: type.type,
        params: { [param.name]: name },
        ...(alone && Object.keys(first.transform).length > 0 ? { transform: first.transform } : {}),
    };
    const ops: Operation[] = [
        {
            op: "insert",
            into: "/models",
            before: null,
            name,
            value: { id: rootId, type: ROOT_TYPE },
        },
        { op: "insert", into: `/nodes/${parent}`, before: first.id, value: instance },
        ...inside.flatMap((id) => [
            ...(alone ? [] : keepPlace(document, id, parent)),
            moveTo(id, { into: rootId, before: null }),
        ]),
    ];
    if (alone && Object.keys(first.transform).length > 0) {
        ops.push({ op: "set", at: `/nodes/${first.id}/transform`, value: null });
    }
    return { ops, label: `make model ${name}`, select: [String(instance.id)], name };
}

/* Puts the parts of a model in place of one of its instances. */
export function unpackModel(document: SceneDocument, schema: Schema, id: string): Edit | null {
    const node = document.nodes.get(id);
    const model = modelNamed(schema, document, node);
    if (!node || node.parent === null || !model) {
        return null;
    }
    const root = treeWith(schema, document, model, node.params, printNode(document, model.root));
    const plain = root.type === ROOT_TYPE && root.transform === undefined && !root.material;
    const parts = plain ? listOf(root.children).filter(isObject) : [root];
    const fresh = freshIds(document);
    const value: JsonObject = {
        id: fresh(model.name),
        type: ROOT_TYPE,
        ...node.common,
        ...(Object.keys(node.transform).length > 0 ? { transform: node.transform } : {}),
        children: parts.map((part) => renamed(part, fresh)),
    };
    return {
        ops: [
            { op: "insert", into: `/nodes/${node.parent}`, before: id, value },
            { op: "remove", at: `/nodes/${id}` },
        ],
        label: `unpack ${nodeLabel(node)}`,
        select: [String(value.id)],
    };
}
