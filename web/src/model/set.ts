/* SPDX-License-Identifier: MIT */
/* The operation `set`: single values, and types and declarations, which decide what values there
 * are. What a change of those takes away, its inverse brings back. */
import { knowsType, nodeParams, resourceParams } from "./document.ts";
import type { DocumentDraft } from "./documentDraft.ts";
import { isObject, type Json } from "./json.ts";
import { type Operation, Refusal } from "./operation.ts";
import { type Place, parsePlace, valuesPlace } from "./places.ts";
import { findParam, nodeType, type Param, type Value, type Values } from "./schema.ts";
import { usersOf } from "./usage.ts";
import { checkValue } from "./values.ts";

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

/* What of `values` new rows know and accept; the rest as operations that bring it back. */
function keepKnown(
    values: Values,
    params: readonly Param[],
    placeOf: (name: string) => string,
): { kept: Values; restore: Operation[] } {
    const kept: Record<string, Value> = {};
    const lost: Operation[] = [];
    for (const [name, value] of Object.entries(values)) {
        const param = findParam(params, name);
        if (param && checkValue(param, value) === null) {
            kept[name] = value;
        } else {
            lost.push({ op: "set", at: placeOf(name), value });
        }
    }
    return { kept, restore: lost };
}

function typeName(value: Json, place: string): string {
    if (typeof value !== "string") {
        throw new Refusal("invalid", place, "the name of a type is expected");
    }
    return value;
}

/* The values of a node that its rows, whatever they are by now, do not hold any more. */
function convertNode(draft: DocumentDraft, id: string): Operation[] {
    const node = draft.node(id, "");
    const params = nodeParams(draft.schema, draft.document, node);
    const { kept, restore } = keepKnown(node.params, params, (name) => paramPlace(id, name));
    if (restore.length > 0) {
        draft.change(id, { params: kept });
    }
    return restore;
}

function convertMaterial(draft: DocumentDraft, name: string): Operation[] {
    const material = draft.resource("materials", name, "");
    const params = resourceParams(draft.schema, draft.document, "materials", material.type);
    const base = valuesPlace("materials", name);
    const { kept, restore } = keepKnown(material.values, params, (param) => `${base}/${param}`);
    if (restore.length > 0) {
        draft.changeResource("materials", name, { values: kept });
    }
    return restore;
}

const paramPlace = (id: string, name: string): string => `/nodes/${id}/params/${name}`;

function setNodeType(draft: DocumentDraft, id: string, at: string, value: Json): Operation[] {
    const node = draft.node(id, at);
    const type = typeName(value, at);
    if (!nodeType(draft.schema, type)) {
        throw new Refusal("invalid", at, `there is no node type ${type}`);
    }
    /* What a distance function declares comes back after its name, also what the new type knows:
     * without the name the old type does not hold it. */
    const own = nodeType(draft.schema, node.type)?.params ?? [];
    const declared = Object.entries(node.params).filter(([name]) => !findParam(own, name));
    draft.change(id, { type });
    const lost = convertNode(draft, id).filter(
        (op) => "at" in op && own.some(({ name }) => op.at === paramPlace(id, name)),
    );
    const again = declared.map(([name, back]): Operation => {
        return { op: "set", at: paramPlace(id, name), value: back };
    });
    return [{ op: "set", at, value: node.type }, ...lost, ...again];
}

function setResourceType(
    draft: DocumentDraft,
    place: Extract<Place, { kind: "resource-type" }>,
    at: string,
    value: Json,
): Operation[] {
    const { list, resource: name } = place;
    const resource = draft.resource(list, name, at);
    const type = typeName(value, at);
    if (!knowsType(draft.schema, draft.document, list, type)) {
        throw new Refusal("invalid", at, `there is no type ${type}`);
    }
    const params = resourceParams(draft.schema, draft.document, list, type);
    const base = valuesPlace(list, name);
    const { kept, restore } = keepKnown(resource.values, params, (p) => `${base}/${p}`);
    draft.changeResource(list, name, { type, values: kept });
    return [{ op: "set", at, value: resource.type }, ...restore];
}

function setNodeValue(
    draft: DocumentDraft,
    place: Extract<Place, { kind: "node-value" }>,
    at: string,
    value: Json,
): Operation[] {
    const { id, group, name } = place;
    const node = draft.node(id, at);
    const params =
        group === "common" ? draft.schema.node : nodeParams(draft.schema, draft.document, node);
    const param = findParam(params, name);
    if (!param) {
        throw new Refusal("not_found", at, `${node.type} has no ${name}`);
    }
    draft.checkName(param, value, at);
    const old = node[group];
    draft.change(id, { [group]: withValue(old, name, value) });
    const back: Operation = { op: "set", at, value: (old[name] ?? null) as Json };
    if (param.type === "model") {
        draft.checkCycle(id, at);
    }
    return ["function", "model"].includes(param.type) ? [back, ...convertNode(draft, id)] : [back];
}

/* New rows of a distance function, a shader or a model: whoever uses it keeps what still fits. */
function setResourceValue(
    draft: DocumentDraft,
    place: Extract<Place, { kind: "resource-value" }>,
    at: string,
    value: Json,
): Operation[] {
    const { list, resource: name } = place;
    const { values, type } = draft.resource(list, name, at);
    const params = resourceParams(draft.schema, draft.document, list, type);
    const param = findParam(params, place.name);
    if (!param) {
        throw new Refusal("not_found", at, `${name} has no ${place.name}`);
    }
    const users = usersOf(draft.schema, draft.snapshot(), list, name);
    draft.changeResource(list, name, { values: withValue(values, place.name, value) });
    const back: Operation = { op: "set", at, value: (values[place.name] ?? null) as Json };
    if (param.type !== "rows") {
        return [back];
    }
    return [
        back,
        ...users.flatMap((user) =>
            user.kind === "node"
                ? convertNode(draft, user.name)
                : convertMaterial(draft, user.name),
        ),
    ];
}

function setTransform(
    draft: DocumentDraft,
    place: Extract<Place, { kind: "transform" }>,
    at: string,
    value: Json,
): Operation[] {
    const old = draft.node(place.id, at).transform;
    const transform =
        place.name === null ? wholeValues(value, at) : withValue(old, place.name, value);
    draft.change(place.id, { transform });
    return [
        {
            op: "set",
            at,
            value: place.name === null ? { ...old } : ((old[place.name] ?? null) as Json),
        },
    ];
}

/* Applies one set; answers what undoes it. */
export function set(draft: DocumentDraft, at: string, value: Json): Operation[] {
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
            const before = place.name === null ? { ...old } : ((old[place.name] ?? null) as Json);
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
        case "resource-value":
            return setResourceValue(draft, place, at, value);
        default:
            throw new Refusal("not_found", at, "nothing can be set here");
    }
}
