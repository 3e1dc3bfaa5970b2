/* SPDX-License-Identifier: MIT */
/* Places: what a path in an edit, or in an error, names. */

export type RecordName = "camera" | "environment" | "render";

/* The named resources of a document. */
export type ListName = "lights" | "volumes" | "materials" | "primitives" | "shaders" | "models";

interface ListRow {
    /* The word for one of them. */
    readonly one: string;
    /* The member that says what it is an instance of. */
    readonly type: "type" | "shader" | null;
    /* The table of the schema with the types that are built in. */
    readonly types: "lights" | "volumes" | "shaders" | null;
    /* The member that holds its values; null: they stand beside the type. */
    readonly values: "properties" | null;
    /* It carries its name itself, as `id`. */
    readonly id: boolean;
}

/* THE TABLE of lists. Order is that of panels. */
export const LISTS: Readonly<Record<ListName, ListRow>> = {
    models: { one: "model", type: null, types: null, values: null, id: false },
    materials: {
        one: "material",
        type: "shader",
        types: "shaders",
        values: "properties",
        id: false,
    },
    lights: { one: "light", type: "type", types: "lights", values: null, id: true },
    volumes: { one: "volume", type: "type", types: "volumes", values: null, id: true },
    primitives: { one: "primitive", type: null, types: null, values: null, id: false },
    shaders: { one: "shader", type: null, types: null, values: null, id: false },
};

const SAVED = ["primitives", "materials", "models"] as const;

/* Lists whose items can be saved to the library. */
export type SavedList = (typeof SAVED)[number];

export const isSavable = (list: ListName): list is SavedList => SAVED.includes(list as SavedList);

export const LIST_NAMES = Object.keys(LISTS) as readonly ListName[];

function isList(name: string | undefined): name is ListName {
    return LIST_NAMES.includes(name as ListName);
}

/* `name` null: the whole record. */
export type Place =
    | { kind: "info"; name: string }
    | { kind: "record"; record: RecordName; name: string | null }
    | { kind: "node"; id: string }
    | { kind: "node-type"; id: string }
    | { kind: "node-value"; id: string; group: "common" | "params"; name: string }
    | { kind: "transform"; id: string; name: string | null }
    | { kind: "resource"; list: ListName; resource: string }
    | { kind: "resource-type"; list: ListName; resource: string }
    | { kind: "resource-value"; list: ListName; resource: string; name: string }
    | { kind: "list"; list: ListName };

export const ID_PATTERN = /^[A-Za-z0-9_.-]{1,64}$/;

function parseNodePlace(id: string, rest: readonly string[]): Place | null {
    const [group, name] = rest;
    if (group === undefined) {
        return { kind: "node", id };
    }
    if (group === "transform" && rest.length <= 2) {
        return { kind: "transform", id, name: name ?? null };
    }
    if (group === "params" && rest.length === 2 && name) {
        return { kind: "node-value", id, group: "params", name };
    }
    if (rest.length !== 1) {
        return null;
    }
    return group === "type"
        ? { kind: "node-type", id }
        : { kind: "node-value", id, group: "common", name: group };
}

function parseResourcePlace(list: ListName, rest: readonly string[]): Place | null {
    const [resource, ...inner] = rest;
    const row = LISTS[list];
    if (resource === undefined) {
        return { kind: "list", list };
    }
    if (inner.length === 0) {
        return { kind: "resource", list, resource };
    }
    if (inner.length === 1 && inner[0] === row.type) {
        return { kind: "resource-type", list, resource };
    }
    const [name, ...more] = inner[0] === row.values ? inner.slice(1) : inner;
    const inPlace = row.values === null || inner[0] === row.values;
    return inPlace && name !== undefined && more.length === 0
        ? { kind: "resource-value", list, resource, name }
        : null;
}

/* The parts of a path such as /nodes/body/params/radius; null where no edit could name it. */
export function parsePlace(path: string): Place | null {
    if (!path.startsWith("/")) {
        return null;
    }
    const [first, ...rest] = path.slice(1).split("/");
    if (rest.some((part) => part === "")) {
        return null;
    }
    if (isList(first)) {
        return parseResourcePlace(first, rest);
    }
    switch (first) {
        case "name":
            return rest.length === 0 ? { kind: "info", name: "name" } : null;
        case "camera":
        case "environment":
        case "render":
            return rest.length <= 1
                ? { kind: "record", record: first, name: rest[0] ?? null }
                : null;
        case "nodes":
            return rest[0] === undefined ? null : parseNodePlace(rest[0], rest.slice(1));
        default:
            return null;
    }
}

export function resourcePlace(list: ListName, name: string): string {
    return `/${list}/${name}`;
}

/* Where the values of a resource stand: the base of its form. */
export function valuesPlace(list: ListName, name: string): string {
    const { values } = LISTS[list];
    return values === null ? resourcePlace(list, name) : `${resourcePlace(list, name)}/${values}`;
}

/* A place in a refused edit begins with the number of its operation, which nobody needs to see. */
export function cleanPlace(path: string): string {
    return path.replace(/^\/\d+(?=\/)/, "");
}

/* The node that a path lies in, or null: where an error is shown. */
export function nodeOfPlace(path: string): string | null {
    return /^\/nodes\/([A-Za-z0-9_.-]{1,64})(\/|$)/.exec(cleanPlace(path))?.[1] ?? null;
}

/* The resource that a path lies in, or null. */
export function resourceOfPlace(path: string): { list: ListName; name: string } | null {
    const [, list, name] = cleanPlace(path).split("/");
    return isList(list) && name !== undefined && name !== "" ? { list, name } : null;
}

/* Does a path lie in what `outer` names, or is it that? */
export function isWithin(path: string, outer: string): boolean {
    return path === outer || path.startsWith(`${outer}/`);
}
