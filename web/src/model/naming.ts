/* SPDX-License-Identifier: MIT */
/* What nodes and resources name, as JSON, and the same with names that hold in another scene. */
import { findResource, type SceneDocument } from "./document.ts";
import { printNode, treeOf, withTree } from "./documentJson.ts";
import { renamedModel } from "./edits.ts";
import { equalJson, isObject, type JsonObject, listOf, textOf } from "./json.ts";
import type { ListName } from "./places.ts";
import { nodeType, type Schema } from "./schema.ts";
import { listNamedBy } from "./usage.ts";

export interface Named {
    readonly list: ListName;
    readonly name: string;
}

export const keyOf = ({ list, name }: Named): string => `/${list}/${name}`;

/* Where a node names something. */
interface Naming extends Named {
    readonly group: "common" | "params";
    readonly param: string;
}

const paramsOf = (node: JsonObject): JsonObject => (isObject(node.params) ? node.params : {});
const childrenOf = (node: JsonObject): JsonObject[] => listOf(node.children).filter(isObject);

function namesOf(schema: Schema, node: JsonObject): Naming[] {
    const params = paramsOf(node);
    const rows = [
        ...schema.node.map((param) => ({ group: "common" as const, param, values: node })),
        ...(nodeType(schema, textOf(node.type))?.params ?? []).map((param) => ({
            group: "params" as const,
            param,
            values: params,
        })),
    ];
    return rows.flatMap(({ group, param, values }) => {
        const list = listNamedBy(param.type);
        const name = textOf(values[param.name]);
        return list !== null && name !== "" ? [{ list, name, group, param: param.name }] : [];
    });
}

/* Resources that nodes need, each after those that it needs itself. */
export function needed(
    schema: Schema,
    document: SceneDocument,
    nodes: readonly JsonObject[],
): Named[] {
    const found = new Map<string, Named>();
    const seen = new Set<string>();
    const need = (named: Named): void => {
        const resource = findResource(document, named.list, named.name);
        if (seen.has(keyOf(named)) || resource === null) {
            return;
        }
        seen.add(keyOf(named));
        if (named.list === "materials") {
            need({ list: "shaders", name: resource.type });
        }
        if (named.list === "models") {
            visit(printNode(document, resource.root));
        }
        found.set(keyOf(named), { list: named.list, name: named.name });
    };
    const visit = (node: JsonObject): void => {
        namesOf(schema, node).forEach(need);
        childrenOf(node).forEach(visit);
    };
    nodes.forEach(visit);
    return [...found.values()];
}

/* The name that something has in the other scene; null: nothing of that name will be there. */
export type Resolve = (named: Named) => string | null;

/* A node with the names that hold there; a distance function or model that is missing takes the
 * values that go with it along. */
export function adapted(schema: Schema, node: JsonObject, resolve: Resolve): JsonObject {
    const names = namesOf(schema, node);
    const strange = names.some((named) => named.group === "params" && resolve(named) === null);
    const own = { ...node };
    const values = { ...paramsOf(node) };
    for (const named of names) {
        const name = resolve(named);
        const group = named.group === "common" ? own : values;
        if (name === null) {
            delete group[named.param];
        } else {
            group[named.param] = name;
        }
    }
    const { params: _params, children: _children, ...rest } = own;
    const inner = childrenOf(node);
    return {
        ...rest,
        ...(node.params === undefined ? {} : { params: strange ? {} : values }),
        ...(inner.length > 0
            ? { children: inner.map((child) => adapted(schema, child, resolve)) }
            : {}),
    };
}

export function adaptedResource(
    schema: Schema,
    list: ListName,
    json: JsonObject,
    resolve: Resolve,
): JsonObject {
    if (list === "models") {
        return withTree(json, adapted(schema, treeOf(json), resolve));
    }
    const shader = textOf(json.shader);
    const named = shader === "" ? null : resolve({ list: "shaders", name: shader });
    return list === "materials" && named !== null ? { ...json, shader: named } : json;
}

/* A model with ids that are the same for the same tree: those of nodes are new in each scene. */
function withPlainIds(model: JsonObject): JsonObject {
    let count = 0;
    return renamedModel(model, () => `${count++}`);
}

export function isSameResource(list: ListName, a: JsonObject, b: JsonObject): boolean {
    return list === "models" ? equalJson(withPlainIds(a), withPlainIds(b)) : equalJson(a, b);
}
