/* SPDX-License-Identifier: MIT */
/* How well equations are drawn: GET /v1/scenes/{id}/equations. */
import { isObject, type Json, listOf, numberOf, textOf } from "../model/json.ts";
import type { Rest } from "./rest.ts";

export interface Quality {
    readonly quality: "exact polynomial" | "safe" | "unsafe";
    readonly degree: number;
    /* Where an unsafe one changes its sign without being 0. */
    readonly breaks: "pole" | "jump" | null;
    readonly at: readonly number[];
    readonly rays: number;
    readonly unresolved: number;
}

const QUALITIES = ["exact polynomial", "safe", "unsafe"] as const;

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
