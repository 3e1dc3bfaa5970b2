/* SPDX-License-Identifier: MIT */
/* The operations `insert`, `remove` and `move`, of nodes and of resources. */
import { findResource, isInside, knowsType, type Resource, siblingAfter } from "./document.ts";
import type { DocumentDraft } from "./documentDraft.ts";
import { printNode, printResource, readResource, treeOf } from "./documentJson.ts";
import { isObject, type JsonObject } from "./json.ts";
import { type Operation, Refusal } from "./operation.ts";
import { ID_PATTERN, LISTS, type ListName, parsePlace, resourcePlace } from "./places.ts";
import { nodeType, shaderType } from "./schema.ts";
import { whyNotRemoved } from "./usage.ts";

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

/* Refuses a node that is to come in. Values that are not of its rows are the server's matter. */
function checkNewNode(
    draft: DocumentDraft,
    json: JsonObject,
    place: string,
    seen: Set<string>,
): void {
    const type = typeof json.type === "string" ? json.type : "";
    const row = nodeType(draft.schema, type);
    if (!row) {
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
    for (const param of draft.schema.node) {
        draft.checkName(param, json[param.name], place);
    }
    for (const param of row.params) {
        const params = isObject(json.params) ? json.params : {};
        draft.checkName(param, params[param.name], place);
    }
    for (const child of Array.isArray(json.children) ? json.children : []) {
        checkNewNode(draft, isObject(child) ? child : {}, place, seen);
    }
}

function insertNode(
    draft: DocumentDraft,
    parent: string,
    operation: Extract<Operation, { op: "insert" }>,
): Operation[] {
    const { into, before, value } = operation;
    const children = draft.node(parent, into).children;
    checkNewNode(draft, value, into, new Set());
    placed(children, "", before, itself, into);
    const id = draft.add(value, parent);
    draft.change(parent, { children: placed(children, id, before, itself, into) });
    draft.checkCycle(id, into);
    return [{ op: "remove", at: `/nodes/${id}` }];
}

/* Refuses a name that a list cannot take. */
function checkNewName(draft: DocumentDraft, list: ListName, name: string, place: string): void {
    if (!ID_PATTERN.test(name)) {
        throw new Refusal("invalid", place, `"${name}" is not a name`);
    }
    if (findResource(draft.document, list, name)) {
        throw new Refusal("conflict", place, `the name ${name} is in use`);
    }
    if (list === "shaders" && shaderType(draft.schema, name)) {
        throw new Refusal("conflict", place, `the shader ${name} is built in`);
    }
}

function insertResource(
    draft: DocumentDraft,
    list: ListName,
    operation: Extract<Operation, { op: "insert" }>,
): Operation[] {
    const { into, before, value } = operation;
    const read = readResource(list, operation.name ?? "", value);
    checkNewName(draft, list, read.name, into);
    if (!knowsType(draft.schema, draft.document, list, read.type)) {
        throw new Refusal("invalid", into, `there is no type ${read.type}`);
    }
    if (list === "models") {
        checkNewNode(draft, treeOf(value), into, new Set());
    }
    placed(draft.document[list], read, before, nameOf, into);
    const resource = list === "models" ? draft.addModel(read.name, value) : read;
    draft.setList(list, placed(draft.document[list], resource, before, nameOf, into));
    return [{ op: "remove", at: resourcePlace(list, read.name) }];
}

export function insert(
    draft: DocumentDraft,
    operation: Extract<Operation, { op: "insert" }>,
): Operation[] {
    const place = parsePlace(operation.into);
    if (place?.kind === "node") {
        return insertNode(draft, place.id, operation);
    }
    if (place?.kind === "list") {
        return insertResource(draft, place.list, operation);
    }
    throw new Refusal("not_found", operation.into, "nothing can be inserted here");
}

function removeNode(draft: DocumentDraft, id: string, at: string): Operation[] {
    const node = draft.node(id, at);
    if (node.parent === null) {
        throw new Refusal("conflict", at, "a root cannot be removed");
    }
    const value = printNode(draft.document, id);
    const before = siblingAfter(draft.document, id);
    const siblings = draft.node(node.parent, at).children;
    draft.drop(id);
    draft.change(node.parent, { children: siblings.filter((sibling) => sibling !== id) });
    return [{ op: "insert", into: `/nodes/${node.parent}`, before, value }];
}

function removeResource(
    draft: DocumentDraft,
    list: ListName,
    name: string,
    at: string,
): Operation[] {
    const resource = draft.resource(list, name, at);
    const used = whyNotRemoved(draft.schema, draft.snapshot(), list, name);
    if (used !== null) {
        throw new Refusal("conflict", at, used);
    }
    const value = printResource(draft.document, list, resource);
    if (list === "models") {
        draft.drop(resource.root);
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
            value,
            ...(LISTS[list].id ? {} : { name }),
        },
    ];
}

export function remove(draft: DocumentDraft, at: string): Operation[] {
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
    draft: DocumentDraft,
    id: string,
    parent: string,
    operation: Extract<Operation, { op: "move" }>,
): Operation[] {
    const { at, into, before } = operation;
    const node = draft.node(id, at);
    draft.node(parent, into);
    if (node.parent === null) {
        throw new Refusal("conflict", at, "a root cannot be moved");
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
    draft.checkCycle(id, into);
    return [back];
}

export function move(
    draft: DocumentDraft,
    operation: Extract<Operation, { op: "move" }>,
): Operation[] {
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
