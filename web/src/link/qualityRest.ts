/* SPDX-License-Identifier: MIT */
/* How well equations are drawn: GET /v1/scenes/{id}/equations. */
import { isObject, type Json, listOf, numberOf, textOf } from "../model/json.ts";
import type { Rest } from "./rest.ts";

export interface Quality {
    readonly quality: "exact polynomial" | "safe" | "unsafe" | "sampled";
    readonly degree: number;
    /* Where an unsafe one changes its sign without being 0. */
    readonly breaks: "pole" | "jump" | null;
    readonly at: readonly number[];
    readonly rays: number;
    readonly unresolved: number;
    /* Of a sampled surface: its patches, those that are holes, how far they are off, and whether
     * that is more than half of the thickness; the corners of its box. */
    readonly patches: number;
    readonly leftOut: number;
    readonly error: number;
    readonly thin: boolean;
    readonly box: readonly (readonly number[])[];
}

const QUALITIES = ["exact polynomial", "safe", "unsafe", "sampled"] as const;

/* null: it is unknown. */
export function readQuality(row: Json | undefined): Quality | null {
    const json = isObject(row) ? row : {};
    const quality = QUALITIES.find((one) => one === textOf(json.quality));
    const breaks = json.pole !== undefined ? "pole" : json.jump !== undefined ? "jump" : null;
    return quality === undefined
        ? null
        : {
              quality,
              degree: numberOf(json.degree),
              breaks,
              at: listOf(breaks === null ? [] : json[breaks]).map((number) => numberOf(number)),
              rays: numberOf(json.rays),
              unresolved: numberOf(json.unresolved),
              patches: numberOf(json.patches),
              leftOut: numberOf(json.left_out),
              error: numberOf(json.error),
              thin: json.thin === true,
              box: listOf(json.box).map((corner) =>
                  listOf(corner).map((number) => numberOf(number)),
              ),
          };
}

/* Of a node; null: it has no equation that can be drawn. */
export async function qualityOf(
    { request }: Rest,
    scene: string,
    node: string,
    signal: AbortSignal,
): Promise<Quality | null> {
    const path = `/v1/scenes/${encodeURIComponent(scene)}/equations`;
    const response = await request(`${path}?node=${encodeURIComponent(node)}`, { signal });
    const json = (await response.json()) as Json;
    return readQuality(listOf(isObject(json) ? json.equations : [])[0]);
}
