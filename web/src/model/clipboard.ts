/* SPDX-License-Identifier: MIT */
/* Nodes as text, with what they name, so that they can be pasted into another scene too. */
import { findResource, type SceneDocument } from "./document.ts";
import { printNode, printResource } from "./documentJson.ts";
import { copyInto, type Edit, freshIds, movable, renamed } from "./edits.ts";
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import type { Operation } from "./operation.ts";
import type { ListName } from "./places.ts";
import { placing } from "./placing.ts";
import { nodeType, type Param, type Schema } from "./schema.ts";
import { listNamedBy } from "./usage.ts";

interface Named {
    readonly list: ListName;
    readonly name: string;
}

/* What a node of either form names. */
function namesOf(schema: Schema, common: JsonObject, type: string, params: JsonObject): Named[] {
    const rows = [
        ...schema.node.map((param) => ({ param, value: common[param.name] })),
        ...(nodeType(schema, type)?.params ?? []).map((param) => ({
            param,
            value: params[param.name],
        })),
    ];
    return rows.flatMap(({ param, value }) => {
        const list = listNamedBy(param.type);
        return list !== null && typeof value === "string" && value !== ""
            ? [{ list, name: value }]
            : [];
    });
}

/* Resources that nodes need, given as JSON, each after those that it needs itself. */
export function needed(
    schema: Schema,
    document: SceneDocument,
    nodes: readonly JsonObject[],
): Named[] {
    const found = new Map<string, Named>();
    const seen = new Set<string>();
    const need = (named: Named): void => {
        const key = `/${named.list}/${named.name}`;
        const resource = findResource(document, named.list, named.name);
        if (seen.has(key) || resource === null) {
            return;
        }
        seen.add(key);
        if (named.list === "materials") {
            need({ list: "shaders", name: resource.type });
        }
        if (named.list === "models") {
            visit(printNode(document, resource.root));
        }
        found.set(key, named);
    };
    const visit = (node: JsonObject): void => {
        const params = isObject(node.params) ? node.params : {};
        for (const named of namesOf(schema, node, textOf(node.type), params)) {
            need(named);
        }
        for (const child of listOf(node.children).filter(isObject)) {
            visit(child);
        }
    };
    nodes.forEach(visit);
    return [...found.values()];
}

/* The JSON of a node with its subtree, or of a resource, with other names of what it names: by
 * "/LIST/NAME". */
export function withNames(
    schema: Schema,
    of: ListName | "root",
    json: JsonObject,
    names: ReadonlyMap<string, string>,
): JsonObject {
    if (of === "materials") {
        const shader = names.get(`/shaders/${textOf(json.shader)}`);
        return shader === undefined ? json : { ...json, shader };
    }
    return of === "models" || of === "root" ? nodeWithNames(schema, json, names) : json;
}

function nodeWithNames(
    schema: Schema,
    node: JsonObject,
    names: ReadonlyMap<string, string>,
): JsonObject {
    const put = (rows: readonly Param[], values: JsonObject): JsonObject => {
        const changed = rows.flatMap(({ name, type }) => {
            const list = listNamedBy(type);
            const own = list && names.get(`/${list}/${textOf(values[name])}`);
            return own == null ? [] : [[name, own]];
        });
        return { ...values, ...Object.fromEntries(changed) };
    };
    const rows = nodeType(schema, textOf(node.type))?.params ?? [];
    const inner = listOf(node.children).filter(isObject);
    return {
        ...put(schema.node, node),
        ...(isObject(node.params) ? { params: put(rows, node.params) } : {}),
        ...(inner.length > 0
            ? { children: inner.map((child) => nodeWithNames(schema, child, names)) }
            : {}),
    };
}

/* What the clipboard holds: nodes as scene JSON, and the resources that they name. */
export function clip(schema: Schema, document: SceneDocument, ids: readonly string[]): string {
    const nodes = movable(document, ids).map((id) => printNode(document, id));
    const resources = needed(schema, document, nodes).flatMap(({ list, name }) => {
        const resource = findResource(document, list, name);
        return resource ? [{ list, name, value: printResource(document, list, resource) }] : [];
    });
    return JSON.stringify({ format: "fieldcast/1", nodes, resources }, null, 1);
}

function readClip(text: string): { nodes: JsonObject[]; resources: JsonObject[] } | null {
    try {
        const json = JSON.parse(text) as Json;
        const nodes = isObject(json) ? listOf(json.nodes).filter(isObject) : [];
        const resources = isObject(json) ? listOf(json.resources).filter(isObject) : [];
        return nodes.length > 0 ? { nodes, resources } : null;
    } catch {
        return null;
    }
}

/* Nodes from the clipboard. Resources that this scene has under the same name are its own; others
 * come along, and what names anything else loses the name. Null: there is no node in it. */
export function paste(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    text: string,
): Edit | null {
    const content = readClip(text);
    if (content === null) {
        return null;
    }
    const fresh = freshIds(document);
    const known = new Set<string>();
    const inserts = content.resources.flatMap((json): Operation[] => {
        const list = textOf(json.list) as ListName;
        const name = textOf(json.name);
        if (!isObject(json.value) || (document[list] ?? []).some((one) => one.name === name)) {
            return [];
        }
        known.add(`/${list}/${name}`);
        const value = list === "models" ? renamed(json.value, fresh) : json.value;
        return [{ op: "insert", into: `/${list}`, before: null, name, value }];
    });
    const holds = ({ list, name }: Named): boolean =>
        known.has(`/${list}/${name}`) || findResource(document, list, name) !== null;
    const { ops, spot } = placing(document, schema, selection, null, "union");
    const fitting = content.nodes.map((node) => withoutStrangers(schema, node, holds));
    const copies = copyInto(document, fitting, () => spot, fresh);
    return {
        ops: [...inserts, ...ops, ...copies.ops],
        select: copies.select,
        label: copies.select.length === 1 ? "paste" : `paste ${fitting.length} nodes`,
    };
}

/* A node without names of what is not there; a distance function that is missing takes the values
 * that it declared along. */
function withoutStrangers(
    schema: Schema,
    node: JsonObject,
    holds: (named: Named) => boolean,
): JsonObject {
    const params = isObject(node.params) ? node.params : {};
    const type = textOf(node.type);
    const strange = namesOf(schema, node, type, params).filter((named) => !holds(named));
    const gone = (list: ListName) => strange.some((named) => named.list === list);
    const { material, children, ...own } = node;
    const inner = listOf(children).filter(isObject);
    return {
        ...own,
        ...(gone("models") || gone("primitives") ? { params: {} } : {}),
        ...(material === undefined || gone("materials") ? {} : { material }),
        ...(inner.length > 0
            ? { children: inner.map((child) => withoutStrangers(schema, child, holds)) }
            : {}),
    };
}
