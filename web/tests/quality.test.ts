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
    expect(some.words).toBe("Safe, 13\u00a0% unresolved");
    expect(some.note).toMatch(/^51 of 400 rays /);
    expect(said({ quality: "safe", unresolved: 1 }).words).toBe("Safe, below 1\u00a0% unresolved");
});

test("a pole and a jump have their place", () => {
    const pole = said({ quality: "unsafe", pole: [0.5, -0.12345, 0] });
    expect(pole.words).toBe("Unsafe: pole at (0.5, −0.123, 0)");
    expect(pole.doc).toMatch(/through infinity/);
    const jump = said({ quality: "unsafe", jump: [0, 1, 2] });
    expect(jump.words).toBe("Unsafe: jump at (0, 1, 2)");
});

test("patches have an error, holes and a thickness", () => {
    const sampled = { quality: "sampled", patches: 1024, error: 2.34e-6 };
    const fine = said(sampled);
    expect(fine.words).toBe("Sampled: 1024 patches, off by 0.000002");
    expect(fine.note).toBeUndefined();
    const holes = said({ ...sampled, left_out: 32 });
    expect(holes.words).toBe("Sampled: 1024 patches, off by 0.000002, 32 left out");
    expect(holes.note).toMatch(/^32 of 1024 patches /);
    expect(said({ ...sampled, error: 0.3, thin: true }).words).toBe(
        "Sampled too coarsely: off by 0.3",
    );
    expect(
        row({
            ...sampled,
            box: [
                [-1, 0, 1],
                [2, 3, 4],
            ],
        })?.box,
    ).toEqual([
        [-1, 0, 1],
        [2, 3, 4],
    ]);
});

test("nothing is said of what is unknown", () => {
    expect(row({ quality: "unknown" })).toBeNull();
    expect(row({ quality: "splendid" })).toBeNull();
    expect(readQuality(undefined)).toBeNull();
});
