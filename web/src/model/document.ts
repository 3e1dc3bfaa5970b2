/* SPDX-License-Identifier: MIT */
/* A scene as the editor holds it: flat maps of nodes and resources, immutable, shared between
 * versions. Reading and printing of the document, walks, places and ids. */
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import type { Param, Schema, Value, Values } from "./schema.ts";
import { findParam, lightType, nodeType, shaderType } from "./schema.ts";

export interface SceneNode {
    readonly id: string;
    readonly type: string;
    readonly common: Values /* name, material, visible */;
    readonly transform: Values;
    readonly params: Values;
    readonly parent: string | null;
    readonly children: readonly string[];
}

/* A light or a material. `type` is a light's type, a material's shader. */
export interface Resource {
    readonly name: string;
    readonly type: string;
    readonly values: Values;
}

export interface SceneDocument {
    readonly info: Values /* name */;
    readonly camera: Values;
    readonly environment: Values;
    readonly render: Values;
    readonly lights: readonly Resource[];
    readonly materials: readonly Resource[];
    readonly nodes: ReadonlyMap<string, SceneNode>;
    readonly root: string;
}

export type ListName = "lights" | "materials";
export type RecordName = "camera" | "environment" | "render";

/* --- places --- */

/* What a path in an edit names. `name` null: the whole record. */
export type Place =
    | { kind: "info"; name: string }
    | { kind: "record"; record: RecordName; name: string | null }
    | { kind: "node"; id: string }
    | { kind: "node-type"; id: string }
    | { kind: "node-value"; id: string; group: "common" | "params"; name: string }
    | { kind: "transform"; id: string; name: string | null }
    | { kind: "resource"; list: ListName; resource: string }
    | { kind: "resource-type"; list: ListName; resource: string }
    | { kind: "resource-value"; list: ListName; resource: string; name: string }
    | { kind: "list"; list: ListName };

export const ID_PATTERN = /^[A-Za-z0-9_.-]{1,64}$/;

function parseNodePlace(id: string, rest: readonly string[]): Place | null {
    const [group, name] = rest;
    if (group === undefined) {
        return { kind: "node", id };
    }
    if (group === "transform" && rest.length <= 2) {
        return { kind: "transform", id, name: name ?? null };
    }
    if (group === "params" && rest.length === 2 && name) {
        return { kind: "node-value", id, group: "params", name };
    }
    if (rest.length !== 1) {
        return null;
    }
    return group === "type"
        ? { kind: "node-type", id }
        : { kind: "node-value", id, group: "common", name: group };
}

function parseResourcePlace(list: ListName, rest: readonly string[]): Place | null {
    const [resource, group, name] = rest;
    if (resource === undefined) {
        return { kind: "list", list };
    }
    if (group === undefined) {
        return { kind: "resource", list, resource };
    }
    if (list === "lights" && rest.length === 2) {
        return group === "type"
            ? { kind: "resource-type", list, resource }
            : { kind: "resource-value", list, resource, name: group };
    }
    if (list === "materials" && group === "shader" && rest.length === 2) {
        return { kind: "resource-type", list, resource };
    }
    if (list === "materials" && group === "properties" && rest.length === 3 && name) {
        return { kind: "resource-value", list, resource, name };
    }
    return null;
}

/* The parts of a path such as /nodes/body/params/radius; null where no edit could name it. */
export function parsePlace(path: string): Place | null {
    if (!path.startsWith("/")) {
        return null;
    }
    const [first, ...rest] = path.slice(1).split("/");
    if (rest.some((part) => part === "")) {
        return null;
    }
    switch (first) {
        case "name":
            return rest.length === 0 ? { kind: "info", name: "name" } : null;
        case "camera":
        case "environment":
        case "render":
            return rest.length <= 1
                ? { kind: "record", record: first, name: rest[0] ?? null }
                : null;
        case "nodes":
            return rest[0] === undefined ? null : parseNodePlace(rest[0], rest.slice(1));
        case "lights":
        case "materials":
            return parseResourcePlace(first, rest);
        default:
            return null;
    }
}

/* The node that a path lies in, or null: where an error is shown. */
export function nodeOfPlace(path: string): string | null {
    return /\/nodes\/([A-Za-z0-9_.-]{1,64})(\/|$)/.exec(path)?.[1] ?? null;
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
    const found = (params: readonly Param[] | undefined, values: Values | undefined) => {
        const param = findParam(params ?? [], place.name ?? "");
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
            return place.group === "common"
                ? found(schema.node, node?.common)
                : found(nodeType(schema, node?.type ?? "")?.params, node?.params);
        }
        case "resource-value": {
            const resource = findResource(document, place.list, place.resource);
            return found(
                resourceType(schema, place.list, resource?.type ?? "")?.params,
                resource?.values,
            );
        }
        default:
            return null;
    }
}

export function resourceType(schema: Schema, list: ListName, type: string) {
    return list === "lights" ? lightType(schema, type) : shaderType(schema, type);
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

export function materialUsers(document: SceneDocument, name: string): string[] {
    return [...document.nodes.values()]
        .filter((node) => node.common.material === name)
        .map((node) => node.id);
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

/* Those ids that have no ancestor among them, in document order. */
export function topmost(document: SceneDocument, ids: Iterable<string>): string[] {
    const chosen = new Set(ids);
    return preorder(document).filter((id) => {
        const path = pathTo(document, id);
        return chosen.has(id) && !path.slice(0, -1).some((node) => chosen.has(node.id));
    });
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

export function freeName(document: SceneDocument, list: ListName, stem: string): string {
    const base = stem.replace(/-\d+$/, "").slice(0, 56) || "item";
    for (let n = 1; ; n++) {
        if (findResource(document, list, `${base}-${n}`) === null) {
            return `${base}-${n}`;
        }
    }
}

/* --- reading and printing --- */

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

export function readLight(json: JsonObject): Resource {
    return {
        name: textOf(json.id),
        type: textOf(json.type),
        values: omit(json, ["id", "type"]),
    };
}

export function readMaterial(name: string, json: JsonObject): Resource {
    return { name, type: textOf(json.shader), values: readValues(json.properties) };
}

/* Reads a document that the server has checked. */
export function readDocument(json: Json): SceneDocument {
    const object = isObject(json) ? json : {};
    const nodes = new Map<string, SceneNode>();
    const root = readNode(isObject(object.root) ? object.root : { type: "union" }, null, nodes);
    const materials = isObject(object.materials) ? object.materials : {};
    return {
        info: pick(object, ["name"]),
        camera: readValues(object.camera),
        environment: readValues(object.environment),
        render: readValues(object.render),
        lights: listOf(object.lights).filter(isObject).map(readLight),
        materials: Object.entries(materials).map(([name, value]) =>
            readMaterial(name, isObject(value) ? value : {}),
        ),
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

export function printResource(list: ListName, resource: Resource): JsonObject {
    return list === "lights"
        ? { id: resource.name, type: resource.type, ...resource.values }
        : { shader: resource.type, properties: resource.values };
}

export function printDocument(document: SceneDocument): JsonObject {
    return {
        format: "fieldcast/1",
        ...document.info,
        camera: document.camera,
        lights: document.lights.map((light) => printResource("lights", light)),
        materials: Object.fromEntries(
            document.materials.map((material) => [
                material.name,
                printResource("materials", material),
            ]),
        ),
        environment: document.environment,
        render: document.render,
        root: printNode(document, document.root),
    };
}
