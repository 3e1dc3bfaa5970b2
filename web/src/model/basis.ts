/* SPDX-License-Identifier: MIT */
/* A Groebner basis while the server makes it: what was asked, each step, the answer. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "./json.ts";

/* Members of the schema's `ideal`. */
export type Asked = Readonly<Record<string, string | number>>;

export const OUTCOMES = ["added", "zero", "coprime", "chain"] as const;
export type Outcome = (typeof OUTCOMES)[number];

export interface Step {
    readonly pair: readonly [number, number];
    readonly outcome: Outcome;
    readonly degree: number;
    readonly divisions: number;
    /* Pairs left. */
    readonly waiting: number;
    /* Of one that was added: its number, its leading monomial, its number of terms. */
    readonly element: number | null;
    readonly leading: string;
    readonly terms: number;
}

export interface Element {
    readonly text: string;
    readonly leading: string;
    readonly terms: number;
    readonly degree: number;
}

export interface Division {
    readonly scale: string;
    readonly quotients: readonly string[];
    readonly rest: string;
}

export interface Answer {
    readonly letters: readonly string[];
    readonly basis: readonly Element[];
    /* null: no letter was to be eliminated. */
    readonly elimination: readonly Element[] | null;
    readonly division: Division | null;
    /* Pairs by outcome, `made`, `divisions`, `degree`. */
    readonly counts: Readonly<Record<string, number>>;
    readonly ms: number;
}

export interface Failure {
    readonly place: string;
    readonly message: string;
    /* In the text at `place`, from 1; null: not in a text. */
    readonly line: number | null;
    readonly column: number | null;
}

export type BasisState = "waiting" | "running" | "done" | "failed" | "cancelled";

export interface Basis {
    readonly state: BasisState;
    readonly steps: readonly Step[];
    readonly answer: Answer | null;
    readonly failure: Failure | null;
}

export const NEW_BASIS: Basis = { state: "waiting", steps: [], answer: null, failure: null };

export function isOver({ state }: Basis): boolean {
    return state !== "waiting" && state !== "running";
}

function readStep(json: JsonObject): Step {
    const [i, j] = listOf(json.pair).map((one) => numberOf(one));
    return {
        pair: [i ?? 0, j ?? 0],
        outcome: textOf(json.outcome) as Outcome,
        degree: numberOf(json.degree),
        divisions: numberOf(json.divisions),
        waiting: numberOf(json.waiting),
        element: typeof json.element === "number" ? json.element : null,
        leading: textOf(json.leading),
        terms: numberOf(json.terms),
    };
}

function readElements(json: Json | undefined): Element[] {
    return listOf(json)
        .filter(isObject)
        .map((one) => ({
            text: textOf(one.text),
            leading: textOf(one.leading),
            terms: numberOf(one.terms),
            degree: numberOf(one.degree),
        }));
}

function readAnswer(json: JsonObject): Answer {
    const counts = isObject(json.counts) ? json.counts : {};
    return {
        letters: listOf(json.letters).map((letter) => textOf(letter)),
        basis: readElements(json.basis),
        elimination: json.elimination === undefined ? null : readElements(json.elimination),
        division:
            json.rest === undefined
                ? null
                : {
                      scale: textOf(json.scale),
                      quotients: listOf(json.quotients).map((one) => textOf(one)),
                      rest: textOf(json.rest),
                  },
        counts: Object.fromEntries(
            Object.entries(counts).map(([name, count]) => [name, numberOf(count)]),
        ),
        ms: numberOf(json.cpu_ms),
    };
}

function readFailure(json: JsonObject): Failure {
    return {
        place: textOf(json.place),
        message: textOf(json.message),
        line: typeof json.line === "number" ? json.line : null,
        column: typeof json.column === "number" ? json.column : null,
    };
}

/* What the server tells of it: the steps behind those that are known, and where they lead. */
export function advance(basis: Basis, json: Json): Basis {
    const told = isObject(json) ? json : {};
    return {
        state: textOf(told.state, "failed") as BasisState,
        steps: [...basis.steps, ...listOf(told.steps).filter(isObject).map(readStep)],
        answer: isObject(told.answer) ? readAnswer(told.answer) : null,
        failure: isObject(told.error) ? readFailure(told.error) : null,
    };
}

/* Pairs by outcome so far. */
export function countOutcomes(steps: readonly Step[]): Record<Outcome, number> {
    const counts = { added: 0, zero: 0, coprime: 0, chain: 0 };
    for (const { outcome } of steps) {
        counts[outcome] += 1;
    }
    return counts;
}

/* The leading term of a polynomial's text, and the rest of it. */
export function splitLeading(text: string): readonly [string, string] {
    const at = text.search(/ [+-] /);
    return at < 0 ? [text, ""] : [text.slice(0, at), text.slice(at)];
}

export interface IdealExample {
    readonly name: string;
    readonly asked: Asked;
}

/* Ideals that show something: elimination, intersection, many pairs, criteria that save most. */
export const IDEALS: readonly IdealExample[] = [
    {
        name: "Whitney's umbrella, s and t eliminated",
        asked: { generators: "x = s*t\ny = s\nz = t^2", eliminate: 2 },
    },
    {
        name: "Sphere by a fraction: q stands for 1/(1 + s² + t²)",
        asked: {
            generators:
                "(1+s^2+t^2)*x = 2*s\n(1+s^2+t^2)*y = 2*t\n(1+s^2+t^2)*z = 1-s^2-t^2\n(1+s^2+t^2)*q = 1",
            letters: "q s t x y z",
            eliminate: 3,
            strategy: "sugar",
        },
    },
    {
        name: "Where three surfaces meet, letter by letter",
        asked: { generators: "x^2+y^2+z^2 = 1\nx^2+z^2 = y\nx = z", order: "lex" },
    },
    {
        name: "Twisted cubic, and a polynomial divided by its basis",
        asked: { generators: "y = x^2\nz = x^3", divide: "x*z - y^2 + x" },
    },
    {
        name: "Five cyclic roots",
        asked: {
            generators:
                "a+b+c+d+f\na*b+b*c+c*d+d*f+f*a\na*b*c+b*c*d+c*d*f+d*f*a+f*a*b\n" +
                "a*b*c*d+b*c*d*f+c*d*f*a+d*f*a*b+f*a*b*c\na*b*c*d*f = 1",
            strategy: "sugar",
        },
    },
];
