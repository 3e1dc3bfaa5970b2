/* SPDX-License-Identifier: MIT */
/* A scene as one text: printed as the server prints it, and which part of the text says what. */
import {
    findResource,
    nodeParams,
    type Resource,
    resourceParams,
    type SceneDocument,
} from "./document.ts";
import { modelJson } from "./documentJson.ts";
import { isObject, type Json, type JsonObject, textOf } from "./json.ts";
import { type Located, printText, type Span } from "./jsonText.ts";
import { LISTS, type ListName, resourcePlace, valuesPlace } from "./places.ts";
import type { Param, Schema, Values } from "./schema.ts";

/* The order in a document: protocol/resource.c. */
const PRINTED: readonly ListName[] = [
    "lights",
    "volumes",
    "primitives",
    "shaders",
    "materials",
    "models",
];

/* --- printing --- */

/* In the order of the rows; what has no row comes last. */
function inOrder(params: readonly Param[], values: Values): JsonObject {
    const known = params.filter(({ name }) => values[name] !== undefined);
    const ordered = Object.fromEntries(known.map(({ name }) => [name, values[name]]));
    return { ...ordered, ...values } as JsonObject;
}

/* Left out where nothing is set. */
function member(name: string, values: JsonObject): JsonObject {
    return Object.keys(values).length > 0 ? { [name]: values } : {};
}

/* The JSON of a node, with those of its children that `wanted` takes. */
export function nodeJson(
    schema: Schema,
    document: SceneDocument,
    id: string,
    wanted: (child: string) => boolean = () => true,
): JsonObject {
    const node = document.nodes.get(id);
    if (!node) {
        throw new Error(`no node ${id}`);
    }
    const children = node.children
        .filter(wanted)
        .map((child) => nodeJson(schema, document, child, wanted));
    return {
        id,
        type: node.type,
        ...inOrder(schema.node, node.common),
        ...member("transform", inOrder(schema.transform, node.transform)),
        ...member("params", inOrder(nodeParams(schema, document, node), node.params)),
        ...(children.length > 0 ? { children } : {}),
    };
}

export function resourceJson(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    resource: Resource,
): JsonObject {
    const row = LISTS[list];
    if (list === "models") {
        return modelJson(resource.values, nodeJson(schema, document, resource.root));
    }
    const params = resourceParams(schema, document, list, resource.type);
    const values = inOrder(params, resource.values);
    return {
        ...(row.id ? { id: resource.name } : {}),
        ...(row.type === null ? {} : { [row.type]: resource.type }),
        ...(row.values === null ? values : member(row.values, values)),
    };
}

export function documentJson(schema: Schema, document: SceneDocument): JsonObject {
    const lists = PRINTED.filter((list) => document[list].length > 0).map((list) => {
        const items = document[list].map((one) => [
            one.name,
            resourceJson(schema, document, list, one),
        ]);
        const json = LISTS[list].id ? items.map(([, item]) => item) : Object.fromEntries(items);
        return [list, json as Json];
    });
    return {
        format: "fieldcast/1",
        ...(document.info as JsonObject),
        ...member("camera", inOrder(schema.camera, document.camera)),
        ...Object.fromEntries(lists),
        ...member("environment", inOrder(schema.environment, document.environment)),
        ...member("render", inOrder(schema.render, document.render)),
        root: nodeJson(schema, document, document.root),
    };
}

export function documentText(schema: Schema, document: SceneDocument): string {
    return printText(documentJson(schema, document));
}

/* --- which part says what --- */

export interface Part extends Span {
    /* As edits and errors name it: /nodes/ball, /nodes/ball/params/radius, /materials/clay. */
    readonly place: string;
    /* The name of it; null: an item of a list. */
    readonly key: Span | null;
}

class Outline {
    readonly parts: Part[] = [];
    readonly #idOf: (item: Located) => string;

    constructor(idOf: (item: Located) => string) {
        this.#idOf = idOf;
    }

    #add(place: string, { from, to }: Span, key: Span | null): void {
        this.parts.push({ place, from, to, key });
    }

    #members(base: string, item: Located | undefined, but = ""): void {
        for (const [name, { key, value }] of item?.members ?? []) {
            if (name !== but) {
                this.#add(`${base}/${name}`, value, key);
            }
        }
    }

    node(item: Located, key: Span | null): void {
        const place = `/nodes/${this.#idOf(item)}`;
        this.#add(place, item, key);
        this.#members(place, item, "children");
        for (const group of ["transform", "params"]) {
            this.#members(`${place}/${group}`, item.members.get(group)?.value);
        }
        for (const child of item.members.get("children")?.value.items ?? []) {
            this.node(child, null);
        }
    }

    #resource(list: ListName, name: string, item: Located, key: Span | null): void {
        const place = resourcePlace(list, name);
        const { values } = LISTS[list];
        this.#add(place, item, key);
        const root = list === "models" ? item.members.get("root") : undefined;
        if (list === "models" && root === undefined) {
            this.node(item, key);
            return;
        }
        this.#members(place, item, root ? "root" : "");
        if (root) {
            this.node(root.value, root.key);
        }
        if (values !== null) {
            this.#members(valuesPlace(list, name), item.members.get(values)?.value);
        }
    }

    member(name: string, value: Located, key: Span): void {
        if (name === "root") {
            this.node(value, key);
            return;
        }
        this.#add(`/${name}`, value, key);
        if (!(name in LISTS)) {
            this.#members(`/${name}`, value);
            return;
        }
        const list = name as ListName;
        for (const item of value.items) {
            this.#resource(list, this.#idOf(item), item, null);
        }
        for (const [own, inner] of value.members) {
            this.#resource(list, own, inner.value, inner.key);
        }
    }
}

/* Parts in the order of the text, the outer one before what is in it. `idOf` names nodes, lights
 * and volumes, also those that have no id of their own yet. */
export function partsOf(whole: Located, idOf: (item: Located) => string = ownId): readonly Part[] {
    const outline = new Outline(idOf);
    for (const [name, { key, value }] of whole.members) {
        outline.member(name, value, key);
    }
    return outline.parts;
}

function ownId(item: Located): string {
    return isObject(item.json) ? textOf(item.json.id) : "";
}

/* The part that a place lies in: itself, else what it would stand in. */
export function partAt(parts: readonly Part[], place: string): Part | null {
    for (let path = place; path !== ""; path = path.slice(0, path.lastIndexOf("/"))) {
        const found = parts.find((part) => part.place === path);
        if (found) {
            return found;
        }
    }
    return null;
}

/* The innermost node, resource or record at a character: what the inspector can show. */
export function subjectAt(
    document: SceneDocument,
    parts: readonly Part[],
    offset: number,
): string | null {
    let found: string | null = null;
    for (const { place, from, to, key } of parts) {
        const inside = (key?.from ?? from) <= offset && offset <= to;
        if (inside && isSubject(document, place)) {
            found = place;
        }
    }
    return found;
}

function isSubject(document: SceneDocument, place: string): boolean {
    const [, first = "", name = "", ...rest] = place.split("/");
    if (first === "nodes") {
        return rest.length === 0 && document.nodes.has(name);
    }
    if (["camera", "environment", "render"].includes(first)) {
        return name === "";
    }
    return (
        first in LISTS &&
        first !== "models" &&
        rest.length === 0 &&
        findResource(document, first as ListName, name) !== null
    );
}
