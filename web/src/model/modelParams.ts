/* SPDX-License-Identifier: MIT */
/* Parameters of models: the number of the tree that each sets, and the tree as an instance has it. */
import { declaredParams, rowsOf } from "./declaredParams.ts";
import {
    modelNamed,
    nodeParams,
    pathTo,
    type Resource,
    type SceneDocument,
    type SceneNode,
} from "./document.ts";
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import type { Operation } from "./operation.ts";
import {
    type DeclaredRow,
    findParam,
    type Param,
    type Schema,
    type Value,
    type Values,
    valueIn,
} from "./schema.ts";
import { usersOf } from "./usage.ts";
import { numbersOf } from "./values.ts";

/* The member of a model that declares them. */
export const SETTINGS = "params";

export interface Target {
    readonly node: string;
    readonly group: "params" | "transform";
    readonly name: string;
    /* Which component; null: all. */
    readonly component: number | null;
}

const COMPONENTS = "xyzw";

/* What "/nodes/ID/params/size.y" names; null: nothing. */
export function targetOf(sets: string): Target | null {
    const found = /^\/nodes\/([^/]+)\/(params|transform)\/([^/.]+)(?:\.([xyzw]))?$/.exec(sets);
    const [, node = "", group, name = "", letter] = found ?? [];
    return found === null
        ? null
        : {
              node,
              group: group as Target["group"],
              name,
              component: letter === undefined ? null : COMPONENTS.indexOf(letter),
          };
}

export const placeOf = ({ node, group, name, component }: Target): string =>
    `/nodes/${node}/${group}/${name}${component === null ? "" : `.${COMPONENTS[component]}`}`;

export const settingsOf = (model: Resource): readonly DeclaredRow[] =>
    rowsOf(model.values[SETTINGS]);

/* The row of the tree that a target lies in, and what it holds there. */
export function targetIn(
    schema: Schema,
    document: SceneDocument,
    target: Target,
): { param: Param; value: Value } | null {
    const node = document.nodes.get(target.node);
    const rows =
        node &&
        (target.group === "transform" ? schema.transform : nodeParams(schema, document, node));
    const param = rows ? findParam(rows, target.name) : null;
    if (!node || !param) {
        return null;
    }
    return { param, value: valueIn(node[target.group], param) };
}

/* One component of a value, or all of it. */
function partOf(value: Value, component: number | null, type: string): Value {
    if (component !== null) {
        const flags = Array.isArray(value) && typeof value[component] === "boolean";
        return flags ? (value[component] as boolean) : (numbersOf(value)[component] ?? 0);
    }
    return type === "float" ? (numbersOf(value)[0] ?? 0) : value;
}

function enriched(schema: Schema, document: SceneDocument, model: Resource): readonly Param[] {
    const rows = settingsOf(model);
    return declaredParams(model.values[SETTINGS]).map((row, i): Param => {
        const target = targetOf(textOf(rows[i]?.sets));
        const found = target && targetIn(schema, document, target);
        if (!target || !found) {
            return row;
        }
        const { unit, step, doc } = found.param;
        return {
            ...row,
            unit,
            step,
            doc: row.doc || doc,
            default: partOf(found.value, target.component, row.type),
        };
    });
}

const known = new WeakMap<object, { key: string; params: readonly Param[] }>();

/* The rows that instances have, with what the tree has as defaults. The same list while that is the
 * same, so that what is shown of it need not be drawn anew. */
export function settingParams(
    schema: Schema,
    document: SceneDocument,
    model: Resource,
): readonly Param[] {
    const rows = settingsOf(model);
    if (rows.length === 0) {
        return rows as readonly never[];
    }
    const params = enriched(schema, document, model);
    const key = JSON.stringify(params);
    const last = known.get(rows);
    if (last?.key === key) {
        return last.params;
    }
    known.set(rows, { key, params });
    return params;
}

/* --- the tree as an instance has it --- */

function put(
    record: JsonObject,
    { name, component }: Target,
    from: Json,
    value: Value,
): JsonObject {
    if (component === null) {
        return { ...record, [name]: value as Json };
    }
    const parts = Array.isArray(from) ? [...from] : numbersOf(from as Value);
    parts[component] = value as Json as never;
    return { ...record, [name]: parts };
}

/* A node of a model, printed or not, with an instance's own numbers in it. */
function nodeWith<N extends { id?: unknown; params?: unknown; transform?: unknown }>(
    schema: Schema,
    document: SceneDocument,
    model: Resource,
    values: Values,
    tree: N,
): N {
    let node = tree;
    for (const { name, sets } of settingsOf(model)) {
        const target = targetOf(textOf(sets));
        const value = values[name];
        if (target === null || value === undefined || target.node !== node.id) {
            continue;
        }
        const record = (node[target.group] ?? {}) as JsonObject;
        const found = targetIn(schema, document, target);
        const from = record[target.name] ?? (found?.param.default as Json);
        node = { ...node, [target.group]: put(record, target, from, value) };
    }
    return node;
}

/* A model's tree, printed, with an instance's own numbers in it. */
export function treeWith(
    schema: Schema,
    document: SceneDocument,
    model: Resource,
    values: Values,
    tree: JsonObject,
): JsonObject {
    const node = nodeWith(schema, document, model, values, tree);
    const children = listOf(node.children).filter(isObject);
    return children.length === 0
        ? { ...node }
        : {
              ...node,
              children: children.map((child) => treeWith(schema, document, model, values, child)),
          };
}

/* How nodes are read: as they are, or as an instance has them. */
export type Reading = (node: SceneNode) => SceneNode;

/* The nodes of the model that an instance names. */
export function readingOf(
    schema: Schema,
    document: SceneDocument,
    model: Resource,
    instance: SceneNode,
): Reading {
    return (node) => nodeWith(schema, document, model, instance.params, node);
}

/* What a parameter of an instance sets at last. */
export interface Setting {
    /* From the root of the scene, through the instances, to the node, each as it is read there. */
    readonly path: readonly SceneNode[];
    readonly reading: Reading;
    readonly target: Target;
}

/* `path` ends at the instance. */
export function settingOf(
    schema: Schema,
    document: SceneDocument,
    path: readonly SceneNode[],
    name: string,
): Setting | null {
    const instance = path.at(-1);
    const model = modelNamed(schema, document, instance);
    const row = model && settingsOf(model).find((one) => one.name === name);
    const target = targetOf(textOf(row?.sets));
    if (!instance || !model || !target) {
        return null;
    }
    const reading = readingOf(schema, document, model, instance);
    const inner = [...path, ...pathTo(document, target.node).map(reading)];
    const further =
        target.group === "params" ? settingOf(schema, document, inner, target.name) : null;
    return further === null
        ? { path: inner, reading, target }
        : {
              ...further,
              target: {
                  ...further.target,
                  component: further.target.component ?? target.component,
              },
          };
}

/* --- what stands in the way --- */

/* The edit that gives a model these rows. */
export const setRows = (model: string, rows: readonly DeclaredRow[]): Operation => ({
    op: "set",
    at: `/models/${model}/${SETTINGS}`,
    value: rows.length > 0 ? rows : null,
});

/* Rows that stay, by the name of their model. */
export type Kept = Map<string, readonly DeclaredRow[]>;

export const allRows = (document: SceneDocument): Kept =>
    new Map(document.models.map((model) => [model.name, settingsOf(model)]));

/* Takes out of `kept` what sets something of nodes that are about to go, and what sets, of an
 * instance, a row that its model has not kept. Answers of which models, those that set something
 * before those in which it is set. */
export function release(
    schema: Schema,
    document: SceneDocument,
    kept: Kept,
    ids: readonly string[],
): readonly string[] {
    const gone = new Set(ids);
    const order: string[] = [];
    const isLost = ({ node, group, name }: Target): boolean =>
        group === "params" &&
        document.models.some(
            (model) =>
                settingsOf(model).some((row) => row.name === name) &&
                !kept.get(model.name)?.some((row) => row.name === name) &&
                usersOf(schema, document, "models", model.name).some((user) => user.name === node),
        );
    const isGone = (target: Target | null): boolean =>
        target !== null && (gone.has(target.node) || isLost(target));
    for (let again = true; again; ) {
        again = false;
        for (const { name } of document.models) {
            const rows = kept.get(name) ?? [];
            const rest = rows.filter(({ sets }) => !isGone(targetOf(textOf(sets))));
            if (rest.length < rows.length) {
                kept.set(name, rest);
                order.unshift(name);
                again = true;
            }
        }
    }
    return [...new Set(order)];
}

/* Takes away the parameters that set something of nodes that are about to go, and those that set
 * these parameters of an instance. */
export function released(
    schema: Schema,
    document: SceneDocument,
    ids: readonly string[],
): Operation[] {
    const kept = allRows(document);
    return release(schema, document, kept, ids).map((name) => setRows(name, kept.get(name) ?? []));
}
