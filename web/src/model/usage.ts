/* SPDX-License-Identifier: MIT */
/* Who names what: nodes name materials, models and distance functions, materials name shaders.
 * What is named cannot go; models may not hold themselves. */
import { findResource, modelOf, nodeLabel, preorder, type SceneDocument } from "./document.ts";
import { LISTS, type ListName, resourcePlace } from "./places.ts";
import { nodeType, type Param, type ParamType, type Schema, type Values } from "./schema.ts";

export type NamedList = "materials" | "models" | "primitives";

/* Which list a value of such a row names something of. */
const NAMED: Partial<Record<ParamType, NamedList>> = {
    material: "materials",
    model: "models",
    function: "primitives",
};

export function listNamedBy(type: ParamType): NamedList | null {
    return NAMED[type] ?? null;
}

export interface User {
    readonly kind: "node" | "material";
    /* Its id or name. */
    readonly name: string;
}

/* By list, then by name. */
type Usage = ReadonlyMap<ListName, ReadonlyMap<string, readonly User[]>>;

const known = new WeakMap<SceneDocument, Usage>();
const NOBODY: readonly User[] = [];

function readUsage(schema: Schema, document: SceneDocument): Usage {
    const usage = new Map<ListName, Map<string, User[]>>();
    const note = (list: ListName, name: unknown, user: User): void => {
        if (typeof name !== "string" || name === "") {
            return;
        }
        const names = usage.get(list) ?? new Map<string, User[]>();
        usage.set(list, names);
        names.set(name, [...(names.get(name) ?? []), user]);
    };
    const noteAll = (params: readonly Param[], values: Values, user: User): void => {
        for (const { name, type } of params) {
            const list = NAMED[type];
            if (list !== undefined) {
                note(list, values[name], user);
            }
        }
    };
    for (const node of document.nodes.values()) {
        const user: User = { kind: "node", name: node.id };
        noteAll(schema.node, node.common, user);
        noteAll(nodeType(schema, node.type)?.params ?? [], node.params, user);
    }
    for (const material of document.materials) {
        if (findResource(document, "shaders", material.type) !== null) {
            note("shaders", material.type, { kind: "material", name: material.name });
        }
    }
    return usage;
}

/* Nodes in the order of the document, then materials. */
export function usersOf(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    name: string,
): readonly User[] {
    let usage = known.get(document);
    if (usage === undefined) {
        usage = readUsage(schema, document);
        known.set(document, usage);
    }
    return usage.get(list)?.get(name) ?? NOBODY;
}

/* Why something cannot be removed, or null. */
export function whyNotRemoved(
    schema: Schema,
    document: SceneDocument,
    list: ListName,
    name: string,
): string | null {
    const users = usersOf(schema, document, list, name);
    const [first] = users;
    if (first === undefined) {
        return null;
    }
    const others = users.length === 1 ? "" : ` and ${users.length - 1} more`;
    const node = first.kind === "node" ? document.nodes.get(first.name) : undefined;
    const user = node ? nodeLabel(node) : first.name;
    return `the ${LISTS[list].one} ${name} is used by ${first.kind} ${user}${others}`;
}

/* --- models --- */

/* Models that have an instance in the tree of `model`. */
function modelsIn(schema: Schema, document: SceneDocument, model: string): Set<string> {
    const inside = new Set<string>();
    const root = findResource(document, "models", model)?.root;
    for (const id of root === undefined ? [] : preorder(document, root)) {
        const node = document.nodes.get(id);
        for (const param of nodeType(schema, node?.type ?? "")?.params ?? []) {
            const name = param.type === "model" ? node?.params[param.name] : undefined;
            if (typeof name === "string" && name !== "") {
                inside.add(name);
            }
        }
    }
    return inside;
}

/* The way from a model through its instances back to itself: "/models/a -> /models/b ->
 * /models/a"; null where there is none. */
export function cycleThrough(
    schema: Schema,
    document: SceneDocument,
    model: string,
): string | null {
    const seen = new Set<string>();
    const search = (name: string, path: readonly string[]): readonly string[] | null => {
        for (const inner of modelsIn(schema, document, name)) {
            if (inner === model) {
                return [...path, inner];
            }
            if (!seen.has(inner)) {
                seen.add(inner);
                const found = search(inner, [...path, inner]);
                if (found) {
                    return found;
                }
            }
        }
        return null;
    };
    const cycle = search(model, [model]);
    return cycle?.map((name) => resourcePlace("models", name)).join(" -> ") ?? null;
}

/* Would moving `id` with what is below it into `into` make a model hold itself? */
export function modelsHeldBy(
    schema: Schema,
    document: SceneDocument,
    id: string,
    into: string,
): boolean {
    const allowed = new Set(modelsFor(schema, document, into));
    return preorder(document, id).some((inner) => {
        const node = document.nodes.get(inner);
        return (nodeType(schema, node?.type ?? "")?.params ?? []).some((param) => {
            const name = param.type === "model" ? node?.params[param.name] : undefined;
            return typeof name === "string" && name !== "" && !allowed.has(name);
        });
    });
}

/* Models of which an instance may stand where `id` is: not its own, nor one that holds its own. */
export function modelsFor(schema: Schema, document: SceneDocument, id: string): readonly string[] {
    const own = modelOf(document, id)?.name ?? null;
    const reaches = (from: string, seen: Set<string>): boolean =>
        from === own ||
        [...modelsIn(schema, document, from)].some(
            (inner) => !seen.has(inner) && reaches(inner, seen.add(inner)),
        );
    const names = document.models.map((model) => model.name);
    return own === null ? names : names.filter((name) => !reaches(name, new Set([name])));
}
