/* SPDX-License-Identifier: MIT */
/* Handles of lengths without a place of their own, at a point of the surface; and of numbers whose
 * handle goes far away. */
import { expect, test } from "vitest";
import { ballIn } from "../src/model/bounds.ts";
import { DEFAULT_CAMERA } from "../src/model/camera.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { dragHandle, type Handle, handlesOf } from "../src/model/handles.ts";
import type { JsonObject } from "../src/model/json.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { readSchema } from "../src/model/schema.ts";
import { skinOf } from "../src/model/skin.ts";
import { toWorld, type Vector } from "../src/model/transform.ts";
import { random } from "./fixture.ts";

const row = (name: string, type: string, value: unknown, more: JsonObject = {}) =>
    ({ name, type, default: value, doc: name, min: 0, max: 100, ...more }) as JsonObject;
const long = (name: string, value: unknown, handle: string, type = "float") =>
    row(name, type, value, { unit: "length", handle });
const node = (type: string, children: string, params: JsonObject[]): JsonObject => ({
    ...{ type, children, params, doc: type },
    group: children === "none" ? "primitive" : "modifier",
});
const out = (by: string): string => "xyz".replace(/./g, (x) => `skin.${x} + out.${x}*${by}, `);
const OUT = (by: string): string => out(by).slice(0, -2);

const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            node("sphere", "none", [long("radius", 0.5, "radius, 0, 0")]),
            node("box", "none", [
                long("size", [1, 1, 1], "size.x/2, 0, 0; 0, size.y/2, 0; 0, 0, size.z/2", "vec3"),
            ]),
            node("polygon", "none", [row("points", "points", [], { unit: "length", max: 9 })]),
            node("code", "none", [row("size", "vec3", [3, 0, 4], { unit: "length" })]),
            node("parametric", "none", [
                row("surface", "surface", {}),
                long("thickness", 0.1, OUT("thickness/2")),
            ]),
            node("round", "many", [long("radius", 0.1, OUT("radius"))]),
            node("waves", "many", [
                row("frequency", "vec3", [10, 10, 10], {
                    handle: "pi/frequency.x, 0, 0; 0, pi/frequency.y, 0; 0, 0, pi/frequency.z",
                }),
            ]),
            node("revolve", "many", [long("offset", 0, "offset, 0, 0")]),
            node("model", "none", [row("model", "model", "")]),
            node("group", "many", []),
        ],
    },
});
const BOX = {
    id: "crate",
    type: "box",
    params: { size: [0.8, 1, 1] },
    transform: { translation: [0.2, 0.1, 0], rotation: [0, 0, Math.PI / 2], scale: 2 },
};
const document = (root: JsonObject, more: JsonObject = {}) => readDocument({ ...more, root });
const PROJECTION = projectionOf(
    { ...DEFAULT_CAMERA, position: [2, 2, 6] },
    { width: 900, height: 600 },
);

function handle(scene: ReturnType<typeof document>, id: string, key: string): Handle {
    const all = handlesOf(scene, SCHEMA, [id], { kind: "nodes" }, PROJECTION);
    const found = all.find((one) => one.key === key);
    if (!found) {
        throw new Error(`no handle ${key}`);
    }
    return found;
}

function seen(scene: ReturnType<typeof document>, id: string, point: Vector): Spot {
    const spot = PROJECTION.spotOf(toWorld(scene, id, point));
    if (!spot) {
        throw new Error("behind the camera");
    }
    return spot;
}

function skin(root: JsonObject, more: JsonObject = {}) {
    const scene = document(root, more);
    const top = scene.nodes.get(scene.root);
    if (!top) {
        throw new Error("no root");
    }
    const { at, out: way } = skinOf(scene, SCHEMA, top);
    return [at, way].map((point) => point.map((x) => Number(x.toFixed(6)) + 0));
}

const UP = [
    [0.2, 0.9, 0],
    [0, 1, 0],
];

test("it is at the first length of the first shape below, with its transforms", () => {
    expect(skin({ id: "ball", type: "sphere" })).toEqual([
        [0.5, 0, 0],
        [1, 0, 0],
    ]);
    expect(skin({ id: "in", type: "round", children: [BOX] })).toEqual(UP);
    const group = { id: "inner", type: "group", children: [BOX] };
    expect(skin({ id: "in", type: "round", children: [group] })).toEqual(UP);
    const hidden = { id: "off", type: "sphere", visible: false };
    expect(skin({ id: "in", type: "round", children: [hidden, BOX] })).toEqual(UP);
});

test("what grows in between moves it out, and a turned section is moved along", () => {
    const grown = { id: "grown", type: "round", params: { radius: 0.3 }, children: [BOX] };
    expect(skin({ id: "in", type: "round", children: [grown] })[0]).toEqual([0.2, 1.2, 0]);
    const turned = { id: "turned", type: "revolve", params: { offset: 2 }, children: [BOX] };
    expect(skin({ id: "in", type: "round", children: [turned] })[0]).toEqual([2.2, 0.9, 0]);
});

test("an instance has that of its model, with its own values", () => {
    const models = {
        ball: {
            params: [{ name: "wide", type: "float", sets: "/nodes/of-it/params/radius" }],
            root: { id: "of-it", type: "sphere" },
        },
    };
    const instance = { id: "one", type: "model", params: { model: "ball", wide: 0.7 } };
    const root = { id: "in", type: "round", children: [instance] };
    expect(skin(root, { models })[0]).toEqual([0.7, 0, 0]);
});

test("it is at a corner of a polygon, on a surface that the page can read, or beside all", () => {
    const points = [
        [1, 1],
        [-1, 1],
        [-1, -1],
        [1, -1],
    ];
    const [corner, away] = skin({ id: "flat", type: "polygon", params: { points } });
    expect(corner).toEqual([1, 1, 0]);
    expect(away).toEqual([0.707107, 0.707107, 0]);
    const sheet = (x: string): JsonObject => ({
        ...{ id: "sheet", type: "parametric" },
        params: { surface: { x, y: "t", z: "0.5", s: [-1, 1], t: [0, 2] } },
    });
    expect(skin(sheet("s"))).toEqual([
        [0.5, 1.5, 0.5],
        [0, 0, 1],
    ]);
    expect(skin(sheet("2s*(1 + s)(2 - s) + log(exp(1))"))[0]).toEqual([3.25, 1.5, 0.5]);
    const unread = document(sheet("cheb(3, s)"));
    const top = unread.nodes.get("sheet");
    const ball = top && ballIn(unread, top, SCHEMA);
    expect(skin(sheet("cheb(3, s)"))[0]).toEqual([ball?.radius, 0, 0]);
    expect(skin({ id: "own", type: "code" })[0]).toEqual([5, 0, 0]);
});

test("1,000 random drags of a length equal the closed form to 1e-6", () => {
    const next = random(11);
    for (let i = 0; i < 1000; i++) {
        const [angle, size, wide] = [next() * 0.8, 0.5 + next(), 0.2 + next()];
        const scene = document({
            ...{ id: "in", type: "round", params: { radius: next() * 0.3 } },
            transform: { rotation: [0, angle, 0], scale: size },
            children: [{ id: "ball", type: "sphere", params: { radius: wide } }],
        });
        const growth = 0.01 + next();
        const arrow = handle(scene, "in", "radius");
        expect(arrow.look.kind).toBe("arrow");
        const tip = seen(scene, "in", [wide + growth, 0, 0]);
        const change = dragHandle(arrow, PROJECTION, arrow.spot, tip, false);
        expect(change?.op).toMatchObject({ at: "/nodes/in/params/radius" });
        const value = change && "value" in change.op ? Number(change.op.value) : Number.NaN;
        expect(Math.abs(value - Number(growth.toPrecision(6)))).toBeLessThan(1e-6);
    }
});

test("a drag far along the curve of 1/x, either way, ends under the pointer", () => {
    const next = random(12);
    for (let i = 0; i < 500; i++) {
        const from = 1 + next() * 30;
        const scene = document({
            ...{ id: "wavy", type: "waves", params: { frequency: [from, 9, 9] } },
            children: [BOX],
        });
        const wanted = 1 + next() * 30;
        const dot = handle(scene, "wavy", "frequency.x");
        const to = seen(scene, "wavy", [Math.PI / wanted, 0, 0]);
        const change = dragHandle(dot, PROJECTION, dot.spot, to, false);
        const value = change && "value" in change.op ? (change.op.value as number[]) : [];
        expect((value[0] ?? 0) / wanted).toBeCloseTo(1, 4);
        expect(value.slice(1)).toEqual([9, 9]);
    }
});
