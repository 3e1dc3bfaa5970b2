/* SPDX-License-Identifier: MIT */
/* The library: what a scene gives to it, as a small document with all that it uses, and the edit that
 * takes it into another scene. */
import { needsSolid } from "./add.ts";
import {
    findResource,
    freeName,
    modelOf,
    nodeLabel,
    pathTo,
    type Resource,
    type SceneDocument,
} from "./document.ts";
import { printNode, printResource, readDocument } from "./documentJson.ts";
import { type Edit, freshIds, freshNames, renamed, renamedModel } from "./edits.ts";
import { isObject, type Json, type JsonObject, textOf } from "./json.ts";
import { type Ground, landingTransform } from "./landing.ts";
import type { Entry, EntryKind } from "./libraryEntries.ts";
import { adapted, adaptedResource, isSameResource, keyOf, needed, type Resolve } from "./naming.ts";
import type { Operation } from "./operation.ts";
import type { ListName, SavedList } from "./places.ts";
import { placing, type Way } from "./placing.ts";
import { type NodeType, nodeType, type Schema } from "./schema.ts";

/* Lists whose items an entry can hold, each after those that it names. */
const LISTS_HELD = ["shaders", "primitives", "materials", "models"] as const;
type Held = (typeof LISTS_HELD)[number];

/* --- giving --- */

/* Is it somebody's own shape: code, an equation, or the name of a distance function? */
function isWritten(row: NodeType | null): boolean {
    return row?.params.some(({ type }) => ["code", "equation", "function"].includes(type)) ?? false;
}

/* The material that applies to a node: its own or the nearest above. */
function materialOf(document: SceneDocument, id: string): string {
    const named = pathTo(document, id).map(({ common }) => textOf(common.material as Json));
    return named.filter((name) => name !== "").at(-1) ?? "";
}

function documentOf(
    schema: Schema,
    document: SceneDocument,
    name: string,
    root: JsonObject,
): JsonObject {
    const resources: Partial<Record<ListName, JsonObject>> = {};
    for (const { list, name: own } of needed(schema, document, [root])) {
        const resource = findResource(document, list, own);
        if (resource) {
            resources[list] = {
                ...resources[list],
                [own]: printResource(document, list, resource),
            };
        }
    }
    return { format: "fieldcast/1", name, ...resources, root };
}

/* A node with all below it, as it looks, where it stands at the origin. */
export function entryOfNode(schema: Schema, document: SceneDocument, id: string): Entry | null {
    const node = document.nodes.get(id);
    if (!node) {
        return null;
    }
    const { visible: _visible, transform, ...own } = printNode(document, id);
    const { translation: _translation, ...turned } = isObject(transform) ? transform : {};
    const material = materialOf(document, id);
    const root: JsonObject = {
        ...own,
        ...(Object.keys(turned).length > 0 ? { transform: turned } : {}),
        ...(material === "" ? {} : { material }),
    };
    const written = node.children.length === 0 && isWritten(nodeType(schema, node.type));
    return {
        kind: written ? "primitive" : "model",
        document: documentOf(schema, document, nodeLabel(node), root),
    };
}

export function entryOfResource(
    schema: Schema,
    document: SceneDocument,
    list: SavedList,
    resource: Resource,
): Entry | null {
    const { name } = resource;
    const entry = (kind: EntryKind, root: JsonObject): Entry => ({
        kind,
        document: documentOf(schema, document, name, root),
    });
    switch (list) {
        case "materials":
            return entry("material", { type: "sphere", material: name });
        case "models":
            return entry("model", printNode(document, resource.root));
        case "primitives": {
            const row = schema.nodes.find((one) => one.params.some(isFunction));
            const param = row?.params.find(isFunction);
            return row && param
                ? entry("primitive", { type: row.type, params: { [param.name]: name } })
                : null;
        }
    }
}

const isFunction = ({ type }: { type: string }): boolean => type === "function";

/* --- taking --- */

/* What the document has already, under the same name or one that was made of it. */
function knownAs(
    document: SceneDocument,
    list: Held,
    name: string,
    value: JsonObject,
): string | null {
    const stem = `${name}-`;
    const same = document[list].find(
        (one) =>
            (one.name === name ||
                (one.name.startsWith(stem) && /^\d+$/.test(one.name.slice(stem.length)))) &&
            isSameResource(list, printResource(document, list, one), value),
    );
    return same?.name ?? null;
}

interface Taken {
    readonly ops: readonly Operation[];
    /* The names that its resources have here. */
    readonly resolve: Resolve;
}

/* Brings in what an entry uses. What is here already is shared, but no models inside a model: one
 * could come to hold itself. */
function takeResources(
    schema: Schema,
    document: SceneDocument,
    entry: SceneDocument,
    fresh: (stem: string) => string,
    above: string,
): Taken {
    const names = new Map<string, string>();
    const resolve: Resolve = (named) => names.get(keyOf(named)) ?? named.name;
    const ops: Operation[] = [];
    const insideModel = modelOf(document, above) !== null;
    for (const list of LISTS_HELD) {
        for (const resource of inOrder(schema, entry, list)) {
            const { name } = resource;
            const json = adaptedResource(
                schema,
                list,
                printResource(entry, list, resource),
                resolve,
            );
            const shared = list !== "models" || !insideModel;
            const known = shared ? knownAs(document, list, name, json) : null;
            const free = findResource(document, list, name) === null;
            const own = known ?? (free ? name : freeName(document, list, name));
            names.set(keyOf({ list, name }), own);
            if (known === null) {
                const value = list === "models" ? renamedModel(json, fresh) : json;
                ops.push({ op: "insert", into: `/${list}`, before: null, name: own, value });
            }
        }
    }
    return { ops, resolve };
}

/* Models behind those of which they hold instances. */
function inOrder(schema: Schema, entry: SceneDocument, list: Held): readonly Resource[] {
    if (list !== "models") {
        return entry[list];
    }
    const roots = entry.models.map(({ root }) => printNode(entry, root));
    const names = needed(schema, entry, roots).filter((one) => one.list === "models");
    const inner = names.flatMap(({ name }) => findResource(entry, "models", name) ?? []);
    return [...inner, ...entry.models.filter((model) => !inner.includes(model))];
}

/* Where an entry goes. */
export interface Target {
    readonly selection: readonly string[];
    readonly way: Way;
    /* The node whose last input it becomes. */
    readonly into?: string | null;
    /* The place that names the material. */
    readonly use?: string | null;
    /* Where it comes to stand; null: where its parent is. */
    readonly ground?: Ground | null;
}

function takeMaterial(
    schema: Schema,
    document: SceneDocument,
    entry: SceneDocument,
    { selection, use }: Target,
): Edit | null {
    const [material] = entry.materials;
    if (!material) {
        return null;
    }
    const { ops, resolve } = takeResources(schema, document, entry, freshIds(document), "");
    const name = resolve({ list: "materials", name: material.name }) ?? material.name;
    const users = use ? [use] : selection.map((id) => `/nodes/${id}/material`);
    return {
        ops: [...ops, ...users.map((at): Operation => ({ op: "set", at, value: name }))],
        label: `add ${name}`,
        select: selection,
    };
}

function standing(
    document: SceneDocument,
    above: string,
    ground: Ground,
    node: JsonObject,
): JsonObject {
    const own = isObject(node.transform) ? node.transform : {};
    return { ...node, transform: landingTransform(document, above, ground, own) };
}

function takeTree(
    schema: Schema,
    document: SceneDocument,
    entry: SceneDocument,
    { selection, way, into, ground = null }: Target,
): Edit {
    const printed = printNode(entry, entry.root);
    const name = textOf(entry.info.name as Json, "entry");
    const row = nodeType(schema, textOf(printed.type));
    const place = into
        ? { ops: [], spot: { into, before: null }, above: into }
        : placing(document, schema, selection, row, way);
    const root = ground ? standing(document, place.above, ground, printed) : printed;
    const fresh = freshIds(document);
    const freshName = freshNames(document);
    for (const op of place.ops) {
        /* The place has taken an id and a name of this type. */
        const type = op.op === "insert" ? textOf(op.value.type) : "";
        if (type !== "") {
            fresh(type);
            freshName(type);
        }
    }
    const { ops, resolve } = takeResources(schema, document, entry, fresh, place.above);
    const own = renamed({ ...adapted(schema, root, resolve), name }, fresh, freshName);
    const maker = needsSolid(document, schema, row, place.above);
    const value = maker
        ? { id: fresh(maker), type: maker, name: freshName(maker), children: [own] }
        : own;
    const { into: parent, before } = place.spot;
    return {
        ops: [...ops, ...place.ops, { op: "insert", into: `/nodes/${parent}`, before, value }],
        label: `add ${name}`,
        select: [String(own.id)],
    };
}

/* A copy of an entry in a scene; null: there is nothing in it. */
export function takeEntry(
    schema: Schema,
    document: SceneDocument,
    { kind, document: json }: Entry,
    target: Target,
): Edit | null {
    const entry = readDocument(json);
    return kind === "material"
        ? takeMaterial(schema, document, entry, target)
        : takeTree(schema, document, entry, target);
}

/* The entry under another name. */
export const renameEntry = ({ kind, document }: Entry, name: string): Entry => ({
    kind,
    document: { ...document, name },
});
