/* SPDX-License-Identifier: MIT */
/* The JSON of documents, nodes and resources: reading what the server has checked, and printing. */
import type { Resource, ResourceLists, SceneDocument, SceneNode } from "./document.ts";
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import { LIST_NAMES, LISTS, type ListName } from "./places.ts";
import type { Value, Values } from "./schema.ts";

function readValues(json: Json | undefined): Values {
    const values: Record<string, Value> = {};
    for (const [name, value] of Object.entries(isObject(json) ? json : {})) {
        if (value !== undefined && value !== null) {
            values[name] = value as Value;
        }
    }
    return values;
}

function pick(json: JsonObject, names: readonly string[]): Values {
    return readValues(Object.fromEntries(names.map((name) => [name, json[name]])));
}

function omit(json: JsonObject, names: readonly string[]): Values {
    return readValues(
        Object.fromEntries(Object.entries(json).filter(([name]) => !names.includes(name))),
    );
}

/* Adds a node with its subtree to `nodes`; returns its id. Nodes without an id get a free one. */
export function readNode(
    json: JsonObject,
    parent: string | null,
    nodes: Map<string, SceneNode>,
): string {
    const type = textOf(json.type);
    let id = textOf(json.id);
    for (let n = 1; id === ""; n++) {
        id = nodes.has(`${type}-${n}`) ? "" : `${type}-${n}`;
    }
    const node = {
        id,
        type,
        common: pick(json, ["name", "material", "visible"]),
        transform: readValues(json.transform),
        params: readValues(json.params),
        parent,
        children: [] as string[],
    };
    nodes.set(id, node);
    for (const child of listOf(json.children)) {
        if (isObject(child)) {
            node.children.push(readNode(child, id, nodes));
        }
    }
    return id;
}

/* A resource without a tree; `name` of a light is in it. */
export function readResource(list: ListName, name: string, json: JsonObject): Resource {
    const row = LISTS[list];
    const own = [...(row.id ? ["id"] : []), ...(row.type === null ? [] : [row.type])];
    return {
        name: row.id ? textOf(json.id) : name,
        type: row.type === null ? "" : textOf(json[row.type]),
        values: row.values === null ? omit(json, own) : readValues(json[row.values]),
        root: "",
    };
}

/* The tree of a model, which is the model where it declares nothing. */
export const treeOf = (json: JsonObject): JsonObject => (isObject(json.root) ? json.root : json);

/* A model with another tree. */
export const withTree = (json: JsonObject, tree: JsonObject): JsonObject =>
    isObject(json.root) ? { ...json, root: tree } : tree;

/* Adds a model's nodes to `nodes`. */
export function readModel(name: string, json: JsonObject, nodes: Map<string, SceneNode>): Resource {
    const tree = treeOf(json);
    const values = tree === json ? {} : omit(json, ["root"]);
    return { name, type: "", values, root: readNode(tree, null, nodes) };
}

/* A model's JSON with this tree. */
export const modelJson = (values: Values, tree: JsonObject): JsonObject =>
    Object.keys(values).length > 0 ? { ...values, root: tree } : tree;

function readList(list: ListName, json: Json | undefined, nodes: Map<string, SceneNode>) {
    if (LISTS[list].id) {
        return listOf(json)
            .filter(isObject)
            .map((item) => readResource(list, "", item));
    }
    return Object.entries(isObject(json) ? json : {}).map(([name, value]) => {
        const item = isObject(value) ? value : {};
        return list === "models" ? readModel(name, item, nodes) : readResource(list, name, item);
    });
}

/* Reads a document that the server has checked. */
export function readDocument(json: Json): SceneDocument {
    const object = isObject(json) ? json : {};
    const nodes = new Map<string, SceneNode>();
    const root = readNode(isObject(object.root) ? object.root : { type: "union" }, null, nodes);
    const lists = Object.fromEntries(
        LIST_NAMES.map((list) => [list, readList(list, object[list], nodes)]),
    ) as unknown as ResourceLists;
    return {
        ...lists,
        info: pick(object, ["name"]),
        camera: readValues(object.camera),
        environment: readValues(object.environment),
        render: readValues(object.render),
        nodes,
        root,
    };
}

/* The JSON of a node with its subtree: what `insert` and the clipboard carry. */
export function printNode(document: SceneDocument, id: string): JsonObject {
    const node = document.nodes.get(id);
    if (!node) {
        throw new Error(`no node ${id}`);
    }
    const full = <T extends object>(value: T) => Object.keys(value).length > 0;
    return {
        id: node.id,
        type: node.type,
        ...node.common,
        ...(full(node.transform) ? { transform: node.transform } : {}),
        ...(full(node.params) ? { params: node.params } : {}),
        ...(node.children.length > 0
            ? { children: node.children.map((child) => printNode(document, child)) }
            : {}),
    };
}

export function printResource(
    document: SceneDocument,
    list: ListName,
    resource: Resource,
): JsonObject {
    const row = LISTS[list];
    if (list === "models") {
        return modelJson(resource.values, printNode(document, resource.root));
    }
    return {
        ...(row.id ? { id: resource.name } : {}),
        ...(row.type === null ? {} : { [row.type]: resource.type }),
        ...(row.values === null ? resource.values : { [row.values]: resource.values }),
    };
}

function printList(document: SceneDocument, list: ListName): Json {
    const items = document[list].map((item) => printResource(document, list, item));
    return LISTS[list].id
        ? items
        : Object.fromEntries(items.map((item, i) => [document[list][i]?.name, item]));
}

/* Lists that hold nothing are left out. */
export function printDocument(document: SceneDocument): JsonObject {
    const full = LIST_NAMES.filter((list) => document[list].length > 0);
    return {
        format: "fieldcast/1",
        ...document.info,
        camera: document.camera,
        ...Object.fromEntries(full.map((list) => [list, printList(document, list)])),
        environment: document.environment,
        render: document.render,
        root: printNode(document, document.root),
    };
}
