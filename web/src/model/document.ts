/* SPDX-License-Identifier: MIT */
/* A scene as the editor holds it: flat maps of nodes and resources, immutable, shared between
 * versions. Walks, names, and which row describes a value. Its JSON is documentJson.ts. */
import { declaredParams } from "./declaredParams.ts";
import { settingParams } from "./modelParams.ts";
import { LISTS, type ListName, parsePlace } from "./places.ts";
import type { Param, Schema, TypeRow, Values } from "./schema.ts";
import { findParam, nodeType } from "./schema.ts";

export interface SceneNode {
    readonly id: string;
    readonly type: string;
    readonly common: Values /* name, material, visible */;
    readonly transform: Values;
    readonly params: Values;
    /* Null for the root, and for the root of a model. */
    readonly parent: string | null;
    readonly children: readonly string[];
}

/* Something with a name of its own beside the tree. */
export interface Resource {
    readonly name: string;
    /* The type of a light or a volume, a material's shader; "" for others. */
    readonly type: string;
    readonly values: Values;
    /* A model's root node; "" for others. */
    readonly root: string;
}

export type ResourceLists = { readonly [list in ListName]: readonly Resource[] };

export interface SceneDocument extends ResourceLists {
    readonly info: Values /* name */;
    readonly camera: Values;
    readonly environment: Values;
    readonly render: Values;
    /* Of the tree and of all models. */
    readonly nodes: ReadonlyMap<string, SceneNode>;
    readonly root: string;
}

/* --- rows --- */

/* The same one always, as what is shown of it is not drawn anew then. */
const NO_ROWS: readonly Param[] = [];
const NO_TYPES: readonly TypeRow[] = [];

/* What a distance function or a shader of the document declares. */
export function declaredBy(
    schema: Schema,
    list: "primitives" | "shaders",
    resource: Resource | null,
): readonly Param[] {
    const rows = schema[list === "primitives" ? "primitive" : "shader"];
    const declaring = rows.find((param) => param.type === "rows");
    return declaredParams(declaring && resource?.values[declaring.name]);
}

const joined = new WeakMap<readonly Param[], WeakMap<readonly Param[], readonly Param[]>>();

/* Both lists in one; the same one for the same two. */
function join(first: readonly Param[], second: readonly Param[]): readonly Param[] {
    if (second.length === 0) {
        return first;
    }
    let known = joined.get(first);
    if (known === undefined) {
        known = new WeakMap();
        joined.set(first, known);
    }
    let both = known.get(second);
    if (both === undefined) {
        both = [...first, ...second];
        known.set(second, both);
    }
    return both;
}

/* The distance function that a node names, or null. */
export function functionOf(
    schema: Schema,
    document: SceneDocument,
    node: Pick<SceneNode, "type" | "params">,
): Resource | null {
    const row = nodeType(schema, node.type)?.params.find((param) => param.type === "function");
    const name = row && node.params[row.name];
    return typeof name === "string" ? findResource(document, "primitives", name) : null;
}

/* The model that a node is an instance of, or null. */
export function modelNamed(
    schema: Schema,
    document: SceneDocument,
    node: Pick<SceneNode, "type" | "params"> | undefined,
): Resource | null {
    const row = nodeType(schema, node?.type ?? "")?.params.find(({ type }) => type === "model");
    const name = row && node?.params[row.name];
    return typeof name === "string" ? findResource(document, "models", name) : null;
}

/* The rows of a node's parameters: its type's, then those of the distance function or model that it
 * names. */
export function nodeParams(
    schema: Schema,
    document: SceneDocument,
    node: Pick<SceneNode, "type" | "params">,
): readonly Param[] {
    const own = nodeType(schema, node.type)?.params ?? NO_ROWS;
    const model = modelNamed(schema, document, node);
    return join(
        own,
        model === null
            ? declaredBy(schema, "primitives", functionOf(schema, document, node))
            : settingParams(schema, document, model),
    );
}

/* Those that are of use: a node that names a distance function has its name and what that
 * declares; its own code, and what belongs to it, has no effect then. */
export function shownParams(
    schema: Schema,
    document: SceneDocument,
    node: Pick<SceneNode, "type" | "params">,
): readonly Param[] {
    const all = nodeParams(schema, document, node);
    if (functionOf(schema, document, node) === null) {
        return all;
    }
    const own = nodeType(schema, node.type)?.params ?? NO_ROWS;
    return all.filter((row) => row.type === "function" || !own.includes(row));
}

/* The built-in types of a list; none for lists without. */
export function typesOf(schema: Schema, list: ListName): readonly TypeRow[] {
    const { types } = LISTS[list];
    return types === null ? NO_TYPES : schema[types];
}

/* The rows of a resource's values. */
export function resourceParams(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    type: string,
): readonly Param[] {
    switch (list) {
        case "primitives":
            return schema.primitive;
        case "shaders":
            return schema.shader;
        case "models":
            return schema.model;
        default: {
            const builtIn = typesOf(schema, list).find((row) => row.type === type)?.params;
            const own = list === "materials" && findResource(document, "shaders", type);
            return builtIn ?? (own ? declaredBy(schema, "shaders", own) : NO_ROWS);
        }
    }
}

/* Is there such a type of light or volume, such a shader? Others have none. */
export function knowsType(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    type: string,
): boolean {
    return (
        LISTS[list].types === null ||
        typesOf(schema, list).some((row) => row.type === type) ||
        (list === "materials" && findResource(document, "shaders", type) !== null)
    );
}

/* The row that describes a place, and the values it stands in. */
export function paramAt(
    schema: Schema,
    document: SceneDocument,
    path: string,
): { param: Param; values: Values } | null {
    const place = parsePlace(path);
    if (place === null || !("name" in place) || place.name === null) {
        return null;
    }
    const found = (params: readonly Param[], values: Values | undefined) => {
        const param = findParam(params, place.name ?? "");
        return param && values ? { param, values } : null;
    };
    switch (place.kind) {
        case "info":
            return found(schema.node, document.info);
        case "record":
            return found(schema[place.record], document[place.record]);
        case "transform":
            return found(schema.transform, document.nodes.get(place.id)?.transform);
        case "node-value": {
            const node = document.nodes.get(place.id);
            if (node === undefined || place.group === "common") {
                return found(schema.node, node?.common);
            }
            return found(nodeParams(schema, document, node), node.params);
        }
        case "resource-value": {
            const resource = findResource(document, place.list, place.resource);
            const type = resource?.type ?? "";
            return found(resourceParams(schema, document, place.list, type), resource?.values);
        }
        default:
            return null;
    }
}

/* --- looking things up --- */

export function findResource(
    document: SceneDocument,
    list: ListName,
    name: string,
): Resource | null {
    return document[list].find((resource) => resource.name === name) ?? null;
}

export function isVisible(node: SceneNode): boolean {
    return node.common.visible !== false;
}

/* What a row shows: the given name, else the id. */
export function nodeLabel(node: SceneNode): string {
    const name = node.common.name;
    return typeof name === "string" && name !== "" ? name : node.id;
}

/* The material that applies, and the node that names it; null where none does up to the root. */
export function materialOf(
    document: SceneDocument,
    id: string,
): { material: string; from: string } | null {
    for (let node = document.nodes.get(id); node; node = parentOf(document, node)) {
        const material = node.common.material;
        if (typeof material === "string" && material !== "") {
            return { material, from: node.id };
        }
    }
    return null;
}

export function parentOf(document: SceneDocument, node: SceneNode): SceneNode | undefined {
    return node.parent === null ? undefined : document.nodes.get(node.parent);
}

/* Root first, the node itself last. */
export function pathTo(document: SceneDocument, id: string): SceneNode[] {
    const path: SceneNode[] = [];
    for (let node = document.nodes.get(id); node; node = parentOf(document, node)) {
        path.unshift(node);
    }
    return path;
}

export function isInside(document: SceneDocument, id: string, ancestor: string): boolean {
    for (let node = document.nodes.get(id); node; node = parentOf(document, node)) {
        if (node.id === ancestor) {
            return true;
        }
    }
    return false;
}

/* The sibling behind a node, or null where it is the last: what `before` says. */
export function siblingAfter(document: SceneDocument, id: string): string | null {
    const node = document.nodes.get(id);
    const siblings = (node && parentOf(document, node)?.children) ?? [];
    return siblings[siblings.indexOf(id) + 1] ?? null;
}

/* Pre-order ids of a subtree. */
export function preorder(document: SceneDocument, id: string = document.root): string[] {
    const order: string[] = [];
    const stack = [id];
    for (let next = stack.pop(); next !== undefined; next = stack.pop()) {
        const node = document.nodes.get(next);
        if (node) {
            order.push(next);
            stack.push(...[...node.children].reverse());
        }
    }
    return order;
}

/* The root of the scene, then those of the models. */
export function rootsOf(document: SceneDocument): string[] {
    return [document.root, ...document.models.map((model) => model.root)];
}

/* Pre-order ids of the scene and of all models. */
export function everyNode(document: SceneDocument): string[] {
    return rootsOf(document).flatMap((root) => preorder(document, root));
}

/* The model in whose tree a node is; null: it is in the scene's own. */
export function modelOf(document: SceneDocument, id: string): Resource | null {
    const top = pathTo(document, id)[0]?.id;
    return document.models.find((model) => model.root === top) ?? null;
}

/* Those ids that have no ancestor among them, in document order. */
export function topmost(document: SceneDocument, ids: Iterable<string>): string[] {
    const chosen = new Set(ids);
    const above = (id: string): boolean =>
        pathTo(document, id).some((node) => node.id !== id && chosen.has(node.id));
    return everyNode(document).filter((id) => chosen.has(id) && !above(id));
}

/* The first free id `stem-1`, `stem-2`, …; `taken` names further ids that are in use. */
export function freeId(
    document: SceneDocument,
    stem: string,
    taken: ReadonlySet<string> = new Set(),
): string {
    const base = stem.replace(/-\d+$/, "").slice(0, 56) || "node";
    for (let n = 1; ; n++) {
        const id = `${base}-${n}`;
        if (!document.nodes.has(id) && !taken.has(id)) {
            return id;
        }
    }
}

/* A name as it is, where it is free. */
export function plainName(document: SceneDocument, list: ListName, name: string): string {
    return findResource(document, list, name) === null ? name : freeName(document, list, name);
}

/* The first free name of a list, but for those `taken`; what no name can hold becomes "-". */
export function freeName(
    document: SceneDocument,
    list: ListName,
    stem: string,
    taken: ReadonlySet<string> = new Set(),
): string {
    const plain = stem.replace(/[^A-Za-z0-9_.-]+/g, "-").replace(/^-+|-+$|-\d+$/g, "");
    const base = plain.slice(0, 56) || LISTS[list].one;
    for (let n = 1; ; n++) {
        const name = `${base}-${n}`;
        if (findResource(document, list, name) === null && !taken.has(name)) {
            return name;
        }
    }
}

/* Whether a page that shows only `isolated` leaves the node out: it is neither one of them, nor
 * below one, nor around one. In other trees, of models, nothing is. */
/* Is it drawn, as far as it and what holds it say? */
export function isShown(document: SceneDocument, id: string): boolean {
    return pathTo(document, id).every(isVisible);
}

export function isApart(document: SceneDocument, isolated: readonly string[], id: string): boolean {
    const tree = pathTo(document, id)[0]?.id;
    const here = isolated.filter((other) => pathTo(document, other)[0]?.id === tree);
    return (
        here.length > 0 &&
        !here.some((other) => isInside(document, id, other) || isInside(document, other, id))
    );
}
