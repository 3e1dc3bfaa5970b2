/* SPDX-License-Identifier: MIT */
/* The REST side of the library. */
import { isObject, type Json, listOf } from "../model/json.ts";
import {
    type Entry,
    type EntryRow,
    LIBRARY_FORMAT,
    readEntry,
    readEntryRows,
} from "../model/libraryEntries.ts";
import type { Request } from "./rest.ts";

/* What a file brought. */
export interface Brought {
    readonly rows: readonly EntryRow[];
    /* Of these, how many were not there before. */
    readonly added: number;
}

export interface LibraryRest {
    list(): Promise<readonly EntryRow[]>;
    read(id: string): Promise<Entry>;
    /* Under an id that the server finds. */
    add(entry: Entry): Promise<EntryRow | null>;
    /* Under this id, in place of what is there. */
    put(id: string, entry: Entry): Promise<void>;
    delete(id: string): Promise<void>;
    /* All of it as a file, and a file into it: the server reads the text. */
    exportFile(): Promise<Blob>;
    importFile(text: string): Promise<Brought>;
    pictureUrl(id: string, width: number): string;
}

export function createLibraryRest(base: string, request: Request): LibraryRest {
    const at = (id: string): string => `/v1/library/${encodeURIComponent(id)}`;
    const importFile = async (text: string): Promise<Brought> => {
        const response = await request("/v1/library", { method: "POST", body: text });
        const json = (await response.json()) as Json;
        const entries = listOf(isObject(json) ? json.entries : []).filter(isObject);
        return {
            rows: readEntryRows(json),
            added: entries.filter(({ added }) => added === true).length,
        };
    };
    return {
        list: async () => readEntryRows((await (await request("/v1/library")).json()) as Json),
        read: async (id) => readEntry((await (await request(at(id))).json()) as Json),
        add: async (entry) => {
            const file = { format: LIBRARY_FORMAT, entries: [entry] };
            return (await importFile(JSON.stringify(file))).rows[0] ?? null;
        },
        put: async (id, entry) => {
            await request(at(id), { method: "PUT", body: JSON.stringify(entry) });
        },
        delete: async (id) => {
            await request(at(id), { method: "DELETE" });
        },
        exportFile: async () => (await request("/v1/library.json")).blob(),
        importFile,
        pictureUrl: (id, width) => `${base}${at(id)}/picture.png?width=${width}`,
    };
}
