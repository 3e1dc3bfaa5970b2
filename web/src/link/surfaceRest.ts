/* SPDX-License-Identifier: MIT */
/* Equations of parametric surfaces over REST: found step by step, and proved. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "../model/json.ts";
import { followQuestion } from "./questionRest.ts";
import { type Request, RestError } from "./rest.ts";

/* How much of an implicit surface a patch is, in words, and from 0 to 1; null: nobody knows. */
export interface Coverage {
    readonly text: string;
    readonly share: number;
}

/* The equation of a parametric surface. */
export interface Implicit {
    readonly equation: string;
    /* Whether a node can hold it; `why` not. */
    readonly drawable: boolean;
    readonly why: string;
    readonly degree: number;
    readonly terms: number;
    /* The two letters that the texts are in. */
    readonly letters: readonly string[];
    readonly coverage: Coverage | null;
}

/* What the search has found last, and after how long. */
export interface SearchStep {
    readonly text: string;
    readonly ms: number;
}

/* Whether an equation is that of the parametric surface beside it. */
export interface Proof {
    readonly verdict: string;
    readonly reason: string;
    readonly coverage: Coverage | null;
}

function readCoverage(json: Json | undefined): Coverage | null {
    return isObject(json) ? { text: textOf(json.text), share: numberOf(json.share, 1) } : null;
}

function readImplicit(json: JsonObject): Implicit {
    const certificate = isObject(json.certificate) ? json.certificate : {};
    return {
        equation: textOf(json.equation),
        drawable: json.drawable === true,
        why: textOf(json.why),
        degree: numberOf(certificate.degree),
        terms: numberOf(certificate.terms),
        letters: listOf(certificate.letters).map((letter) => textOf(letter)),
        coverage: readCoverage(json.coverage),
    };
}

function readProblem(json: JsonObject): RestError {
    const place = textOf(json.place);
    const number = (value: Json | undefined) => (typeof value === "number" ? value : null);
    return new RestError(
        422,
        textOf(json.code),
        place && !place.startsWith("/") ? `/${place}` : place,
        textOf(json.message),
        number(json.line),
        number(json.column),
    );
}

/* Throws a RestError where there is none. null: it was cancelled. */
export async function implicitize(
    request: Request,
    asked: JsonObject,
    tell: (step: SearchStep) => void,
    signal: AbortSignal,
): Promise<Implicit | null> {
    let last: JsonObject = {};
    await followQuestion(
        request,
        "implicitize",
        asked,
        (told) => {
            last = told;
            const step = listOf(told.steps).filter(isObject).at(-1);
            if (step) {
                tell({ text: textOf(step.text), ms: numberOf(step.ms) });
            }
        },
        signal,
    );
    if (isObject(last.error)) {
        throw readProblem(last.error);
    }
    return !signal.aborted && isObject(last.answer) ? readImplicit(last.answer) : null;
}

/* `params` of an `implicit`. */
export async function verify(
    request: Request,
    params: JsonObject,
    signal: AbortSignal,
): Promise<Proof> {
    const body = JSON.stringify(params);
    const response = await request("/v1/verify", { method: "POST", body, signal });
    const json = (await response.json()) as Json;
    const answer = isObject(json) ? json : {};
    return {
        verdict: textOf(answer.verdict),
        reason: textOf(answer.reason),
        coverage: readCoverage(answer.coverage),
    };
}
