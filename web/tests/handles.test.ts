/* SPDX-License-Identifier: MIT */
/* Handles of parameters: where they are seen, and what a drag makes of the value. */
import { expect, test } from "vitest";
import { DEFAULT_CAMERA } from "../src/model/camera.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { dragHandle, type Handle, handleAt, handlesOf } from "../src/model/handles.ts";
import type { JsonObject } from "../src/model/json.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { readSchema } from "../src/model/schema.ts";
import { subtract, toWorld, type Vector } from "../src/model/transform.ts";
import { evaluateNamed } from "../src/model/units.ts";
import { random } from "./fixture.ts";

const param = (name: string, type: string, value: unknown, handle: string, more: JsonObject = {}) =>
    ({
        name,
        type,
        default: value,
        handle,
        unit: "length",
        min: 0,
        max: 100,
        doc: name,
        ...more,
    }) as JsonObject;
const shape = (type: string, params: JsonObject[]): JsonObject => ({
    type,
    group: "primitive",
    doc: type,
    children: "none",
    params,
});
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            shape("sphere", [param("radius", "float", 0.5, "radius, 0, 0")]),
            shape("box", [
                param("size", "vec3", [1, 1, 1], "size.x/2, 0, 0; 0, size.y/2, 0; 0, 0, size.z/2"),
            ]),
            shape("rod", [
                param("b", "vec3", [0, 0.5, 0], "b.x, b.y, b.z", { min: -100 }),
                param("angle", "float", 0.5, "sin(angle), cos(angle), 0", {
                    unit: "angle",
                    max: 3,
                }),
                param("open", "float", 0, "radius/open, 0, 0"),
            ]),
            shape("tower", [param("height", "float", 1, "0, height/2, 0")]),
            {
                ...shape("blend", [param("k", "float", 0.4, "k, 0, 0")]),
                group: "operation",
                children: "many",
            },
        ],
    },
});
const DOCUMENT = readDocument({
    root: {
        id: "root",
        type: "union",
        transform: { rotation: [0.2, 0.5, 0.1], scale: 1.5 },
        children: [
            { id: "ball", type: "sphere", transform: { translation: [0.5, 0.2, 0] } },
            { id: "crate", type: "box", transform: { rotation: [0, 0.4, 0], scale: [1, 2, 1] } },
            { id: "rod", type: "rod" },
            { id: "tower", type: "tower", transform: { rotation: [0.3, 0, 0.4], scale: 2 } },
            { id: "blend", type: "blend", children: [{ id: "in", type: "sphere" }] },
        ],
    },
});
const PROJECTION = projectionOf(
    { ...DEFAULT_CAMERA, position: [2, 2, 6] },
    { width: 900, height: 600 },
);
const of = (id: string): readonly Handle[] =>
    handlesOf(DOCUMENT, SCHEMA, [id], { kind: "nodes" }, PROJECTION);
const named = (id: string, key: string): Handle => {
    const found = of(id).find((handle) => handle.key === key);
    if (!found) {
        throw new Error(`no handle ${key}`);
    }
    return found;
};

/* Where a point of a node's space is seen. */
function seen(id: string, point: Vector): { x: number; y: number } {
    const spot = PROJECTION.spotOf(toWorld(DOCUMENT, id, point));
    if (!spot) {
        throw new Error("behind the camera");
    }
    return spot;
}

test("expressions have names, parts of vectors, functions and powers", () => {
    const names = (name: string): number =>
        ({ radius: 2, "size.y": 3, radius1: 5 })[name] ?? Number.NaN;
    expect(evaluateNamed("radius + size.y/2", names)).toBe(3.5);
    expect(evaluateNamed("-radius1*sqrt(radius^2)", names)).toBe(-10);
    expect(evaluateNamed("sin(pi/2) - cos(0)", names)).toBeCloseTo(0, 12);
    expect(evaluateNamed("width", names)).toBeNaN();
});

test("handles are where the registry says, in the node's space", () => {
    expect(of("ball").map(({ key, spot }) => [key, spot])).toEqual([
        ["radius", seen("ball", [0.5, 0, 0])],
    ]);
    expect(of("crate").map(({ key }) => key)).toEqual(["size.x", "size.y", "size.z"]);
    expect(named("crate", "size.y").spot).toEqual(seen("crate", [0, 0.5, 0]));
    expect(named("rod", "b").spot).toEqual(seen("rod", [0, 0.5, 0]));
});

test("an expression without a value has no handle", () => {
    expect(of("rod").map(({ key }) => key)).toEqual(["b", "angle"]);
});

test("several that are selected, and parts of models, have none", () => {
    expect(handlesOf(DOCUMENT, SCHEMA, ["ball", "crate"], { kind: "nodes" }, PROJECTION)).toEqual(
        [],
    );
});

test("500 random drags give the value whose handle is seen there", () => {
    const next = random(5);
    for (let i = 0; i < 500; i++) {
        const radius = 0.1 + next() * 2;
        const ball = named("ball", "radius");
        const change = dragHandle(ball, PROJECTION, ball.spot, seen("ball", [radius, 0, 0]), false);
        expect(change?.op).toMatchObject({ at: "/nodes/ball/params/radius" });
        expect(change?.op).toHaveProperty("value", Number(radius.toPrecision(6)));

        const angle = 0.05 + next() * 2.2;
        const arc = named("rod", "angle");
        const to = seen("rod", [Math.sin(angle), Math.cos(angle), 0]);
        const turned = dragHandle(arc, PROJECTION, arc.spot, to, false);
        const spot = turned && "value" in turned.op ? Number(turned.op.value) : Number.NaN;
        const got = seen("rod", [Math.sin(spot), Math.cos(spot), 0]);
        expect(Math.hypot(got.x - to.x, got.y - to.y)).toBeLessThan(0.5);
    }
});

test("one number of a vector changes alone, in steps where asked", () => {
    const crate = named("crate", "size.y");
    const to = seen("crate", [0, 0.813, 0]);
    expect(dragHandle(crate, PROJECTION, crate.spot, to, true)).toEqual({
        op: { op: "set", at: "/nodes/crate/params/size", value: [1, 1.6, 1] },
        label: "size.y 1.6",
    });
});

test("a place goes with the pointer at its depth", () => {
    const rod = named("rod", "b");
    const to = { x: rod.spot.x + 60, y: rod.spot.y - 40 };
    const change = dragHandle(rod, PROJECTION, rod.spot, to, false);
    const value = change && "value" in change.op ? (change.op.value as unknown as Vector) : null;
    const got = value && seen("rod", value);
    expect(got && Math.hypot(got.x - to.x, got.y - to.y)).toBeLessThan(0.01);
    const depth = (point: Vector): number => {
        const way = subtract(toWorld(DOCUMENT, "rod", point), [2, 2, 6]);
        return way.reduce((sum, x, i) => sum + x * (PROJECTION.forward[i] ?? 0), 0);
    };
    expect(depth(value ?? [9, 9, 9])).toBeCloseTo(depth([0, 0.5, 0]), 4);
});

test("values stay within their limits", () => {
    const ball = named("ball", "radius");
    const change = dragHandle(ball, PROJECTION, ball.spot, seen("ball", [-1, 0, 0]), false);
    expect(change?.op).toHaveProperty("value", 0);
});

test("the nearest handle within reach is taken", () => {
    const handles = of("crate");
    const wanted = named("crate", "size.z");
    expect(handleAt(handles, { x: wanted.spot.x + 3, y: wanted.spot.y }, 8)?.key).toBe("size.z");
    expect(handleAt(handles, { x: 5, y: 5 }, 8)).toBeNull();
});

/* --- looks --- */

const angleOf = (a: Spot, b: Spot): number => Math.atan2(b.y - a.y, b.x - a.x);

test("a length is an arrow along the way that it grows, a radius a dot, a place a place", () => {
    expect(named("ball", "radius").look).toEqual({ kind: "dot" });
    expect(named("rod", "b").look).toEqual({ kind: "place" });
    for (const [id, key, more] of [
        ["tower", "height", [0, 0.6, 0]],
        ["crate", "size.y", [0, 0.6, 0]],
        ["crate", "size.x", [0.6, 0, 0]],
    ] as const) {
        const { look, spot } = named(id, key);
        const tail = look.kind === "arrow" ? look.tail : spot;
        expect(angleOf(tail, spot)).toBeCloseTo(angleOf(spot, seen(id, more as Vector)), 1);
        const far = Math.hypot(tail.x - spot.x, tail.y - spot.y);
        expect(far > 5 && far < 21).toBe(true);
    }
});

test("an arrow that points at the viewer is a dot", () => {
    const projection = projectionOf(
        { ...DEFAULT_CAMERA, position: [0, 0, 6], target: [0, 0, 0] },
        { width: 900, height: 600 },
    );
    const plain = readDocument({ root: { id: "root", type: "box" } });
    const looks = handlesOf(plain, SCHEMA, ["root"], { kind: "nodes" }, projection);
    expect(looks.map(({ key, look }) => [key, look.kind])).toEqual([
        ["size.x", "arrow"],
        ["size.y", "arrow"],
        ["size.z", "dot"],
    ]);
});

test("an angle is the arc from where there is none", () => {
    const { look, spot } = named("rod", "angle");
    const spots = look.kind === "arc" ? look.spots : [];
    expect(spots[0]).toEqual(spot);
    expect(spots.length).toBeGreaterThan(8);
    spots.forEach((at, i) => {
        const angle = 0.5 * (1 - i / (spots.length - 1));
        const wanted = seen("rod", [Math.sin(angle), Math.cos(angle), 0]);
        expect(Math.hypot(at.x - wanted.x, at.y - wanted.y)).toBeLessThan(1e-6);
    });
});

test("a blend's width is a band of that radius around the middle of what it joins", () => {
    const { look } = named("blend", "k");
    const middle = toWorld(DOCUMENT, "blend", [0, 0, 0]);
    const spot = PROJECTION.spotOf(middle);
    /* The root is half as large again. */
    const radius = (0.4 * 1.5) / PROJECTION.unitsAt(middle);
    expect(look).toEqual({ kind: "band", middle: spot, radius: expect.closeTo(radius, 6) });
});
