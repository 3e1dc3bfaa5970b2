/* SPDX-License-Identifier: MIT */
/* Edits about materials, lights, volumes, models, distance functions and shaders: each answers
 * operations, the undo label, what to select, and the resource that it is about. */
import { typeNaming } from "./add.ts";
import {
    declaredBy,
    findResource,
    freeName,
    plainName,
    type Resource,
    type SceneDocument,
} from "./document.ts";
import { printResource } from "./documentJson.ts";
import { type Edit, freshIds, freshNames, renamedModel } from "./edits.ts";
import { equalJson, type Json, type JsonObject } from "./json.ts";
import type { Operation } from "./operation.ts";
import { LISTS, type ListName, resourcePlace, valuesPlace } from "./places.ts";
import { placing, type Way } from "./placing.ts";
import type { Preset } from "./presets.ts";
import { type DeclaredRow, nodeType, type Param, type Schema } from "./schema.ts";
import { NEW_PRIMITIVE, NEW_SHADER } from "./templates.ts";
import { listNamedBy, usersOf } from "./usage.ts";

export interface ResourceEdit extends Edit {
    readonly name: string;
}

/* Puts a resource into its list; `before` a name, null: last. */
export function insertResource(
    list: ListName,
    name: string,
    value: JsonObject,
    before: string | null,
): Operation {
    return LISTS[list].id
        ? { op: "insert", into: `/${list}`, before, value: { ...value, id: name } }
        : { op: "insert", into: `/${list}`, before, name, value };
}

const NO_NODES: readonly string[] = [];

/* What a new one consists of, and what else is made to see it: `use` is the value that names it,
 * where there is one already. */
function newParts(
    document: SceneDocument,
    schema: Schema,
    list: ListName,
    name: string,
    selection: readonly string[],
    way: Way,
    preset: JsonObject | null,
): { value: JsonObject; seen: Operation[]; select: readonly string[] } {
    const active = selection.at(-1);
    switch (list) {
        case "primitives":
        case "models": {
            const what = list === "models" ? "model" : "function";
            const fresh = freshIds(document);
            const rootId = fresh(`${name}-root`);
            const ball = { id: fresh("sphere"), type: "sphere" };
            const value =
                list === "models" ? { id: rootId, type: "group", children: [ball] } : NEW_PRIMITIVE;
            const row = typeNaming(schema, what);
            const param = row?.params.find(({ type }) => type === what);
            const id = fresh(name);
            const { ops, spot } = placing(document, schema, selection, row, way);
            const { into, before } = spot;
            const node = {
                id,
                type: row?.type ?? "",
                name: freshNames(document)(name),
                params: { [param?.name ?? ""]: name },
            };
            const insert: Operation = { op: "insert", into: `/nodes/${into}`, before, value: node };
            return row
                ? { value, seen: [...ops, insert], select: [id] }
                : { value, seen: [], select: NO_NODES };
        }
        case "shaders": {
            const material = freeName(document, "materials", name);
            const seen = [insertResource("materials", material, { shader: name }, null)];
            if (active !== undefined) {
                seen.push({ op: "set", at: `/nodes/${active}/material`, value: material });
            }
            return { value: NEW_SHADER, seen, select: selection };
        }
        default: {
            const plain = { shader: schema.shaders[0]?.type ?? "", properties: {} };
            return { value: preset ?? plain, seen: [], select: selection };
        }
    }
}

/* What a preset consists of: a material, and its shader where the document has none like it. */
function presetParts(document: SceneDocument, { shader, properties, code }: Preset) {
    const old = document.shaders.find(({ values }) => code && values.code === code.code);
    if (!code || old) {
        return { ops: [], value: { shader: old?.name ?? shader, properties } };
    }
    const name = plainName(document, "shaders", shader);
    return {
        ops: [insertResource("shaders", name, code, null)],
        value: { shader: name, properties },
    };
}

/* A new one. `use`: the place that is to name it. Else a distance function and a model come with
 * a node that shows them, a shader with a material, for the selected node if there is one. */
export function newResource(
    document: SceneDocument,
    schema: Schema,
    list: ListName,
    use: string | null,
    selection: readonly string[],
    way: Way = "union",
    preset: Preset | null = null,
): ResourceEdit {
    const name = preset
        ? plainName(document, list, preset.name)
        : freeName(document, list, LISTS[list].one);
    const made = preset && presetParts(document, preset);
    const like = preset && findResource(document, list, preset.name);
    /* Once more where nobody has changed it. */
    if (use !== null && like && equalJson(printResource(document, list, like), made?.value)) {
        const ops: Operation[] = [{ op: "set", at: use, value: like.name }];
        return { ops, label: `use ${like.name}`, select: selection, name: like.name };
    }
    const { value, seen, select } = newParts(
        document,
        schema,
        list,
        name,
        selection,
        way,
        made?.value ?? null,
    );
    const used: Operation[] = use === null ? seen : [{ op: "set", at: use, value: name }];
    const ops = [...(made?.ops ?? []), insertResource(list, name, value, null), ...used];
    return { ops, label: `add ${name}`, select: use === null ? select : selection, name };
}

/* A light or a volume. */
export function newTyped(document: SceneDocument, list: ListName, type: string): ResourceEdit {
    const name = freeName(document, list, type);
    const ops = [insertResource(list, name, { type }, null)];
    return { ops, label: `add ${name}`, select: NO_NODES, name };
}

/* A material of a shader of the document. */
export function newMaterialOf(document: SceneDocument, shader: string): ResourceEdit {
    const name = freeName(document, "materials", shader);
    const ops = [insertResource("materials", name, { shader }, null)];
    return { ops, label: `add ${name}`, select: NO_NODES, name };
}

/* A copy behind the original; the nodes of a model get ids of their own. */
export function duplicateResource(
    document: SceneDocument,
    list: ListName,
    resource: Resource,
): ResourceEdit {
    const name = freeName(document, list, resource.name);
    const at = document[list].findIndex((one) => one.name === resource.name);
    const before = document[list][at + 1]?.name ?? null;
    const ops = [insertResource(list, name, copyOf(document, list, resource), before)];
    return { ops, label: `duplicate ${resource.name}`, select: NO_NODES, name };
}

function copyOf(document: SceneDocument, list: ListName, resource: Resource): JsonObject {
    const value = printResource(document, list, resource);
    return list === "models" ? renamedModel(value, freshIds(document)) : value;
}

/* Makes everything that names a resource name another; null: nothing. */
function retarget(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    name: string,
    to: string | null,
): Operation[] {
    return usersOf(schema, document, list, name).flatMap((user): Operation[] => {
        if (user.kind === "material") {
            return [{ op: "set", at: `/materials/${user.name}/shader`, value: to ?? "" }];
        }
        const node = document.nodes.get(user.name);
        const places: [string, readonly Param[], JsonObject][] = [
            [`/nodes/${user.name}`, schema.node, node?.common ?? {}],
            [
                `/nodes/${user.name}/params`,
                nodeType(schema, node?.type ?? "")?.params ?? [],
                node?.params ?? {},
            ],
        ];
        return places.flatMap(([base, params, values]) =>
            params
                .filter((row) => listNamedBy(row.type) === list && values[row.name] === name)
                .map((row): Operation => ({ op: "set", at: `${base}/${row.name}`, value: to })),
        );
    });
}

/* Nodes of a material that goes take what their parents have. What else is used stays; why, says
 * whyNotRemoved. */
export function removeResource(
    document: SceneDocument,
    schema: Schema,
    list: ListName,
    name: string,
): ResourceEdit {
    const freed = list === "materials" ? retarget(schema, document, list, name, null) : [];
    const ops: Operation[] = [...freed, { op: "remove", at: resourcePlace(list, name) }];
    return { ops, label: `delete ${name}`, select: NO_NODES, name };
}

/* A name is an id here: the resource is put in again under the new one and its users follow. */
export function renameResource(
    document: SceneDocument,
    schema: Schema,
    list: ListName,
    resource: Resource,
    name: string,
): ResourceEdit {
    const ops: Operation[] = [
        insertResource(list, name, copyOf(document, list, resource), resource.name),
        ...retarget(schema, document, list, resource.name, name),
        { op: "remove", at: resourcePlace(list, resource.name) },
    ];
    return { ops, label: `rename ${resource.name}`, select: NO_NODES, name };
}

/* A copy of a shared material, for one node alone. */
export function uniqueMaterial(
    document: SceneDocument,
    node: string,
    material: Resource,
): ResourceEdit {
    const name = freeName(document, "materials", material.name);
    const value = printResource(document, "materials", material);
    const ops: Operation[] = [
        insertResource("materials", name, value, null),
        { op: "set", at: `/nodes/${node}/material`, value: name },
    ];
    return { ops, label: `make ${material.name} unique`, select: [node], name };
}

/* --- declared parameters --- */

/* Another name for a declared parameter: its users keep their values, the code follows. */
export function renameDeclared(
    document: SceneDocument,
    schema: Schema,
    list: "primitives" | "shaders",
    resource: Resource,
    rows: readonly DeclaredRow[],
    from: string,
    to: string,
): Operation[] {
    const own = schema[list === "primitives" ? "primitive" : "shader"];
    const base = resourcePlace(list, resource.name);
    const ops: Operation[] = [];
    for (const { name, type } of own) {
        const value = resource.values[name];
        if (type === "rows") {
            ops.push({ op: "set", at: `${base}/${name}`, value: rows });
        } else if (type === "code" && typeof value === "string") {
            const code = value.replace(new RegExp(`\\b${from}\\b`, "g"), to);
            ops.push({ op: "set", at: `${base}/${name}`, value: code });
        }
    }
    const known = declaredBy(schema, list, resource).some((param) => param.name === from);
    for (const user of known ? usersOf(schema, document, list, resource.name) : []) {
        const [place, values] =
            user.kind === "node"
                ? [`/nodes/${user.name}/params`, document.nodes.get(user.name)?.params]
                : [
                      valuesPlace("materials", user.name),
                      findResource(document, "materials", user.name)?.values,
                  ];
        const value = values?.[from];
        if (value !== undefined) {
            ops.push({ op: "set", at: `${place}/${to}`, value: value as Json });
        }
    }
    return ops;
}
