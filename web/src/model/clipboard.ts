/* SPDX-License-Identifier: MIT */
/* Nodes as text, with what they name, so that they can be pasted into another scene too. */
import { findResource, freeName, type SceneDocument, type SceneNode } from "./document.ts";
import { printNode, printResource, readDocument } from "./documentJson.ts";
import { copyInto, type Edit, freshIds, movable, renamed } from "./edits.ts";
import { equalJson, isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import type { Operation } from "./operation.ts";
import { LIST_NAMES, type ListName } from "./places.ts";
import { placing } from "./placing.ts";
import { nodeType, type Schema } from "./schema.ts";
import { listNamedBy } from "./usage.ts";

interface Named {
    readonly list: ListName;
    readonly name: string;
}

/* Where a node names something. */
interface Naming extends Named {
    readonly group: "common" | "params";
    readonly param: string;
}

const keyOf = ({ list, name }: Named): string => `/${list}/${name}`;

/* What a node of either form names. */
function namesOf(schema: Schema, common: JsonObject, type: string, params: JsonObject): Naming[] {
    const rows = [
        ...schema.node.map((param) => ({ group: "common" as const, param, values: common })),
        ...(nodeType(schema, type)?.params ?? []).map((param) => ({
            group: "params" as const,
            param,
            values: params,
        })),
    ];
    return rows.flatMap(({ group, param, values }) => {
        const list = listNamedBy(param.type);
        const value = values[param.name];
        return list !== null && typeof value === "string" && value !== ""
            ? [{ list, name: value, group, param: param.name }]
            : [];
    });
}

/* Resources that nodes need, each after those that it needs itself. */
function needed(schema: Schema, document: SceneDocument, ids: readonly string[]): Named[] {
    const found = new Map<string, Named>();
    const seen = new Set<string>();
    const need = (named: Named): void => {
        const key = keyOf(named);
        const resource = findResource(document, named.list, named.name);
        if (seen.has(key) || resource === null) {
            return;
        }
        seen.add(key);
        if (named.list === "materials") {
            need({ list: "shaders", name: resource.type });
        }
        visit(document.nodes.get(resource.root));
        found.set(key, named);
    };
    const visit = (node: SceneNode | undefined): void => {
        if (node) {
            for (const named of namesOf(schema, node.common, node.type, node.params)) {
                need(named);
            }
            for (const child of node.children) {
                visit(document.nodes.get(child));
            }
        }
    };
    for (const id of ids) {
        visit(document.nodes.get(id));
    }
    return [...found.values()];
}

interface Content {
    readonly nodes: readonly JsonObject[];
    readonly resources: readonly JsonObject[];
    /* The scene that it is from; "": not told. */
    readonly scene: string;
}

/* Nodes as scene JSON, and the resources that they name. */
function contentOf(schema: Schema, document: SceneDocument, ids: readonly string[]): Content {
    const resources = needed(schema, document, ids).flatMap(({ list, name }) => {
        const resource = findResource(document, list, name);
        return resource ? [{ list, name, value: printResource(document, list, resource) }] : [];
    });
    return { nodes: ids.map((id) => printNode(document, id)), resources, scene: "" };
}

/* What the clipboard holds. `scene`: the id of the one that it is from. */
export function clip(
    schema: Schema,
    document: SceneDocument,
    ids: readonly string[],
    scene = "",
): string {
    const content = contentOf(schema, document, movable(document, ids));
    return JSON.stringify({ format: "fieldcast/1", ...content, scene }, null, 1);
}

/* Of a whole scene its root, named as the scene is. */
function contentOfScene(schema: Schema, json: JsonObject): Content {
    const document = readDocument(json);
    const { nodes, ...content } = contentOf(schema, document, [document.root]);
    const name = textOf(json.name);
    const named = (node: JsonObject) => (name !== "" && !node.name ? { ...node, name } : node);
    return { ...content, nodes: nodes.map(named) };
}

function readClip(schema: Schema, text: string): Content | null {
    try {
        const json = JSON.parse(text) as Json;
        if (!isObject(json)) {
            return null;
        }
        if (isObject(json.root)) {
            return contentOfScene(schema, json);
        }
        const nodes = listOf(json.nodes).filter(isObject);
        const resources = listOf(json.resources).filter(isObject);
        return nodes.length > 0 ? { nodes, resources, scene: textOf(json.scene) } : null;
    } catch {
        return null;
    }
}

/* --- names in the other scene --- */

/* Names there by those in the clipboard; null: nothing of that name will be there. */
type Resolve = (named: Named) => string | null;

/* A node with the names that hold there; a distance function or model that is missing takes the
 * values that go with it along. */
function adapted(schema: Schema, node: JsonObject, resolve: Resolve): JsonObject {
    const params = isObject(node.params) ? node.params : {};
    const names = namesOf(schema, node, textOf(node.type), params);
    const strange = names.some((named) => named.group === "params" && resolve(named) === null);
    const own = { ...node };
    const values = { ...params };
    for (const named of names) {
        const name = resolve(named);
        const group = named.group === "common" ? own : values;
        if (name === null) {
            delete group[named.param];
        } else {
            group[named.param] = name;
        }
    }
    const { params: _params, children, ...rest } = own;
    const inner = listOf(children).filter(isObject);
    return {
        ...rest,
        ...(node.params === undefined ? {} : { params: strange ? {} : values }),
        ...(inner.length > 0
            ? { children: inner.map((child) => adapted(schema, child, resolve)) }
            : {}),
    };
}

/* Without ids, by which models differ that are the same. */
function anonymous(json: JsonObject): JsonObject {
    const { id: _id, children, ...own } = json;
    const inner = listOf(children).filter(isObject);
    return { ...own, ...(inner.length > 0 ? { children: inner.map(anonymous) } : {}) };
}

function isSame(document: SceneDocument, list: ListName, name: string, value: JsonObject): boolean {
    const resource = findResource(document, list, name);
    const own = resource && printResource(document, list, resource);
    return own !== null && list === "models"
        ? equalJson(anonymous(own), anonymous(value))
        : equalJson(own ?? undefined, value);
}

/* Resources to insert, and the names that all of them have then. What is there already, the same
 * under the same name, is used; what differs comes under a new name. In the scene that the text is
 * from, names stay. */
function incoming(
    document: SceneDocument,
    schema: Schema,
    { resources, scene }: Content,
    here: string,
    fresh: (stem: string) => string,
): { ops: Operation[]; resolve: Resolve } {
    const names = new Map<string, string>();
    const taken = new Set(resources.map((json) => textOf(json.name)));
    const resolve: Resolve = (named) =>
        names.get(keyOf(named)) ??
        (findResource(document, named.list, named.name) === null ? null : named.name);
    const ops = resources.flatMap((json): Operation[] => {
        const list = textOf(json.list) as ListName;
        const name = textOf(json.name);
        if (!isObject(json.value) || !LIST_NAMES.includes(list)) {
            return [];
        }
        const shader = names.get(`/shaders/${textOf(json.value.shader)}`);
        const value =
            list === "models"
                ? adapted(schema, json.value, resolve)
                : { ...json.value, ...(shader === undefined ? {} : { shader }) };
        const there = findResource(document, list, name) !== null;
        const kept =
            there && ((scene !== "" && scene === here) || isSame(document, list, name, value));
        const now = !there || kept ? name : freeName(document, list, name, taken);
        taken.add(now);
        names.set(keyOf({ list, name }), now);
        const inserted = list === "models" ? renamed(value, fresh) : value;
        return kept
            ? []
            : [{ op: "insert", into: `/${list}`, before: null, name: now, value: inserted }];
    });
    return { ops, resolve };
}

/* Nodes from the clipboard, or the root of a whole scene, with what they name. `here`: the id of
 * this scene. Null: there is no node in it. */
export function paste(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    text: string,
    here = "",
): Edit | null {
    const content = readClip(schema, text);
    if (content === null) {
        return null;
    }
    const fresh = freshIds(document);
    const { ops: inserts, resolve } = incoming(document, schema, content, here, fresh);
    const { ops, spot } = placing(document, schema, selection, null, "union");
    const fitting = content.nodes.map((node) => adapted(schema, node, resolve));
    const copies = copyInto(document, fitting, () => spot, fresh);
    return {
        ops: [...inserts, ...ops, ...copies.ops],
        select: copies.select,
        label: copies.select.length === 1 ? "paste" : `paste ${fitting.length} nodes`,
    };
}
