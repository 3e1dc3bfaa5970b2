/* SPDX-License-Identifier: MIT */
/* A scene from a text that people write: the document, or everything that is wrong, each at its
 * place. What only the server can tell, such as an equation, it refuses itself. */
import {
    findResource,
    knowsType,
    nodeParams,
    resourceParams,
    type SceneDocument,
} from "./document.ts";
import { readDocument } from "./documentJson.ts";
import { type Part, partAt, partsOf } from "./documentText.ts";
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";
import { type Located, parseText, type Span } from "./jsonText.ts";
import type { Problem } from "./operation.ts";
import { ID_PATTERN, LIST_NAMES, LISTS, type ListName, resourcePlace } from "./places.ts";
import { findParam, limitOf, nodeType, type Param, type Schema, type Value } from "./schema.ts";
import { listNamedBy } from "./usage.ts";
import { checkValue } from "./values.ts";

/* Something wrong and where. `place`: as edits name it; "": not in a document yet. */
export interface TextFault extends Span {
    readonly place: string;
    readonly message: string;
}

export type ReadText =
    | { readonly ok: true; readonly document: SceneDocument; readonly parts: readonly Part[] }
    | {
          readonly ok: false;
          readonly faults: readonly TextFault[];
          /* Null: it is no JSON. */
          readonly parts: readonly Part[] | null;
      };

/* More than these nobody reads. */
const MOST_FAULTS = 50;

/* --- ids --- */

const idIn = (item: Located): string => (isObject(item.json) ? textOf(item.json.id) : "");
const typeIn = (item: Located): string => (isObject(item.json) ? textOf(item.json.type) : "");
const childrenOf = (item: Located) => item.members.get("children")?.value.items ?? [];

/* The tree of a model: its root, or the model itself. */
const treeIn = (item: Located): Located => item.members.get("root")?.value ?? item;

function rootsIn(whole: Located): { item: Located; id: (base: SceneDocument) => string }[] {
    const root = whole.members.get("root")?.value;
    const models = whole.members.get("models")?.value.members ?? new Map();
    return [
        ...(root ? [{ item: root, id: (base: SceneDocument) => base.root }] : []),
        ...[...models].map(([name, { value }]) => ({
            item: treeIn(value as Located),
            id: (base: SceneDocument) => findResource(base, "models", name)?.root ?? "",
        })),
    ];
}

/* The id of each node, light and volume. Those without get the same one each time the same text is
 * read: roots that of the scene as it is, others the first that is free in the text. */
function identify(whole: Located, base: SceneDocument): ReadonlyMap<Located, string> {
    const ids = new Map<Located, string>();
    const nameAll = (items: readonly Located[]): void => {
        const taken = new Set([...items.map(idIn), ...items.map((item) => ids.get(item) ?? "")]);
        for (const item of items) {
            let id = idIn(item) || (ids.get(item) ?? "");
            for (let n = 1; id === ""; n++) {
                const free = `${typeIn(item) || "node"}-${n}`;
                id = taken.has(free) ? "" : free;
            }
            taken.add(id);
            ids.set(item, id);
        }
    };
    const nodes: Located[] = [];
    const collect = (item: Located): void => {
        nodes.push(item);
        childrenOf(item).forEach(collect);
    };
    for (const { item, id } of rootsIn(whole)) {
        collect(item);
        if (idIn(item) === "") {
            ids.set(item, id(base));
        }
    }
    nameAll(nodes);
    nameAll(whole.members.get("lights")?.value.items ?? []);
    nameAll(whole.members.get("volumes")?.value.items ?? []);
    return ids;
}

/* The JSON with all ids in it. */
function withIds(item: Located, ids: ReadonlyMap<Located, string>): Json {
    if (Array.isArray(item.json)) {
        return item.items.map((inner) => withIds(inner, ids));
    }
    if (!isObject(item.json)) {
        return item.json;
    }
    const members = [...item.members].map(([name, { value }]) => [name, withIds(value, ids)]);
    const id = ids.get(item);
    return { ...Object.fromEntries(members), ...(id === undefined ? {} : { id }) };
}

/* --- checks --- */

class Check {
    readonly faults: TextFault[] = [];
    readonly #schema: Schema;
    readonly #document: SceneDocument;
    readonly #ids: ReadonlyMap<Located, string>;
    readonly #seen = new Set<string>();
    #depth = 0;

    constructor(schema: Schema, document: SceneDocument, ids: ReadonlyMap<Located, string>) {
        this.#schema = schema;
        this.#document = document;
        this.#ids = ids;
    }

    fault({ from, to }: Span, place: string, message: string): void {
        if (this.faults.length < MOST_FAULTS) {
            this.faults.push({ from, to, place, message });
        }
    }

    /* Is it an object? Members that are neither in `own` nor rows are told. */
    #object(item: Located, place: string): boolean {
        if (!isObject(item.json)) {
            this.fault(item, place, "an object is expected");
            return false;
        }
        return true;
    }

    #text(item: Located | undefined, place: string): void {
        if (item && typeof item.json !== "string") {
            this.fault(item, place, "text is expected");
        }
    }

    /* Values by their rows; `own`: other members that may stand beside them. */
    #values(
        item: Located | undefined,
        params: readonly Param[],
        place: string,
        who: string,
        own: readonly string[] = [],
    ): void {
        if (item === undefined || !this.#object(item, place)) {
            return;
        }
        for (const [name, { key, value }] of item.members) {
            const at = `${place}/${name}`;
            const param = findParam(params, name);
            if (own.includes(name)) {
                continue;
            }
            if (!param) {
                this.fault(key, at, strangeMessage(who, name, params, own));
                continue;
            }
            const reason = this.#reason(param, value);
            if (reason !== null) {
                this.fault(value, at, reason);
            }
        }
    }

    #reason(param: Param, { json }: Located): string | null {
        if (json === null) {
            return "null is no value: leave the member out to have its default";
        }
        const reason =
            (param.type === "rows" ? whyNoRows(json) : null) ?? checkValue(param, json as Value);
        const list = listNamedBy(param.type);
        if (reason !== null || list === null || json === "") {
            return reason;
        }
        const there = findResource(this.#document, list, String(json)) !== null;
        return there ? null : `there is no ${LISTS[list].one} ${String(json)}`;
    }

    node(item: Located): void {
        const id = this.#ids.get(item) ?? "";
        const place = `/nodes/${id}`;
        if (!this.#object(item, place)) {
            return;
        }
        this.#id(item, id, place);
        const { type = null, children = null } = Object.fromEntries(
            [...item.members].map(([name, { value }]) => [name, value]),
        );
        const row = nodeType(this.#schema, typeIn(item));
        if (type === null) {
            this.fault(item.members.get("id")?.value ?? item, place, "a node needs a type");
        } else if (row === null) {
            this.fault(type, `${place}/type`, `there is no node type ${String(type.json)}`);
        }
        const own = ["id", "type", "transform", "params", "children"];
        const { transform, node: common } = this.#schema;
        const inner = (name: string) => item.members.get(name)?.value;
        this.#values(item, common, place, "a node", own);
        this.#values(inner("transform"), transform, `${place}/transform`, "a transform");
        const node = this.#document.nodes.get(id);
        if (row !== null && node) {
            const params = nodeParams(this.#schema, this.#document, node);
            this.#values(inner("params"), params, `${place}/params`, row.type);
        }
        this.#children(children, place);
    }

    #children(children: Located | null, place: string): void {
        if (children === null) {
            return;
        }
        if (!Array.isArray(children.json)) {
            this.fault(children, place, "children are a list of nodes");
        }
        const most = limitOf(this.#schema, "node_depth", 64);
        this.#depth++;
        if (this.#depth >= most) {
            this.fault(children, place, `more levels than the maximum ${most}`);
        } else {
            for (const child of children.items) {
                this.node(child);
            }
        }
        this.#depth--;
    }

    #id(item: Located, id: string, place: string): void {
        const own = item.members.get("id");
        if (own && typeof own.value.json !== "string") {
            this.fault(own.value, place, "an id is text");
        } else if (!ID_PATTERN.test(id)) {
            this.fault(own?.value ?? item, place, NAME_MESSAGE);
        } else if (this.#seen.has(id)) {
            this.fault(own?.value ?? item, place, `the id ${id} is in use`);
        }
        this.#seen.add(id);
    }

    #resource(list: ListName, name: string, item: Located): void {
        const place = resourcePlace(list, name);
        const row = LISTS[list];
        if (list === "models") {
            const tree = treeIn(item);
            if (tree !== item) {
                this.#values(item, this.#schema.model, place, "a model", ["root"]);
            }
            this.node(tree);
            return;
        }
        if (!this.#object(item, place)) {
            return;
        }
        const member = row.type === null ? null : (item.members.get(row.type)?.value ?? null);
        const type = textOf(member?.json);
        if (row.type !== null && !knowsType(this.#schema, this.#document, list, type)) {
            const where = member ?? item.members.get("id")?.value ?? item;
            const message = member
                ? `there is no ${row.type} ${String(member.json)}`
                : `a ${row.one} needs a ${row.type}`;
            this.fault(where, `${place}/${row.type}`, message);
            return;
        }
        const params = resourceParams(this.#schema, this.#document, list, type);
        const own = [...(row.id ? ["id"] : []), ...(row.type === null ? [] : [row.type])];
        if (row.values === null) {
            this.#values(item, params, place, type || `a ${row.one}`, own);
        } else {
            this.#values(item, [], place, `a ${row.one}`, [...own, row.values]);
            const values = item.members.get(row.values)?.value;
            this.#values(values, params, `${place}/${row.values}`, type);
        }
    }

    #list(list: ListName, item: Located): void {
        const { id, one } = LISTS[list];
        if (id ? !Array.isArray(item.json) : !isObject(item.json)) {
            const form = id
                ? `a list: each ${one} has its id`
                : `an object: each ${one} by its name`;
            this.fault(item, `/${list}`, `${list} are ${form}`);
            return;
        }
        const seen = new Set<string>();
        for (const one of item.items) {
            const name = this.#ids.get(one) ?? "";
            const where = one.members.get("id")?.value ?? one;
            if (seen.has(name) || !ID_PATTERN.test(name)) {
                const message = seen.has(name) ? `the id ${name} is in use` : NAME_MESSAGE;
                this.fault(where, resourcePlace(list, name), message);
            }
            seen.add(name);
            this.#resource(list, name, one);
        }
        for (const [name, { key, value }] of item.members) {
            const builtIn = list === "shaders" && this.#schema.shaders.some((s) => s.type === name);
            if (builtIn || !ID_PATTERN.test(name)) {
                const message = builtIn ? `the shader ${name} is built in` : NAME_MESSAGE;
                this.fault(key, resourcePlace(list, name), message);
            }
            this.#resource(list, name, value);
        }
    }

    whole(item: Located, base: SceneDocument): void {
        if (!this.#object(item, "")) {
            return;
        }
        const get = (name: string) => item.members.get(name)?.value;
        for (const [name, { key }] of item.members) {
            if (!MEMBERS.includes(name)) {
                this.fault(key, `/${name}`, strangeMessage("a scene", name, [], MEMBERS));
            }
        }
        const format = get("format");
        if (format?.json !== "fieldcast/1") {
            this.fault(format ?? start(item), "/format", 'the format is "fieldcast/1"');
        }
        this.#text(get("name"), "/name");
        for (const record of ["camera", "environment", "render"] as const) {
            const params = this.#schema[record];
            this.#values(get(record), params, `/${record}`, `the ${record}`);
        }
        for (const list of LIST_NAMES) {
            const inner = get(list);
            if (inner) {
                this.#list(list, inner);
            }
        }
        const root = get("root");
        if (!root) {
            this.fault(start(item), "/root", "a scene needs a root");
            return;
        }
        this.node(root);
        if (this.#ids.get(root) !== base.root) {
            const where = root.members.get("id")?.value ?? root;
            this.fault(where, `/nodes/${base.root}`, `the root keeps its id ${base.root}`);
        }
    }
}

/* The form of declared parameters, before anything is read of them. */
function whyNoRows(json: Json): string | null {
    const isRow = (row: Json): boolean =>
        isObject(row) &&
        typeof row.name === "string" &&
        typeof row.type === "string" &&
        (row.range === undefined ||
            (listOf(row.range).length === 2 && listOf(row.range).every(isNumber)));
    return listOf(json).every(isRow)
        ? null
        : "each row has a name, a type and maybe a range [a, b]";
}

const isNumber = (json: Json): boolean => typeof json === "number";

const MEMBERS: readonly string[] = [
    "format",
    "name",
    "camera",
    "environment",
    "render",
    "root",
    ...LIST_NAMES,
];
const NAME_MESSAGE = "ids and names have 1 to 64 letters, digits, _ . and -";
/* Names that are told to whoever has missed one. */
const MOST_NAMES = 12;

/* The bracket that it begins with. */
const start = ({ from }: Located): Span => ({ from, to: from + 1 });

function strangeMessage(
    who: string,
    name: string,
    params: readonly Param[],
    own: readonly string[],
): string {
    const known = [...own, ...params.map((param) => param.name)];
    const more = known.length > MOST_NAMES ? ", …" : "";
    const names = known.slice(0, MOST_NAMES).join(", ");
    return `${who} has no ${name}${known.length > 0 ? `; it has ${names}${more}` : ""}`;
}

/* Reads a text that is to become what `base` is now. */
export function readText(schema: Schema, base: SceneDocument, text: string): ReadText {
    const parsed = parseText(text);
    if (!parsed.ok) {
        return { ok: false, faults: [{ ...parsed.fault, place: "" }], parts: null };
    }
    const whole = parsed.value;
    const ids = identify(whole, base);
    const document = readDocument(withIds(whole, ids) as JsonObject);
    const check = new Check(schema, document, ids);
    check.whole(whole, base);
    const parts = partsOf(whole, (item) => ids.get(item) ?? "");
    const faults = [...check.faults].sort((a, b) => a.from - b.from);
    return faults.length === 0 ? { ok: true, document, parts } : { ok: false, faults, parts };
}

/* What an edit was refused for, at its place in the text. */
export function faultAt(parts: readonly Part[], { place, message }: Problem): TextFault {
    const part = partAt(parts, place);
    const { from, to } = part?.key ?? part ?? { from: 0, to: 1 };
    return { from, to, place, message };
}
