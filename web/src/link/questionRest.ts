/* SPDX-License-Identifier: MIT */
/* Questions of the algebra over REST: begun, looked at until they are over, cancelled. */
import { isObject, type Json, type JsonObject, numberOf, textOf } from "../model/json.ts";
import type { Request } from "./rest.ts";

const LOOK_MS = 150;
const BEGINNINGS = { groebner: "/v1/groebner", implicitize: "/v1/implicitize?wait=no" } as const;
export type Road = keyof typeof BEGINNINGS;

const pause = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, LOOK_MS));

async function jsonOf(response: Promise<Response>): Promise<JsonObject> {
    const json = (await (await response).json()) as Json;
    return isObject(json) ? json : {};
}

/* Calls `tell` with the state, and the steps that it has not been told; the last time when it is
 * over. The signal cancels it: nothing is told from then on. */
export async function followQuestion(
    request: Request,
    road: Road,
    asked: JsonObject,
    tell: (told: JsonObject) => void,
    signal: AbortSignal,
): Promise<void> {
    const body = JSON.stringify(asked);
    const { id } = await jsonOf(request(BEGINNINGS[road], { method: "POST", body }));
    const path = `/v1/${road}/${textOf(id)}`;
    /* Also when the page is being left. */
    const cancel = (): void => {
        request(path, { method: "DELETE", keepalive: true }).catch(() => undefined);
    };
    if (signal.aborted) {
        cancel();
        return;
    }
    signal.addEventListener("abort", cancel, { once: true });
    for (let from = 0, over = false; !over; ) {
        const told = await jsonOf(request(`${path}?from=${from}`));
        if (signal.aborted) {
            return;
        }
        from = numberOf(told.next);
        over = told.state !== "waiting" && told.state !== "running";
        tell(told);
        if (!over) {
            await pause();
        }
    }
    signal.removeEventListener("abort", cancel);
}
