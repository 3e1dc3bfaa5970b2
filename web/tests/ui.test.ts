/* SPDX-License-Identifier: MIT */
/* What of the page needs no page: changes of text, the plane of points, colours of code, files,
 * parameters in words, and ages. */
import { StringStream } from "@codemirror/language";
import { expect, test } from "vitest";
import { RestError } from "../src/link/rest.ts";
import { findParam, nodeType, type Param } from "../src/model/schema.ts";
import { NO_FRAME, type Statistics } from "../src/model/stores.ts";
import { changeBetween, changesBetween } from "../src/ui/code/change.ts";
import { shaderLanguage } from "../src/ui/code/language.ts";
import { frameOf, type Point, pointAt, ticksOf, toView } from "../src/ui/fields/grid.ts";
import { problemOf, type TextFile, withoutFolder } from "../src/ui/import.ts";
import { defaultOf, rangeOf, topicsOf, typeOf } from "../src/ui/reference/topics.ts";
import { age } from "../src/ui/scenes/age.ts";
import { rateText } from "../src/ui/view/rate.ts";
import { choose, random, SCHEMA } from "./fixture.ts";

const NO_STATISTICS: Statistics = {
    fps: 0,
    state: "still",
    stages: [10],
    receive: 1,
    decode: 1,
    present: 0,
    photonP50: null,
    photonP95: null,
    bytesPerFrame: 0,
    bytesPerSecond: 0,
    dropped: 0,
};

test("the rate is never told higher than it is", () => {
    const state = (fps: number): Parameters<typeof rateText>[0] => ({
        statistics: { ...NO_STATISTICS, fps },
        frame: { ...NO_FRAME, state: "still" },
        compiling: null,
        connection: "live",
    });
    expect(rateText(state(0.5))).toBe("less than 1 fps");
    expect(rateText(state(0.99))).toBe("less than 1 fps");
    expect(rateText(state(1))).toBe("1 fps · 12 ms");
    expect(rateText({ ...state(0.5), frame: { ...NO_FRAME, state: "lossless" } })).toBe("idle");
});

test("one change makes any text of any other", () => {
    const next = random(1);
    const text = () =>
        Array.from({ length: Math.floor(next() * 12) }, () => choose(["a", "b", "\n"], next)).join(
            "",
        );
    for (let i = 0; i < 2000; i++) {
        const [before, after] = [text(), text()];
        const { from, to, insert } = changeBetween(before, after);
        expect(before.slice(0, from) + insert + before.slice(to)).toBe(after);
    }
    expect(changeBetween("abc", "abxc")).toEqual({ from: 2, to: 2, insert: "x" });
});

test("texts become others by changes that leave the lines between them alone", () => {
    const line = (n: number) => `line ${n}\n`;
    for (let seed = 0; seed < 200; seed++) {
        const next = random(seed);
        const before = Array.from({ length: 12 }, () => line(Math.floor(next() * 20)));
        const after = before.flatMap((text) =>
            choose([[text], [text], [text], [], [text, line(99)], ["new"]], next),
        );
        const changes = changesBetween(before.join(""), after.join(""));
        let made = before.join("");
        for (const { from, to, insert } of [...changes].reverse()) {
            made = made.slice(0, from) + insert + made.slice(to);
        }
        expect(made).toBe(after.join(""));
    }
    expect(changesBetween("a\nb 1\nc\nd 1\n", "a\nb 2\nc\nd 2\n")).toEqual([
        { from: 4, to: 5, insert: "2" },
        { from: 10, to: 11, insert: "2" },
    ]);
});

test("all points and the origin are in sight, and come back from the drawing", () => {
    const next = random(2);
    for (let i = 0; i < 200; i++) {
        const size = 10 ** (next() * 6 - 3);
        const points = Array.from({ length: 3 }, (): Point => [next() * size, -next() * size]);
        const frame = frameOf(points);
        for (const point of [...points, [0, 0] as Point]) {
            const [x, y] = toView(frame, point);
            expect(x).toBeGreaterThan(0);
            expect(x).toBeLessThan(frame.width);
            expect(y).toBeGreaterThan(0);
            expect(y).toBeLessThan(frame.height);
            const back = pointAt(frame, x / frame.width, y / frame.height);
            expect(Math.hypot(back[0] - point[0], back[1] - point[1])).toBeLessThan(
                1e-9 * size + 1e-12,
            );
        }
        const ticks = ticksOf(frame, 0);
        expect(ticks.length).toBeGreaterThan(2);
        expect((ticks[1] ?? 0) - (ticks[0] ?? 0)).toBeGreaterThan(17);
    }
    expect(frameOf([]).scale).toBeGreaterThan(0);
});

/* Words of a text with their kinds, line by line. */
function coloured(text: string, declared: readonly string[] = []): string[] {
    const language = shaderLanguage(() => new Set(declared));
    const state = language.startState?.(4) ?? { inside: false };
    return text.split("\n").flatMap((line) => {
        const stream = new StringStream(line, 4, 4);
        const found: string[] = [];
        while (!stream.eol()) {
            stream.start = stream.pos;
            const kind = language.token(stream, state);
            if (kind) {
                found.push(`${stream.current()}:${kind}`);
            }
        }
        return found;
    });
}

test("code has its colours", () => {
    expect(coloured("float d = radius * 1.5e-3; // half", ["radius"])).toEqual([
        "float:typeName",
        "radius:variableName.special",
        "1.5e-3:number",
        "// half:comment",
    ]);
    expect(coloured("return lerp(a, float3x3(x), 0x1fu);")).toEqual([
        "return:keyword",
        "lerp:variableName.function",
        "float3x3:typeName",
        "0x1fu:number",
    ]);
    expect(coloured("/* a\nb */ int")).toEqual(["/* a:comment", "b */:comment", "int:typeName"]);
});

const file = (path: string, text = "a\nb\nc\nd\ne\nf"): TextFile => ({ path, text });

test("a refused file shows what stands around the place", () => {
    const error = new RestError(400, "syntax", "models/a.json", "expected ,", 2, 3);
    const problem = problemOf(error, [file("b.json"), file("models/a.json")]);
    expect(problem).toMatchObject({ file: "models/a.json", line: 2, column: 3, from: 1 });
    expect(problem.excerpt).toEqual(["a", "b", "c", "d"]);
    const place = new RestError(422, "invalid", "/nodes/a/radius", "too big");
    expect(problemOf(place, [file("one.json")])).toMatchObject({
        file: "one.json",
        message: "/nodes/a/radius: too big",
        excerpt: [],
    });
    expect(problemOf(place, [file("one.json"), file("two.json")]).file).toBe("");
});

test("the folder around all files is no part of their names", () => {
    const paths = (...names: string[]) =>
        withoutFolder(names.map((n) => file(n))).map((f) => f.path);
    expect(paths("x/a.json", "x/m/b.json")).toEqual(["a.json", "m/b.json"]);
    expect(paths("a.json", "m/b.json")).toEqual(["a.json", "m/b.json"]);
});

test("parameters in words", () => {
    const param = (type: string, name: string): Param => {
        const found = findParam(nodeType(SCHEMA, type)?.params ?? [], name);
        if (!found) {
            throw new Error(`no ${type} ${name}`);
        }
        return found;
    };
    expect(rangeOf(param("sphere", "radius"))).toBe("0 to 1000, above 0");
    expect(typeOf(param("sphere", "radius"))).toBe("number · length");
    expect(defaultOf(param("box", "size"))).toBe("1, 1, 1");
    expect(rangeOf(param("polygon", "points"))).toBe("3 to 5 points");
    expect(defaultOf(param("polygon", "points"))).toBe("3 of them");
    const topics = topicsOf(SCHEMA);
    expect(new Set(topics.map(({ key }) => key)).size).toBe(topics.length);
    expect(topics.filter(({ node }) => node)).toHaveLength(SCHEMA.nodes.length);
});

test("how long ago, in no unit below a minute", () => {
    const ago = (seconds: number) => age(0, seconds * 1000);
    expect([-90, 0, 44].map(ago)).toEqual(["now", "now", "now"]);
    expect([45, 60, 100].map(ago)).toEqual(["1 minute ago", "1 minute ago", "2 minutes ago"]);
    expect([7200, 86400].map(ago)).toEqual(["2 hours ago", "yesterday"]);
});
