/* SPDX-License-Identifier: MIT */
/* The REST side of Groebner bases: begun, looked at, cancelled. */
import type { Asked } from "../model/basis.ts";
import { isObject, type Json, textOf } from "../model/json.ts";
import type { Request } from "./rest.ts";

/* The id of a basis that the server begins. */
export async function beginBasis(request: Request, asked: Asked): Promise<string> {
    const body = JSON.stringify(asked);
    const json = (await (await request("/v1/groebner", { method: "POST", body })).json()) as Json;
    return isObject(json) ? textOf(json.id) : "";
}

/* Its state, with the steps from number `from` on: for `advance` of model/basis.ts. */
export async function lookAtBasis(request: Request, id: string, from: number): Promise<Json> {
    return (await (await request(`/v1/groebner/${id}?from=${from}`)).json()) as Json;
}

export async function cancelBasis(request: Request, id: string): Promise<void> {
    /* Also when the page is being left. */
    await request(`/v1/groebner/${id}`, { method: "DELETE", keepalive: true });
}
