/* SPDX-License-Identifier: MIT */
import { expect, test } from "vitest";
import { numberParam } from "../src/model/schema.ts";
import {
    fromHex,
    parseInUnit,
    parseNumber,
    parseVector,
    printInUnit,
    printNumber,
    scrubStep,
    snap,
    splitStrength,
    tidy,
    tidyAngle,
    toHex,
} from "../src/model/units.ts";
import { displayOf } from "../src/ui/fields/display.ts";
import { random } from "./fixture.ts";

test.each([
    ["1/3", 1 / 3],
    ["pi/4", Math.PI / 4],
    ["2*(1+3)", 8],
    ["-2^2", -4],
    ["2^-1", 0.5],
    [" 1e-3 ", 0.001],
    [".5", 0.5],
    ["1,5", 1.5],
    ["sqrt(2)/2", Math.SQRT1_2],
    ["+=0.1", 2.1],
    ["-=1", 1],
    ["*2", 4],
    ["/4", 0.5],
    ["*=1/2", 1],
    ["-1", -1],
])("%s is a number", (text, value) => {
    expect(parseNumber(text, 2)).toBeCloseTo(value, 12);
});

test.each(["", "abc", "1+", "(1", "1)", "1 2", "1/0", "--", "*", "/0", "0x10", "1e", "Infinity"])(
    "%s is no number",
    (text) => {
        expect(parseNumber(text, 2)).toBeNull();
    },
);

test.each([
    ["15", 15],
    ["15°", 15],
    ["15 deg", 15],
    ["0.5rad", 0.5 / (Math.PI / 180)],
    ["pi/12", 15],
    ["+=15", 60],
    ["*2", 90],
])("%s is an angle", (text, degrees) => {
    const radians = (degrees * Math.PI) / 180;
    expect(parseInUnit(text, "angle", Math.PI / 4)).toBeCloseTo(radians, 12);
    expect(parseInUnit(text, "degrees", 45)).toBeCloseTo(degrees, 10);
});

test("numbers print with at most six digits and read back", () => {
    expect(printNumber(1 / 3)).toBe("0.333333");
    expect(printNumber(-0)).toBe("0");
    expect(printInUnit(Math.PI / 12, "angle")).toBe("15°");
    expect(printInUnit(45, "degrees")).toBe("45°");
    const next = random(1);
    for (let i = 0; i < 1000; i++) {
        const x = (next() - 0.5) * 10 ** Math.floor(next() * 12 - 6);
        expect(parseNumber(printNumber(x), 0)).toBe(tidy(x));
        const degrees = parseInUnit(printInUnit(x, "angle"), "angle", 0) ?? Number.NaN;
        expect(Math.abs(degrees - x)).toBeLessThanOrEqual(1e-5 * Math.abs(x));
    }
});

const TURN = displayOf(numberParam("turn", { unit: "angle" }));

test("degrees survive the way to the document and back", () => {
    for (let degrees = -720; degrees <= 720; degrees += 0.5) {
        const radians = TURN.parse(String(degrees), 0) ?? Number.NaN;
        expect(radians).toBe(degrees * (Math.PI / 180));
        expect(TURN.print(radians)).toBe(`${degrees}°`);
        expect(tidyAngle(radians)).toBe(radians);
    }
    expect(TURN.parse("90", 0)).toBe(Math.PI / 2);
    expect(TURN.parse("pi/4", 0)).toBe(Math.PI / 4);
    expect(TURN.parse("0.5rad", 0)).toBe(0.5);
    expect(TURN.parse("+=0.1", TURN.parse("89.9", 0) ?? 0)).toBe(Math.PI / 2);
    expect(TURN.arrow(Math.PI / 2, 1, { coarse: false, fine: false })).toBe((91 * Math.PI) / 180);
    expect(tidyAngle(-1e-17)).toBe(0);
});

test("0 is a word where it stands for something else", () => {
    const depth = displayOf(numberParam("depth", { zero: "auto" }));
    expect([depth.print(0), depth.print(2), depth.full(0)]).toEqual(["auto", "2", "auto"]);
    expect([depth.parse("auto", 3), depth.parse("0", 3)]).toEqual([0, 0]);
    expect(displayOf(numberParam("x")).parse("auto", 3)).toBeNull();
});

test("what a field has no room for is told whole", () => {
    expect(TURN.full(1.5708)).toBe("90.0002104591°");
    expect(displayOf(numberParam("x")).full(-1.2345678)).toBe("-1.2345678");
});

test.each([
    ["1 2 3", [1, 2, 3]],
    ["0.1 0.6 0.2", [0.1, 0.6, 0.2]],
    ["[1,2,3]", [1, 2, 3]],
    ["(1/2; -1; 0)", [0.5, -1, 0]],
    ["1, 2.5, 3", [1, 2.5, 3]],
    ["1,5 2,5 3", [1.5, 2.5, 3]],
])("%s is a vector", (text, vector) => {
    expect(parseVector(text)).toEqual(vector);
});

test.each(["0 90 -45", "0° 90° -45°", "[0 deg, 90 °, -45 DEG]", "(0; pi/2; -pi/4)"])(
    "%s are angles",
    (text) => {
        const angles = parseVector(text, 3, (part) => TURN.parse(part, Number.NaN));
        expect(angles).toEqual([0, Math.PI / 2, -Math.PI / 4]);
    },
);

test("two or four numbers are no vector", () => {
    expect(parseVector("1 2")).toBeNull();
    expect(parseVector("1 2 3 4")).toBeNull();
});

test("scrubbing steps by a hundredth of the decade", () => {
    expect(scrubStep(0)).toBeCloseTo(0.001);
    expect(scrubStep(0.5)).toBeCloseTo(0.001);
    expect(scrubStep(-42)).toBeCloseTo(0.1);
    expect(snap(0.123, 0.05)).toBe(0.1);
});

test("every colour of the screen survives the way to linear and back", () => {
    for (let byte = 0; byte < 256; byte++) {
        const hex = `#${byte.toString(16).padStart(2, "0").repeat(3)}`;
        expect(toHex(fromHex(hex) ?? [9, 9, 9])).toBe(hex);
    }
    expect(fromHex("#fff")).toEqual([1, 1, 1]);
    expect(fromHex("808080")?.[0]).toBeCloseTo(0.21586, 5);
    expect(fromHex("#12345")).toBeNull();
    expect(toHex([4, -1, 0])).toBe("#ff0000");
    expect(splitStrength([4, 2, 0])).toEqual({ base: [1, 0.5, 0], strength: 4 });
});
