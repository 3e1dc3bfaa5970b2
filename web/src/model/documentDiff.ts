/* SPDX-License-Identifier: MIT */
/* The fewest edits that make one document into another. Nodes and resources are told apart by their
 * ids and names: what keeps its own is set and moved, and a changed number is one set. */
import {
    everyNode,
    findResource,
    modelOf,
    preorder,
    type Resource,
    type SceneDocument,
} from "./document.ts";
import { DocumentDraft } from "./documentDraft.ts";
import { printNode } from "./documentJson.ts";
import { nodeJson, resourceJson } from "./documentText.ts";
import { equalJson, isObject, type Json, type JsonObject, listOf } from "./json.ts";
import { SETTINGS, settingsOf } from "./modelParams.ts";
import { needed } from "./naming.ts";
import { type Operation, type Problem, Refusal } from "./operation.ts";
import { applyOne } from "./operations.ts";
import {
    isWithin,
    LISTS,
    type ListName,
    nodeOfPlace,
    resourcePlace,
    valuesPlace,
} from "./places.ts";
import { rising } from "./rising.ts";
import { type DeclaredRow, findParam, nodeType, type Schema, type Values } from "./schema.ts";
import { usersOf } from "./usage.ts";

export type Difference =
    | { readonly ok: true; readonly ops: readonly Operation[] }
    | { readonly ok: false; readonly problem: Problem };

/* Each before those that may name it. */
const PLAIN: readonly ListName[] = ["primitives", "shaders", "materials", "lights", "volumes"];
const GOING: readonly ListName[] = ["models", "materials", ...PLAIN];

export function difference(
    schema: Schema,
    before: SceneDocument,
    after: SceneDocument,
): Difference {
    try {
        return { ok: true, ops: new Plan(schema, before, after).run(false) };
    } catch (error) {
        if (!(error instanceof Refusal)) {
            throw error;
        }
    }
    /* Instances on their way may close a circle for a moment: they let go of their models first. */
    try {
        return { ok: true, ops: new Plan(schema, before, after).run(true) };
    } catch (error) {
        if (error instanceof Refusal) {
            return { ok: false, problem: error.problem };
        }
        throw error;
    }
}

/* Which tree a node is the root of: "/" the scene's, else the model's; "": it is no root. */
function rootOf(document: SceneDocument, id: string): string {
    if (document.nodes.get(id)?.parent !== null) {
        return "";
    }
    return document.root === id ? "/" : (modelOf(document, id)?.name ?? "");
}

/* Those of `wanted` that can stay where they are among `now` while the others move. */
function staying(now: readonly string[], wanted: readonly string[]): ReadonlySet<string> {
    const index = new Map(now.map((name, i) => [name, i]));
    const there = wanted.filter((name) => index.has(name));
    const keep = rising(there.map((name) => index.get(name) ?? 0));
    return new Set(keep.map((i) => there[i] as string));
}

class Plan {
    readonly #ops: Operation[] = [];
    readonly #draft: DocumentDraft;
    readonly #schema: Schema;
    readonly #before: SceneDocument;
    readonly #after: SceneDocument;

    constructor(schema: Schema, before: SceneDocument, after: SceneDocument) {
        this.#schema = schema;
        this.#before = before;
        this.#after = after;
        this.#draft = new DocumentDraft(before, schema);
    }

    /* `free`: instances that change let go of their models first. */
    run(free: boolean): readonly Operation[] {
        const after = this.#after;
        if (this.#before.root !== after.root) {
            const place = `/nodes/${this.#before.root}`;
            throw new Refusal("conflict", place, `the root keeps its id ${this.#before.root}`);
        }
        this.#releaseTargets();
        this.#makeRoom(free);
        this.#removeGone(false);
        this.#records();
        for (const list of PLAIN) {
            this.#resources(list);
        }
        this.#models();
        for (const root of [after.root, ...after.models.map((model) => model.root)]) {
            this.#settle(root);
        }
        this.#removeGone(true);
        for (const id of everyNode(after)) {
            this.#ruling(id);
        }
        this.#declareSettings();
        for (const id of everyNode(after)) {
            this.#node(id);
        }
        this.#removeResources();
        return this.#ops;
    }

    get #now(): SceneDocument {
        return this.#draft.document;
    }

    #do(operation: Operation): void {
        applyOne(this.#draft, operation);
        this.#ops.push(operation);
    }

    #set(at: string, value: Json): void {
        this.#do({ op: "set", at, value });
    }

    /* --- what stands in the way --- */

    #makeRoom(free: boolean): void {
        const { nodes } = this.#after;
        const changed = (id: string): boolean =>
            nodes.has(id) && rootOf(this.#before, id) !== rootOf(this.#after, id);
        for (const { name, root } of this.#before.models) {
            const other = findResource(this.#after, "models", name);
            if (changed(root) || (other !== null && other.root !== root)) {
                this.#takeModel(name);
            }
        }
        for (const id of this.#before.nodes.keys()) {
            if (changed(id) && this.#now.nodes.has(id)) {
                this.#keepInner(id, changed);
                this.#do({ op: "remove", at: `/nodes/${id}` });
            }
        }
        if (free) {
            for (const id of nodes.keys()) {
                this.#freeInstance(id);
            }
        }
    }

    /* Nodes of the new document inside of what goes wait in the scene. */
    #keepInner(id: string, goes: (id: string) => boolean): void {
        const inner = this.#now.nodes.get(id)?.children ?? [];
        for (const child of inner) {
            if (this.#after.nodes.has(child) && !goes(child)) {
                const into = `/nodes/${this.#now.root}`;
                this.#do({ op: "move", at: `/nodes/${child}`, into, before: null });
            } else {
                this.#keepInner(child, goes);
            }
        }
    }

    /* Takes a model away, and its name from those who have it. */
    #takeModel(name: string): void {
        const root = findResource(this.#now, "models", name)?.root ?? "";
        this.#keepInner(root, (id) => rootOf(this.#before, id) !== rootOf(this.#after, id));
        for (const user of usersOf(this.#schema, this.#draft.snapshot(), "models", name)) {
            this.#letGo(user.name);
        }
        this.#do({ op: "remove", at: resourcePlace("models", name) });
    }

    #letGo(id: string): void {
        const node = this.#now.nodes.get(id);
        for (const param of nodeType(this.#schema, node?.type ?? "")?.params ?? []) {
            if (param.type === "model" && node?.params[param.name] !== undefined) {
                this.#set(`/nodes/${id}/params/${param.name}`, null);
            }
        }
    }

    #freeInstance(id: string): void {
        const now = this.#now.nodes.get(id);
        const after = this.#after.nodes.get(id);
        const tree = (document: SceneDocument) => modelOf(document, id)?.name;
        const same = equalJson(now?.params as Json | undefined, after?.params as Json | undefined);
        if (now && after && !(same && tree(this.#now) === tree(this.#after))) {
            this.#letGo(id);
        }
    }

    /* --- values --- */

    #values(now: Values, wanted: Values, base: string, first: readonly string[] = []): void {
        const names = [...new Set([...first, ...Object.keys(wanted), ...Object.keys(now)])];
        for (const name of names) {
            const value = wanted[name] as Json | undefined;
            if (!equalJson(now[name] as Json | undefined, value)) {
                this.#set(`${base}/${name}`, value ?? null);
            }
        }
    }

    #records(): void {
        this.#values(this.#now.info, this.#after.info, "");
        for (const record of ["camera", "environment", "render"] as const) {
            this.#values(this.#now[record], this.#after[record], `/${record}`);
        }
    }

    /* Its type, and the name that decides what other values it has. */
    #ruling(id: string): void {
        const wanted = this.#after.nodes.get(id);
        const now = () => this.#draft.node(id, `/nodes/${id}`);
        const at = `/nodes/${id}`;
        if (!wanted) {
            return;
        }
        if (now().type !== wanted.type) {
            this.#set(`${at}/type`, wanted.type);
        }
        const rows = nodeType(this.#schema, wanted.type)?.params ?? [];
        for (const { name } of rows.filter(({ type }) => ["function", "model"].includes(type))) {
            const value = wanted.params[name] as Json | undefined;
            if (!equalJson(now().params[name] as Json | undefined, value)) {
                this.#set(`${at}/params/${name}`, value ?? null);
            }
        }
    }

    #node(id: string): void {
        const wanted = this.#after.nodes.get(id);
        const now = () => this.#draft.node(id, `/nodes/${id}`);
        const at = `/nodes/${id}`;
        if (!wanted) {
            return;
        }
        this.#values(now().common, wanted.common, at);
        this.#values(now().transform, wanted.transform, `${at}/transform`);
        this.#values(now().params, wanted.params, `${at}/params`);
    }

    /* --- parameters of models --- */

    /* Models behind those of which they hold instances. */
    #inner(document: SceneDocument): readonly Resource[] {
        const roots = document.models.map(({ root }) => printNode(document, root));
        return needed(this.#schema, document, roots).flatMap(({ list, name }) => {
            const model = list === "models" && findResource(document, list, name);
            return model ? [model] : [];
        });
    }

    #setSettings(name: string, rows: readonly DeclaredRow[]): void {
        const now = findResource(this.#now, "models", name);
        if (now && !equalJson(settingsOf(now) as Json, rows as Json)) {
            this.#set(`/models/${name}/${SETTINGS}`, rows.length > 0 ? rows : null);
        }
    }

    /* What is set cannot change in kind: rows that are to go or to set something else go first, of
     * the outer models before those of the inner ones. */
    #releaseTargets(): void {
        const stays = (row: DeclaredRow, rows: readonly DeclaredRow[]): boolean =>
            rows.some(
                ({ name, type, sets }) =>
                    name === row.name && type === row.type && sets === row.sets,
            );
        for (const model of this.#outer(this.#before)) {
            const after = findResource(this.#after, "models", model.name);
            const rows = after ? settingsOf(after) : [];
            const kept = settingsOf(model).filter((row) => stays(row, rows));
            this.#setSettings(model.name, kept);
        }
    }

    #outer(document: SceneDocument): readonly Resource[] {
        const inner = this.#inner(document);
        const rest = document.models.filter((model) => !inner.includes(model));
        return [...rest, ...[...inner].reverse()];
    }

    #declareSettings(): void {
        for (const model of [...this.#outer(this.#after)].reverse()) {
            this.#setSettings(model.name, settingsOf(model));
        }
    }

    /* --- lists --- */

    #resources(list: ListName): void {
        this.#arrange(list, (resource) => {
            const base = resourcePlace(list, resource.name);
            const now = () => this.#draft.resource(list, resource.name, base);
            if (now().type !== resource.type) {
                this.#set(`${base}/${LISTS[list].type}`, resource.type);
            }
            this.#values(now().values, resource.values, valuesPlace(list, resource.name));
        });
    }

    /* From the last to the first, so that what something goes in front of has its place. */
    #arrange(list: ListName, change: (resource: Resource) => void): void {
        const wanted = this.#after[list];
        const names = wanted.map(({ name }) => name);
        const stay = staying(
            this.#now[list].map(({ name }) => name),
            names,
        );
        for (let i = wanted.length - 1; i >= 0; i--) {
            const resource = wanted[i] as Resource;
            const { name } = resource;
            const before = names[i + 1] ?? null;
            if (findResource(this.#now, list, name) === null) {
                this.#insertResource(list, resource, before);
                continue;
            }
            if (!stay.has(name)) {
                const at = resourcePlace(list, name);
                this.#do({ op: "move", at, into: `/${list}`, before });
            }
            change(resource);
        }
    }

    #insertResource(list: ListName, resource: Resource, before: string | null): void {
        const value =
            list === "models"
                ? this.#newNode(resource.root)
                : resourceJson(this.#schema, this.#after, list, resource);
        const name = LISTS[list].id ? {} : { name: resource.name };
        this.#do({ op: "insert", into: `/${list}`, before, value, ...name });
    }

    #models(): void {
        this.#arrange("models", () => undefined);
    }

    /* Users before what they use. */
    #removeResources(): void {
        for (const list of GOING) {
            for (let again = true; again; ) {
                again = false;
                for (const { name } of this.#now[list]) {
                    const used = () =>
                        usersOf(this.#schema, this.#draft.snapshot(), list, name).length > 0;
                    if (findResource(this.#after, list, name) === null && !used()) {
                        this.#do({ op: "remove", at: resourcePlace(list, name) });
                        again = true;
                    }
                }
            }
        }
    }

    /* --- trees --- */

    /* A new node with what is new below it. Models that are not there yet are named later, and what
     * they declare is set then. */
    #newNode(id: string): JsonObject {
        const isNew = (child: string): boolean => !this.#now.nodes.has(child);
        return this.#withoutModels(nodeJson(this.#schema, this.#after, id, isNew));
    }

    #withoutModels(json: JsonObject): JsonObject {
        const { params, children, ...rest } = json;
        const rows = nodeType(this.#schema, String(json.type))?.params ?? [];
        const unknown = (name: string, value: Json | undefined): boolean =>
            rows.some((row) => row.name === name && row.type === "model") &&
            findResource(this.#now, "models", String(value)) === null;
        const instance = rows.some(({ type }) => type === "model");
        const own = (name: string) => !instance || findParam(rows, name) !== null;
        const values = Object.entries(isObject(params) ? params : {});
        const kept = values.filter(([name, value]) => own(name) && !unknown(name, value));
        const inner = listOf(children).filter(isObject);
        return {
            ...rest,
            ...(kept.length > 0 ? { params: Object.fromEntries(kept) } : {}),
            ...(inner.length > 0
                ? { children: inner.map((child) => this.#withoutModels(child)) }
                : {}),
        };
    }

    /* Brings the children of a node, which is where it belongs, to their places. */
    #settle(id: string): void {
        const wanted = this.#after.nodes.get(id)?.children ?? [];
        const stay = staying(this.#now.nodes.get(id)?.children ?? [], wanted);
        const into = `/nodes/${id}`;
        for (let i = wanted.length - 1; i >= 0; i--) {
            const child = wanted[i] as string;
            const before = wanted[i + 1] ?? null;
            if (!this.#now.nodes.has(child)) {
                this.#do({ op: "insert", into, before, value: this.#newNode(child) });
            } else if (!stay.has(child)) {
                this.#do({ op: "move", at: `/nodes/${child}`, into, before });
            }
        }
        for (const child of wanted) {
            this.#settle(child);
        }
    }

    /* `all` false: those that hold nothing that stays. */
    #removeGone(all: boolean): void {
        const { nodes } = this.#after;
        const remove = (id: string): void => {
            const node = this.#now.nodes.get(id);
            const gone = node && node.parent !== null && !nodes.has(id);
            if (gone && (all || !preorder(this.#now, id).some((inner) => nodes.has(inner)))) {
                this.#do({ op: "remove", at: `/nodes/${id}` });
                return;
            }
            node?.children.forEach(remove);
        };
        const models = this.#now.models.filter(
            ({ name }) => findResource(this.#after, "models", name) !== null,
        );
        [this.#now.root, ...models.map((model) => model.root)].forEach(remove);
    }
}

/* --- whether two authors meet --- */

/* Places that operations write, with all that is inside of what they remove. Where something
 * stands is a place of its own. */
function written(document: SceneDocument, ops: readonly Operation[]): readonly string[] {
    return ops.flatMap((op) => {
        if (op.op !== "remove") {
            return op.op === "set" ? [op.at] : op.op === "move" ? [`${op.at}/(place)`] : [];
        }
        const id = nodeOfPlace(op.at);
        return id === null ? [op.at] : preorder(document, id).map((inner) => `/nodes/${inner}`);
    });
}

/* Places that both write, as `document` was before either. */
export function meeting(
    document: SceneDocument,
    mine: readonly Operation[],
    theirs: readonly Operation[],
): readonly string[] {
    const others = written(document, theirs);
    return [...new Set(written(document, mine))].filter((place) =>
        others.some((other) => isWithin(place, other) || isWithin(other, place)),
    );
}
