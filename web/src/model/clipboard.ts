/* SPDX-License-Identifier: MIT */
/* Nodes as text, with what they name, so that they can be pasted into another scene too. */
import { findResource, freeName, type SceneDocument } from "./document.ts";
import { printNode, printResource, readDocument } from "./documentJson.ts";
import { copyInto, type Edit, freshIds, movable, renamedModel } from "./edits.ts";
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import { adapted, adaptedResource, isSameResource, keyOf, needed, type Resolve } from "./naming.ts";
import type { Operation } from "./operation.ts";
import { LIST_NAMES, type ListName } from "./places.ts";
import { placing } from "./placing.ts";
import type { Schema } from "./schema.ts";

interface Content {
    readonly nodes: readonly JsonObject[];
    readonly resources: readonly JsonObject[];
    /* The scene that it is from; "": not told. */
    readonly scene: string;
}

/* Nodes as scene JSON, and the resources that they name. */
function contentOf(schema: Schema, document: SceneDocument, ids: readonly string[]): Content {
    const nodes = ids.map((id) => printNode(document, id));
    const resources = needed(schema, document, nodes).flatMap(({ list, name }) => {
        const resource = findResource(document, list, name);
        return resource ? [{ list, name, value: printResource(document, list, resource) }] : [];
    });
    return { nodes, resources, scene: "" };
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
        const value = adaptedResource(schema, list, json.value, resolve);
        const there = findResource(document, list, name);
        const kept =
            there !== null &&
            ((scene !== "" && scene === here) ||
                isSameResource(list, printResource(document, list, there), value));
        const now = there === null || kept ? name : freeName(document, list, name, taken);
        taken.add(now);
        names.set(keyOf({ list, name }), now);
        const inserted = list === "models" ? renamedModel(value, fresh) : value;
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
