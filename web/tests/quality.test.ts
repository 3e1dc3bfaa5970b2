// SPDX-License-Identifier: MIT
// The badge of an equation: what is read of the server's answer, and what it says.
import { expect, test } from "vitest";
import { type Quality, readQuality } from "../src/link/qualityRest.ts";
import { qualityTexts } from "../src/ui/fields/qualityTexts.ts";

const row = (members: object) => readQuality({ rays: 400, unresolved: 0, ...members });
const said = (members: object) => qualityTexts(row(members) as Quality);

test("polynomials have a degree", () => {
    const { words, note } = said({ quality: "exact polynomial", degree: 6 });
    expect(words).toBe("Exact polynomial of degree 6");
    expect(note).toBeUndefined();
});

test("a share is told that was counted, and none else", () => {
    expect(said({ quality: "safe" }).words).toBe("Safe");
    const some = said({ quality: "safe", unresolved: 51 });
    expect(some.words).toBe("Safe, 13 % unresolved");
    expect(some.note).toMatch(/^51 of 400 rays /);
    expect(said({ quality: "safe", unresolved: 1 }).words).toBe("Safe, below 1 % unresolved");
});

test("a pole and a jump have their place", () => {
    const pole = said({ quality: "unsafe", pole: [0.5, -0.12345, 0] });
    expect(pole.words).toBe("Unsafe: pole at (0.5, −0.123, 0)");
    expect(pole.doc).toMatch(/through infinity/);
    const jump = said({ quality: "unsafe", jump: [0, 1, 2] });
    expect(jump.words).toBe("Unsafe: jump at (0, 1, 2)");
});

test("nothing is said of what is unknown", () => {
    expect(row({ quality: "unknown" })).toBeNull();
    expect(row({ quality: "splendid" })).toBeNull();
    expect(readQuality(undefined)).toBeNull();
});
