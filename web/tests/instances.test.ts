/* SPDX-License-Identifier: MIT */
/* Instances of models in the picture. What an instance shows has to be what its unpacked parts show. */
import { expect, test } from "vitest";
import { ballOf } from "../src/model/bounds.ts";
import { DEFAULT_CAMERA } from "../src/model/camera.ts";
import { nodeLabel, type SceneDocument } from "../src/model/document.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { dragHandle, type Handle, handleLabel, handlesOf } from "../src/model/handles.ts";
import type { Json, JsonObject } from "../src/model/json.ts";
import { unpackModel } from "../src/model/models.ts";
import { apply } from "../src/model/operations.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { readSchema } from "../src/model/schema.ts";
import { toWorld } from "../src/model/transform.ts";
import { random } from "./fixture.ts";

const param = (name: string, type: string, value: Json, handle: string, more: JsonObject = {}) =>
    ({
        ...{ name, type, default: value, handle, doc: name },
        ...{ unit: "length", min: 0, max: 100, ...more },
    }) as JsonObject;
const row = (type: string, group: string, children: string, params: JsonObject[]): JsonObject => ({
    ...{ type, group, children, params, doc: type },
});
const vec3 = (name: string, more: JsonObject): JsonObject => ({
    ...{ name, type: "vec3", default: [0, 0, 0], doc: name, ...more },
});
const SIZES = "size.x/2, 0, 0; 0, size.y/2, 0; 0, 0, size.z/2";
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            row("sphere", "primitive", "none", [param("radius", "float", 0.5, "radius, 0, 0")]),
            row("box", "primitive", "none", [param("size", "vec3", [1, 1, 1], SIZES)]),
            row("rod", "primitive", "none", [
                param("b", "vec3", [0, 0.5, 0], "b.x, b.y, b.z", { min: -100 }),
                param("plain", "float", 1, ""),
            ]),
            row("blend", "operation", "many", [param("k", "float", 0.4, "k, 0, 0")]),
            row("union", "operation", "many", []),
            row("group", "structure", "many", []),
            row("model", "structure", "none", [
                { name: "model", type: "model", default: "", doc: "" },
            ]),
        ],
        resources: {
            model: [{ name: "params", type: "rows", default: [] }],
            declared_types: ["float", "vec3"],
        },
        transform: [
            vec3("translation", { unit: "length" }),
            vec3("rotation", { unit: "angle" }),
            vec3("scale", { default: [1, 1, 1], nonzero: true, uniform: true }),
        ],
    },
});

const sets = (name: string, place: string, type = "float", range: Json = [0.1, 9]): JsonObject => ({
    ...{ name, type, sets: `/nodes/${place}`, range },
});
const at = (x: number, y: number, z: number, more: JsonObject = {}): JsonObject => ({
    ...{ translation: [x, y, z], ...more },
});
const DOCUMENT = readDocument({
    models: {
        lamp: {
            params: [
                sets("high", "pole/params/size.y"),
                sets("foot", "base/params/size", "vec3"),
                sets("glow", "head/params/wide", "float", [0.1, 2]),
                sets("deep", "head/params/way.z", "float", [-5, 5]),
                sets("lift", "head/transform/translation.y", "float", [-9, 9]),
                sets("melt", "joint/params/k", "float", [0, 2]),
                sets("dull", "tip/params/plain"),
                sets("grow", "joint/transform/scale"),
                sets("place", "tip/transform/translation", "vec3", [-9, 9]),
            ],
            root: {
                id: "lamp-root",
                type: "group",
                transform: at(0.1, 0, 0, { rotation: [0, 0.3, 0] }),
                children: [
                    { id: "base", type: "box", transform: at(0, -1, 0) },
                    { id: "pole", type: "box", params: { size: [0.2, 2, 0.2] } },
                    {
                        id: "joint",
                        type: "blend",
                        transform: at(0, 1, 0, { rotation: [0.2, 0, 0.1], scale: 0.8 }),
                        children: [
                            { id: "tip", type: "rod", transform: at(0.3, 0, 0) },
                            { id: "head", type: "model", params: { model: "bulb", wide: 0.7 } },
                        ],
                    },
                ],
            },
        },
        bulb: {
            params: [
                sets("wide", "ball/params/radius"),
                sets("way", "stem/params/b", "vec3", [-5, 5]),
            ],
            root: {
                id: "bulb-root",
                type: "group",
                children: [
                    { id: "ball", type: "sphere", transform: at(0, 0.5, 0, { scale: 1.1 }) },
                    { id: "stem", type: "rod" },
                ],
            },
        },
    },
    root: {
        id: "root",
        type: "union",
        transform: { rotation: [0.2, 0.5, 0.1], scale: 1.5 },
        children: [
            {
                id: "a",
                type: "model",
                transform: at(0.4, 0.2, 0, { rotation: [0, 0.4, 0], scale: [1, 1.2, 1] }),
                params: {
                    ...{ model: "lamp", high: 3, glow: 0.9, lift: 0.6, melt: 0.3, grow: 1.3 },
                    deep: 0.2,
                },
            },
            { id: "b", type: "model", params: { model: "lamp" } },
        ],
    },
} as unknown as Json);
const PROJECTION = projectionOf(
    { ...DEFAULT_CAMERA, position: [3, 3, 9] },
    { width: 900, height: 600 },
);

const handlesIn = (document: SceneDocument, id: string): readonly Handle[] =>
    handlesOf(document, SCHEMA, [id], { kind: "nodes" }, PROJECTION);

function named(document: SceneDocument, id: string, key: string): Handle {
    const found = handlesIn(document, id).find((handle) => handle.key === key);
    if (!found) {
        throw new Error(`no handle ${key} of ${id}`);
    }
    return found;
}

/* The scene with an instance's parts in its place, and those of the instances among them. */
function unpacked(id: string, more: readonly string[] = ["head-1"]): SceneDocument {
    let document = DOCUMENT;
    for (const name of [id, ...more]) {
        const result = apply(document, unpackModel(document, SCHEMA, name)?.ops ?? [], SCHEMA);
        if (!result.ok) {
            throw new Error(result.problem.message);
        }
        document = result.document;
    }
    return document;
}

/* Which handle of the unpacked parts each one is. */
const SAME = [
    ["high", "pole-1", "size.y"],
    ["foot.x", "base-1", "size.x"],
    ["foot.y", "base-1", "size.y"],
    ["foot.z", "base-1", "size.z"],
    ["glow", "ball-1", "radius"],
    ["melt", "joint-1", "k"],
] as const;

test.each(["a", "b"])("instance %s has the handles of what its parameters set", (id) => {
    expect(handlesIn(DOCUMENT, id).map(({ key }) => key)).toEqual([
        ...["high", "foot.x", "foot.y", "foot.z", "glow", "deep", "lift", "melt", "place"],
    ]);
    const plain = unpacked(id);
    for (const [key, node, inner] of SAME) {
        const [handle, wanted] = [named(DOCUMENT, id, key), named(plain, node, inner)];
        expect([key, handle.spot.x, handle.spot.y, handle.look.kind]).toEqual([
            ...[key, expect.closeTo(wanted.spot.x, 6), expect.closeTo(wanted.spot.y, 6)],
            wanted.look.kind,
        ]);
    }
    const middle = (look: Handle["look"]): Spot | null =>
        look.kind === "band" ? look.middle : null;
    const [band, wanted] = [named(DOCUMENT, id, "melt"), named(plain, "joint-1", "k")];
    expect(middle(band.look)?.y).toBeCloseTo(middle(wanted.look)?.y ?? 0, 6);
    const way = named(plain, "stem-1", "b");
    expect(named(DOCUMENT, id, "deep").spot.x).toBeCloseTo(way.spot.x, 6);
    expect(named(DOCUMENT, id, "deep").look.kind).toBe("arrow");
});

test.each([
    ["lift", "head-1", "arrow"],
    ["place", "tip-1", "place"],
])("%s, which sets a part's place, has a handle where that part is", (key, node, look) => {
    const plain = unpacked("a", []);
    const at = PROJECTION.spotOf(toWorld(plain, node, [0, 0, 0]));
    const handle = named(DOCUMENT, "a", key);
    expect(handle.look.kind).toBe(look);
    expect([handle.spot.x, handle.spot.y]).toEqual([
        ...[expect.closeTo(at?.x ?? 0, 6), expect.closeTo(at?.y ?? 0, 6)],
    ]);
    const to = { x: handle.spot.x + 2, y: handle.spot.y - 40 };
    const change = dragHandle(handle, PROJECTION, handle.spot, to, false);
    const moved = apply(DOCUMENT, change ? [change.op] : [], SCHEMA);
    const now = moved.ok ? named(moved.document, "a", key).spot : handle.spot;
    const most = key === "place" ? 0.01 : 12;
    expect(Math.hypot(now.x - to.x, now.y - to.y)).toBeLessThan(most);
});

test("200 random drags give an instance the number that the part itself would get", () => {
    const next = random(8);
    const plain = unpacked("a");
    for (let i = 0; i < 200; i++) {
        const [key, node, inner] = SAME[i % SAME.length] ?? SAME[0];
        const [handle, part] = [named(DOCUMENT, "a", key), named(plain, node, inner)];
        const by = (from: Spot): Spot => ({ ...from, x: from.x + dx, y: from.y + dy });
        const [dx, dy] = [80 * next() - 40, 80 * next() - 40];
        const change = dragHandle(handle, PROJECTION, handle.spot, by(handle.spot), false);
        const wanted = dragHandle(part, PROJECTION, part.spot, by(part.spot), false);
        const [name = "", letter] = key.split(".");
        expect(change?.op).toMatchObject({ op: "set", at: `/nodes/a/params/${name}` });
        const number = (op: unknown, component: number): number =>
            [(op as { value: number | number[] }).value].flat()[component] ?? Number.NaN;
        const component = "xyz".indexOf(letter ?? inner.split(".")[1] ?? "x");
        const value = number(wanted?.op, component);
        const got = number(change?.op, letter === undefined ? 0 : component);
        const most = key === "glow" || key === "melt" ? 2 : 9;
        const least = key === "melt" ? 0 : 0.1;
        expect(got).toBeCloseTo(Math.min(most, Math.max(least, value)), 3);
    }
});

test("a number keeps to the range of the instance's parameter, and is told by its name", () => {
    const glow = named(DOCUMENT, "b", "glow");
    expect(handleLabel(glow)).toBe("glow 0.7");
    const far = { x: glow.spot.x + 200, y: glow.spot.y };
    const change = dragHandle(glow, PROJECTION, glow.spot, far, false);
    expect(change).toEqual({
        op: { op: "set", at: "/nodes/b/params/glow", value: 2 },
        label: "glow 2",
    });
    const deep = named(DOCUMENT, "a", "deep");
    expect(handleLabel(deep)).toBe("deep 0.2");
    const moved = dragHandle(deep, PROJECTION, deep.spot, deep.spot, false);
    expect(moved?.op).toMatchObject({ at: "/nodes/a/params/deep" });
    expect(moved?.op).toHaveProperty("value", expect.closeTo(0.2, 5));
});

test("a value of several numbers is set as a whole", () => {
    const foot = named(DOCUMENT, "b", "foot.x");
    const to = { x: foot.spot.x + 25, y: foot.spot.y };
    const change = dragHandle(foot, PROJECTION, foot.spot, to, false);
    expect(change?.op).toMatchObject({ at: "/nodes/b/params/foot" });
    const [x = 0, ...rest] = (change?.op as { value: number[] } | undefined)?.value ?? [];
    expect([x > 1, rest]).toEqual([true, [1, 1]]);
});

test.each(["a", "b"])("the ball around instance %s holds it with its own numbers", (id) => {
    const plain = unpacked(id);
    const group = [...plain.nodes.values()].find((node) => nodeLabel(node) === "lamp-1");
    const wanted = ballOf(plain, SCHEMA, [group?.id ?? ""]);
    const ball = ballOf(DOCUMENT, SCHEMA, [id]);
    expect(ball.radius).toBeCloseTo(wanted.radius, 6);
    expect(ball.center.map((x, i) => x - (wanted.center[i] ?? 0))).toEqual([
        ...[expect.closeTo(0, 6), expect.closeTo(0, 6), expect.closeTo(0, 6)],
    ]);
    expect(ballOf(DOCUMENT, SCHEMA, ["a"]).radius).toBeGreaterThan(
        ballOf(DOCUMENT, SCHEMA, ["b"]).radius,
    );
    expect(toWorld(DOCUMENT, id, [0, 0, 0])).toHaveLength(3);
});
