/* SPDX-License-Identifier: MIT */
/* Entries of the library as the server tells them. What scenes give and take is library.ts. */
import { isObject, type Json, type JsonObject, listOf, textOf } from "./json.ts";

export const LIBRARY_FORMAT = "fieldcast-library/1";

export const ENTRY_KINDS = ["primitive", "material", "model"] as const;
export type EntryKind = (typeof ENTRY_KINDS)[number];

/* As the server lists it. */
export interface EntryRow {
    readonly id: string;
    readonly kind: EntryKind;
    readonly name: string;
    readonly nodes: number;
}

export interface Entry {
    readonly kind: EntryKind;
    readonly document: JsonObject;
}

export function readEntryRows(json: Json): readonly EntryRow[] {
    return listOf(isObject(json) ? json.entries : [])
        .filter(isObject)
        .map(({ id, kind, name, nodes }) => ({
            id: textOf(id),
            kind: ENTRY_KINDS.find((one) => one === kind) ?? "model",
            name: textOf(name),
            nodes: typeof nodes === "number" ? nodes : 0,
        }));
}

export function readEntry(json: Json): Entry {
    const object = isObject(json) ? json : {};
    return {
        kind: ENTRY_KINDS.find((one) => one === object.kind) ?? "model",
        document: isObject(object.document) ? object.document : {},
    };
}
