// SPDX-License-Identifier: MIT
// Faults of a typed text: the parts of its lines that are shown, and what is read of the server's answer.
import { expect, test } from "vitest";
import { readTypeset } from "../src/link/typesetRest.ts";
import { markedLines, messagesOf } from "../src/model/faults.ts";

/* Each line as one text, with brackets around what is marked. */
const marked = (text: string, ...places: [number, number][]) =>
    markedLines(
        text,
        places.map(([line, column]) => ({ line, column })),
    ).map((pieces) => pieces.map((one) => (one.wrong ? `[${one.text}]` : one.text)).join(""));

test("a letter is marked, of a name all letters, behind the end a blank", () => {
    expect(marked("x + * y", [1, 5])).toEqual(["x + [*] y"]);
    expect(marked("sine(x) + y", [1, 1])).toEqual(["[sine](x) + y"]);
    expect(marked("x + (y", [1, 7])).toEqual(["x + (y[ ]"]);
    expect(marked("", [1, 1])).toEqual(["[ ]"]);
});

test("several on a line are marked in it, others in lines of their own", () => {
    expect(marked("q + w\nx\n+ k", [1, 5], [3, 3], [1, 1])).toEqual(["[q] + [w]", "+ [k]"]);
    expect(marked("qq + w", [1, 1], [1, 1], [1, 2])).toEqual(["[qq] + w"]);
});

test("of a long line the parts around marks are shown", () => {
    const long = (letter: string) => letter.repeat(40);
    expect(marked(`${long("+")}q${long("-")}w${long("*")}`, [1, 41], [1, 82])).toEqual([
        `…${"+".repeat(14)}[q]${"-".repeat(14)}…${"-".repeat(14)}[w]${"*".repeat(14)}…`,
    ]);
    expect(marked(`q${"-".repeat(20)}w`, [1, 1], [1, 22])).toEqual([`[q]${"-".repeat(20)}[w]`]);
});

test("columns count code points", () => {
    expect(marked("𝑥 + π*q", [1, 7])).toEqual(["𝑥 + π*[q]"]);
});

test("an answer has lines or faults; what is said twice is told once", () => {
    expect(readTypeset({ lines: ["<math/>"] })).toEqual({ lines: ["<math/>"], faults: [] });
    const fault = (column: number) => ({ line: 1, column, message: '"q" is no name' });
    const { faults } = readTypeset({ errors: [fault(1), fault(5), { line: 2 }] });
    expect(faults).toEqual([fault(1), fault(5), { line: 2, column: 1, message: "" }]);
    expect(messagesOf(faults.slice(0, 2))).toEqual(['"q" is no name']);
    expect(readTypeset(null)).toEqual({ lines: [], faults: [] });
});
