/* SPDX-License-Identifier: MIT */
/* Edits: apply and inverse of set, insert, remove and move, as protocol/README.md states them.
 * Pure: documents share what did not change. Ranges are the schema's matter (checkValue). */
import {
    findResource,
    ID_PATTERN,
    isInside,
    type ListName,
    materialUsers,
    type Place,
    parsePlace,
    preorder,
    printNode,
    printResource,
    type Resource,
    readLight,
    readMaterial,
    readNode,
    resourceType,
    type SceneDocument,
    type SceneNode,
    siblingAfter,
} from "./document.ts";
import { isObject, type Json, type JsonObject } from "./json.ts";
import {
    checkValue,
    findParam,
    nodeType,
    type Param,
    type Schema,
    type Value,
    type Values,
} from "./schema.ts";

export type Operation =
    | { readonly op: "set"; readonly at: string; readonly value: Json }
    | {
          readonly op: "insert";
          readonly into: string;
          readonly before: string | null;
          readonly value: JsonObject;
          readonly name?: string;
      }
    | { readonly op: "remove"; readonly at: string }
    | {
          readonly op: "move";
          readonly at: string;
          readonly into: string;
          readonly before: string | null;
      };

export interface Problem {
    readonly code: string;
    readonly place: string;
    readonly message: string;
}

export type Applied =
    | {
          readonly ok: true;
          readonly document: SceneDocument;
          readonly inverse: readonly Operation[];
      }
    | { readonly ok: false; readonly problem: Problem };

class Refusal extends Error {
    readonly problem: Problem;
    constructor(code: string, place: string, message: string) {
        super(message);
        this.problem = { code, place, message };
    }
}

/* A document under change: each part is copied when it is first touched. */
class Draft {
    document: SceneDocument;
    readonly schema: Schema;
    readonly #owned: Map<string, SceneNode>;

    constructor(document: SceneDocument, schema: Schema) {
        this.#owned = new Map(document.nodes);
        this.document = { ...document, nodes: this.#owned };
        this.schema = schema;
    }

    node(id: string, place: string): SceneNode {
        const node = this.#owned.get(id);
        if (!node) {
            throw new Refusal("not_found", place, `there is no node ${id}`);
        }
        return node;
    }

    resource(list: ListName, name: string, place: string): Resource {
        const resource = findResource(this.document, list, name);
        if (!resource) {
            throw new Refusal("not_found", place, `there is no ${list.slice(0, -1)} ${name}`);
        }
        return resource;
    }

    change(id: string, part: Partial<SceneNode>): void {
        this.#owned.set(id, { ...this.node(id, ""), ...part });
    }

    add(json: JsonObject, parent: string): string {
        return readNode(json, parent, this.#owned);
    }

    drop(id: string): void {
        for (const inner of preorder(this.document, id)) {
            this.#owned.delete(inner);
        }
    }

    setList(list: ListName, resources: readonly Resource[]): void {
        this.document = { ...this.document, [list]: resources };
    }

    changeResource(list: ListName, name: string, part: Partial<Resource>): void {
        this.setList(
            list,
            this.document[list].map((item) => (item.name === name ? { ...item, ...part } : item)),
        );
    }
}

/* --- set --- */

function withValue(values: Values, name: string, json: Json): Values {
    if (json === null) {
        const { [name]: _gone, ...rest } = values;
        return rest;
    }
    return { ...values, [name]: json as Value };
}

function wholeValues(json: Json, place: string): Values {
    if (json !== null && !isObject(json)) {
        throw new Refusal("invalid", place, "an object is expected");
    }
    const entries = Object.entries(json ?? {}).filter(([, value]) => value != null);
    return Object.fromEntries(entries) as Values;
}

/* What of `values` a new row knows and accepts; the rest as operations that bring it back. */
function keepKnown(
    values: Values,
    params: readonly Param[],
    placeOf: (name: string) => string,
): { kept: Values; restore: Operation[] } {
    const kept: Record<string, Value> = {};
    const restore: Operation[] = [];
    for (const [name, value] of Object.entries(values)) {
        const param = findParam(params, name);
        if (param && checkValue(param, value) === null) {
            kept[name] = value;
        } else {
            restore.push({ op: "set", at: placeOf(name), value });
        }
    }
    return { kept, restore };
}

function typeName(value: Json, place: string): string {
    if (typeof value !== "string") {
        throw new Refusal("invalid", place, "the name of a type is expected");
    }
    return value;
}

function setNodeType(draft: Draft, id: string, at: string, value: Json): Operation[] {
    const node = draft.node(id, at);
    const type = typeName(value, at);
    const row = nodeType(draft.schema, type);
    if (!row) {
        throw new Refusal("invalid", at, `there is no node type ${type}`);
    }
    const { kept, restore } = keepKnown(
        node.params,
        row.params,
        (name) => `/nodes/${id}/params/${name}`,
    );
    draft.change(id, { type, params: kept });
    return [{ op: "set", at, value: node.type }, ...restore];
}

function setResourceType(
    draft: Draft,
    place: Extract<Place, { kind: "resource-type" }>,
    at: string,
    value: Json,
): Operation[] {
    const { list, resource: name } = place;
    const resource = draft.resource(list, name, at);
    const type = typeName(value, at);
    const row = resourceType(draft.schema, list, type);
    if (!row) {
        throw new Refusal("invalid", at, `there is no type ${type}`);
    }
    const prefix = list === "lights" ? `/lights/${name}` : `/materials/${name}/properties`;
    const { kept, restore } = keepKnown(resource.values, row.params, (p) => `${prefix}/${p}`);
    draft.changeResource(list, name, { type, values: kept });
    return [{ op: "set", at, value: resource.type }, ...restore];
}

function setNodeValue(
    draft: Draft,
    place: Extract<Place, { kind: "node-value" }>,
    at: string,
    value: Json,
): Operation[] {
    const node = draft.node(place.id, at);
    const params =
        place.group === "common" ? draft.schema.node : nodeType(draft.schema, node.type)?.params;
    if (!findParam(params ?? [], place.name)) {
        throw new Refusal("not_found", at, `${node.type} has no ${place.name}`);
    }
    if (place.group === "common" && place.name === "material" && value) {
        draft.resource("materials", String(value), at);
    }
    const old = node[place.group];
    draft.change(place.id, { [place.group]: withValue(old, place.name, value) });
    return [{ op: "set", at, value: old[place.name] ?? null }];
}

function setTransform(
    draft: Draft,
    place: Extract<Place, { kind: "transform" }>,
    at: string,
    value: Json,
): Operation[] {
    const old = draft.node(place.id, at).transform;
    const transform =
        place.name === null ? wholeValues(value, at) : withValue(old, place.name, value);
    draft.change(place.id, { transform });
    return [{ op: "set", at, value: place.name === null ? { ...old } : (old[place.name] ?? null) }];
}

function set(draft: Draft, at: string, value: Json): Operation[] {
    const place = parsePlace(at);
    const { document } = draft;
    switch (place?.kind) {
        case "info":
            draft.document = { ...document, info: withValue(document.info, place.name, value) };
            return [{ op: "set", at, value: document.info[place.name] ?? null }];
        case "record": {
            const old = document[place.record];
            const record =
                place.name === null ? wholeValues(value, at) : withValue(old, place.name, value);
            draft.document = { ...document, [place.record]: record };
            const before = place.name === null ? { ...old } : (old[place.name] ?? null);
            return [{ op: "set", at, value: before }];
        }
        case "node-type":
            return setNodeType(draft, place.id, at, value);
        case "node-value":
            return setNodeValue(draft, place, at, value);
        case "transform":
            return setTransform(draft, place, at, value);
        case "resource-type":
            return setResourceType(draft, place, at, value);
        case "resource-value": {
            const { values } = draft.resource(place.list, place.resource, at);
            draft.changeResource(place.list, place.resource, {
                values: withValue(values, place.name, value),
            });
            return [{ op: "set", at, value: values[place.name] ?? null }];
        }
        default:
            throw new Refusal("not_found", at, "nothing can be set here");
    }
}

/* --- insert, remove, move --- */

/* `items` with `item` in front of `before`; null: last. */
function placed<T>(
    items: readonly T[],
    item: T,
    before: string | null,
    nameOf: (item: T) => string,
    place: string,
): T[] {
    if (before === null) {
        return [...items, item];
    }
    const index = items.findIndex((other) => nameOf(other) === before);
    if (index < 0) {
        throw new Refusal("not_found", place, `there is no ${before} to stand in front of`);
    }
    return [...items.slice(0, index), item, ...items.slice(index)];
}

const itself = (id: string): string => id;
const nameOf = (resource: Resource): string => resource.name;

function checkNewNode(draft: Draft, json: JsonObject, place: string, seen: Set<string>): void {
    const type = typeof json.type === "string" ? json.type : "";
    if (!nodeType(draft.schema, type)) {
        throw new Refusal("invalid", place, `there is no node type ${type}`);
    }
    if (typeof json.id === "string") {
        if (!ID_PATTERN.test(json.id)) {
            throw new Refusal("invalid", place, `${json.id} is not an id`);
        }
        if (draft.document.nodes.has(json.id) || seen.has(json.id)) {
            throw new Refusal("conflict", place, `the id ${json.id} is in use`);
        }
        seen.add(json.id);
    }
    if (typeof json.material === "string" && json.material !== "") {
        draft.resource("materials", json.material, place);
    }
    for (const child of Array.isArray(json.children) ? json.children : []) {
        checkNewNode(draft, isObject(child) ? child : {}, place, seen);
    }
}

function insertNode(
    draft: Draft,
    parent: string,
    operation: Extract<Operation, { op: "insert" }>,
): Operation[] {
    const { into, before, value } = operation;
    const children = draft.node(parent, into).children;
    checkNewNode(draft, value, into, new Set());
    placed(children, "", before, itself, into);
    const id = draft.add(value, parent);
    draft.change(parent, { children: placed(children, id, before, itself, into) });
    return [{ op: "remove", at: `/nodes/${id}` }];
}

function insertResource(
    draft: Draft,
    list: ListName,
    operation: Extract<Operation, { op: "insert" }>,
): Operation[] {
    const { into, before, value } = operation;
    const resource =
        list === "lights" ? readLight(value) : readMaterial(operation.name ?? "", value);
    if (!ID_PATTERN.test(resource.name)) {
        throw new Refusal("invalid", into, `"${resource.name}" is not a name`);
    }
    if (findResource(draft.document, list, resource.name)) {
        throw new Refusal("conflict", into, `the name ${resource.name} is in use`);
    }
    if (!resourceType(draft.schema, list, resource.type)) {
        throw new Refusal("invalid", into, `there is no type ${resource.type}`);
    }
    draft.setList(list, placed(draft.document[list], resource, before, nameOf, into));
    return [{ op: "remove", at: `/${list}/${resource.name}` }];
}

function insert(draft: Draft, operation: Extract<Operation, { op: "insert" }>): Operation[] {
    const place = parsePlace(operation.into);
    if (place?.kind === "node") {
        return insertNode(draft, place.id, operation);
    }
    if (place?.kind === "list") {
        return insertResource(draft, place.list, operation);
    }
    throw new Refusal("not_found", operation.into, "nothing can be inserted here");
}

function removeNode(draft: Draft, id: string, at: string): Operation[] {
    const node = draft.node(id, at);
    if (node.parent === null) {
        throw new Refusal("conflict", at, "the root cannot be removed");
    }
    const value = printNode(draft.document, id);
    const before = siblingAfter(draft.document, id);
    const siblings = draft.node(node.parent, at).children;
    draft.drop(id);
    draft.change(node.parent, { children: siblings.filter((sibling) => sibling !== id) });
    return [{ op: "insert", into: `/nodes/${node.parent}`, before, value }];
}

function removeResource(draft: Draft, list: ListName, name: string, at: string): Operation[] {
    const resource = draft.resource(list, name, at);
    const users = list === "materials" ? materialUsers(draft.document, name) : [];
    if (users.length > 0) {
        throw new Refusal("conflict", at, `the material ${name} is used by ${users[0]}`);
    }
    const items = draft.document[list];
    const index = items.indexOf(resource);
    draft.setList(
        list,
        items.filter((item) => item !== resource),
    );
    return [
        {
            op: "insert",
            into: `/${list}`,
            before: items[index + 1]?.name ?? null,
            value: printResource(list, resource),
            ...(list === "materials" ? { name } : {}),
        },
    ];
}

function remove(draft: Draft, at: string): Operation[] {
    const place = parsePlace(at);
    if (place?.kind === "node") {
        return removeNode(draft, place.id, at);
    }
    if (place?.kind === "resource") {
        return removeResource(draft, place.list, place.resource, at);
    }
    throw new Refusal("not_found", at, "nothing can be removed here");
}

function moveNode(
    draft: Draft,
    id: string,
    parent: string,
    operation: Extract<Operation, { op: "move" }>,
): Operation[] {
    const { at, into, before } = operation;
    const node = draft.node(id, at);
    draft.node(parent, into);
    if (node.parent === null) {
        throw new Refusal("conflict", at, "the root cannot be moved");
    }
    if (isInside(draft.document, parent, id)) {
        throw new Refusal("conflict", at, `${id} cannot move into its own subtree`);
    }
    if (before === id) {
        throw new Refusal("conflict", at, "it cannot come before itself");
    }
    const back: Operation = {
        op: "move",
        at,
        into: `/nodes/${node.parent}`,
        before: siblingAfter(draft.document, id),
    };
    const without = (of: string) =>
        draft.node(of, into).children.filter((sibling) => sibling !== id);
    const target = placed(without(parent), id, before, itself, into);
    draft.change(node.parent, { children: without(node.parent) });
    draft.change(parent, { children: target });
    draft.change(id, { parent });
    return [back];
}

function move(draft: Draft, operation: Extract<Operation, { op: "move" }>): Operation[] {
    const { at, into, before } = operation;
    const place = parsePlace(at);
    const target = parsePlace(into);
    if (place?.kind === "node" && target?.kind === "node") {
        return moveNode(draft, place.id, target.id, operation);
    }
    if (place?.kind !== "resource" || target?.kind !== "list" || target.list !== place.list) {
        throw new Refusal("not_found", at, `this cannot be moved into ${into}`);
    }
    const items = draft.document[place.list];
    const resource = draft.resource(place.list, place.resource, at);
    const after = items[items.indexOf(resource) + 1]?.name ?? null;
    const others = items.filter((item) => item !== resource);
    draft.setList(place.list, placed(others, resource, before, nameOf, into));
    return [{ op: "move", at, into, before: after }];
}

function applyOne(draft: Draft, operation: Operation): Operation[] {
    switch (operation.op) {
        case "set":
            return set(draft, operation.at, operation.value);
        case "insert":
            return insert(draft, operation);
        case "remove":
            return remove(draft, operation.at);
        case "move":
            return move(draft, operation);
    }
}

/* Applies all operations or none. The inverse undoes them when applied to the result. */
export function apply(
    document: SceneDocument,
    operations: readonly Operation[],
    schema: Schema,
): Applied {
    const draft = new Draft(document, schema);
    const inverse: Operation[][] = [];
    try {
        for (const operation of operations) {
            inverse.unshift(applyOne(draft, operation));
        }
    } catch (error) {
        if (error instanceof Refusal) {
            return { ok: false, problem: error.problem };
        }
        throw error;
    }
    return { ok: true, document: draft.document, inverse: inverse.flat() };
}

/* --- joining --- */

/* A set whose effect is independent of other such sets: no type, no whole record. */
function isPlainSet(operation: Operation): operation is Extract<Operation, { op: "set" }> {
    if (operation.op !== "set") {
        return false;
    }
    const place = parsePlace(operation.at);
    return (
        place !== null &&
        place.kind !== "node-type" &&
        place.kind !== "resource-type" &&
        "name" in place &&
        place.name !== null
    );
}

/* One list that does what `first` and then `second` do: of several plain sets of one place only
 * the newest stays, so that a drag sends one value per frame. */
export function join(first: readonly Operation[], second: readonly Operation[]): Operation[] {
    const joined = [...first];
    for (const operation of second) {
        if (joined.every(isPlainSet) && isPlainSet(operation)) {
            const index = joined.findIndex((old) => old.op === "set" && old.at === operation.at);
            joined.splice(index < 0 ? joined.length : index, index < 0 ? 0 : 1, operation);
        } else {
            joined.push(operation);
        }
    }
    return joined;
}
