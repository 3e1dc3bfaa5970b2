// SPDX-License-Identifier: MIT
// Parametric surfaces: their letters, the numbers that stand for a node's own, and what hangs on them.
import { expect, test } from "vitest";
import { matters, numberParam } from "../src/model/schema.ts";
import {
    lettersOf,
    readSurface,
    type Surface,
    withNumbers,
    withRange,
    withText,
} from "../src/model/surface.ts";

const surface = (x: string, y: string, z: string, ranges = {}): Surface => ({
    texts: { x, y, z },
    ranges,
});

test("the parameters are the two letters of the texts", () => {
    expect(lettersOf(surface("u*v", "u", "v^2", { s: [0, 1], t: [0, 1] }))).toEqual(["u", "v"]);
    expect(lettersOf(surface("cos(2t)", "1", "sin(t)", { t: [0, 1], v: [0, 1] }))).toEqual([
        "t",
        "v",
    ]);
    expect(lettersOf(surface("1", "2", "3"))).toEqual(["s", "t"]);
    /* Three: as it was. */
    expect(lettersOf(surface("s*t*u", "2", "3", { s: [0, 1], t: [0, 1] }))).toEqual(["s", "t"]);
});

test("one text or one range is replaced, and the rest stays", () => {
    const value = { x: "s", y: "t", z: "s*t", s: [0, 1], t: [2, 3] } as const;
    expect(withText(value, "y", "t^2")).toEqual({ ...value, y: "t^2" });
    const { s: _s, t: _t, ...texts } = value;
    const inU = { ...texts, x: "u", s: undefined, t: [2, 3], u: [-1, 1] };
    expect(withText({ ...value, z: "t" }, "x", "u")).toEqual({ ...inU, z: "t" });
    expect(withRange(value, "t", ([low, high]) => [low, high + 1])).toEqual({
        ...value,
        t: [2, 4],
    });
    expect(withRange(value, "t", () => [3, 3])).toBe(value);
    expect(withRange(value, "u", () => [0, 5])).toBe(value);
});

test("a surface or a range that is not there yet begins with what would be shown", () => {
    const empty = { x: "", y: "", z: "" };
    expect(withText({}, "y", "u")).toEqual({ ...empty, y: "u", s: [-1, 1], u: [-1, 1] });
    expect(withRange({}, "t", () => [0, 1])).toEqual({ ...empty, s: [-1, 1], t: [0, 1] });
    const unset = { x: "u", y: "v", z: "1", u: [0, 2] } as const;
    expect(withRange(unset, "v", ([low, high]) => [low, 3 * high])).toEqual({
        ...unset,
        v: [-1, 3],
    });
});

test("a node's own letters become numbers, and no others", () => {
    const texts = withNumbers({ x: "2a*cos(t)", y: "abs(a - b)", z: "a1 + s" }, { a: -0.5, b: 2 });
    expect(texts).toEqual({ x: "2(-0.5)*cos(t)", y: "abs((-0.5) - (2))", z: "a1 + s" });
    const long = withNumbers({ x: "a*s", y: "b", z: "constructor" }, { a: 0.1 + 0.2, b: -1 / 3 });
    expect(long).toEqual({ x: "(0.3)*s", y: "(-0.333333333333333)", z: "constructor" });
});

test("a letter matters where a part has it", () => {
    const rows = [
        numberParam("a", { when: { name: "surface", value: "a", test: "~" } }),
        { ...numberParam("surface", {}), type: "surface" as const, default: {} },
    ];
    const [row] = rows;
    const values = (x: string) => ({ surface: { x, y: "s", z: "t" } });
    expect(row && matters(rows, values("2a*s"), row)).toBe(true);
    expect(row && matters(rows, values("abs(s)"), row)).toBe(false);
    expect(row && matters(rows, {}, row)).toBe(false);
    expect(readSurface({})).toBeNull();
});
