/* SPDX-License-Identifier: MIT */
/* The shape of JSON, and reading members of unknown objects without casts. */

export type Json = null | boolean | number | string | readonly Json[] | JsonObject;
export interface JsonObject {
    readonly [name: string]: Json | undefined;
}

export function isObject(value: unknown): value is JsonObject {
    return typeof value === "object" && value !== null && !Array.isArray(value);
}

export function textOf(value: Json | undefined, fallback = ""): string {
    return typeof value === "string" ? value : fallback;
}

export function numberOf(value: Json | undefined, fallback = 0): number {
    return typeof value === "number" ? value : fallback;
}

export function listOf(value: Json | undefined): readonly Json[] {
    return Array.isArray(value) ? value : [];
}

/* Deep equality; members whose value is undefined count as absent. */
export function equalJson(a: Json | undefined, b: Json | undefined): boolean {
    if (a === b) {
        return true;
    }
    if (Array.isArray(a) && Array.isArray(b)) {
        return a.length === b.length && a.every((item, i) => equalJson(item, b[i]));
    }
    if (!isObject(a) || !isObject(b)) {
        return false;
    }
    const names = new Set([...Object.keys(a), ...Object.keys(b)]);
    return [...names].every((name) => equalJson(a[name], b[name]));
}
