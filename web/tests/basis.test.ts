/* SPDX-License-Identifier: MIT */
/* What the server tells of a Groebner basis, and what the page makes of it. */
import { expect, test } from "vitest";
import {
    advance,
    countOutcomes,
    IDEALS,
    isOver,
    NEW_BASIS,
    splitLeading,
} from "../src/model/basis.ts";

const step = (i: number, j: number, outcome: string, more = {}) => ({
    pair: [i, j],
    outcome,
    degree: 3,
    sugar: 3,
    divisions: 1,
    waiting: 2,
    ...more,
});

test("steps come in pieces, and the answer at the end", () => {
    const first = advance(NEW_BASIS, {
        state: "running",
        steps: [step(0, 1, "added", { element: 2, leading: "x^2", terms: 3 })],
        next: 1,
    });
    expect(isOver(first)).toBe(false);
    expect(first.steps[0]).toMatchObject({ pair: [0, 1], element: 2, leading: "x^2", terms: 3 });
    const last = advance(first, {
        state: "done",
        steps: [step(1, 2, "coprime"), step(0, 2, "zero")],
        next: 3,
        answer: {
            letters: ["x"],
            basis: [{ text: "x", leading: "x", terms: 1, degree: 1 }],
            counts: { made: 3 },
            cpu_ms: 2,
        },
    });
    expect(isOver(last)).toBe(true);
    expect(countOutcomes(last.steps)).toEqual({ added: 1, zero: 1, coprime: 1, chain: 0 });
    expect(last.steps[1]?.element).toBe(null);
    expect(last.answer).toMatchObject({ elimination: null, division: null, counts: { made: 3 } });
});

test("an elimination ideal of nothing is not the absence of one; an error keeps its place", () => {
    const empty = advance(NEW_BASIS, {
        state: "done",
        steps: [],
        answer: { basis: [], elimination: [] },
    });
    expect(empty.answer?.elimination).toEqual([]);
    const error = { code: "invalid", place: "/generators", message: "no", line: 2, column: 5 };
    const failed = advance(NEW_BASIS, { state: "failed", steps: [], error });
    expect(failed.failure).toEqual({ place: "/generators", message: "no", line: 2, column: 5 });
    expect(advance(NEW_BASIS, null).state).toBe("failed");
});

test("the leading term is what stands before the first sum", () => {
    expect(splitLeading("4*z^4 + 2*z^2 - 1")).toEqual(["4*z^4", " + 2*z^2 - 1"]);
    expect(splitLeading("-x - y")).toEqual(["-x", " - y"]);
    expect(splitLeading("x")).toEqual(["x", ""]);
});

test("examples have names of their own", () => {
    expect(new Set(IDEALS.map(({ name }) => name)).size).toBe(IDEALS.length);
});
