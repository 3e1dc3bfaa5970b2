/* SPDX-License-Identifier: MIT */
/* Equations as MathML, or what is wrong with their texts: POST /v1/typeset. */

import type { Fault } from "../model/faults.ts";
import { isObject, type Json, listOf, numberOf, textOf } from "../model/json.ts";
import type { Request } from "./rest.ts";

/* What a text is an equation of: a shape, a shader's function, a part of a surface. */
export type TypesetForm = "equation" | "function" | "expression";

export interface Typeset {
    /* MathML: the definitions, then the equation; empty: it cannot be read. */
    readonly lines: readonly string[];
    readonly faults: readonly Fault[];
}

export function readTypeset(answer: Json): Typeset {
    const json = isObject(answer) ? answer : {};
    return {
        lines: listOf(json.lines).map((line) => textOf(line)),
        faults: listOf(json.errors)
            .filter(isObject)
            .map(({ line, column, message }) => ({
                line: numberOf(line, 1),
                column: numberOf(column, 1),
                message: textOf(message),
            })),
    };
}

export async function typeset(
    request: Request,
    text: string,
    form: TypesetForm,
    signal: AbortSignal,
): Promise<Typeset> {
    const body = JSON.stringify({ text, form });
    const response = await request("/v1/typeset", { method: "POST", body, signal });
    return readTypeset((await response.json()) as Json);
}
