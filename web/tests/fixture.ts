/* SPDX-License-Identifier: MIT */
/* A small registry, a document, and seeded random edits for the tests of the model. */
import type { FrameHeader } from "../src/link/protocol.ts";
import { everyNode, type SceneDocument } from "../src/model/document.ts";
import { readDocument } from "../src/model/documentJson.ts";
import type { Json, JsonObject } from "../src/model/json.ts";
import type { Operation } from "../src/model/operation.ts";
import { readSchema } from "../src/model/schema.ts";

const float = (name: string, more: JsonObject = {}): JsonObject => ({
    name,
    type: "float",
    default: 1,
    min: 0,
    max: 1000,
    doc: name,
    ...more,
});
const vec3 = (name: string, more: JsonObject = {}): JsonObject => ({
    name,
    type: "vec3",
    default: [0, 0, 0],
    doc: name,
    ...more,
});
const CHILDREN: Record<string, string> = { primitive: "none", shape: "none", modifier: "one" };
const node = (type: string, group: string, params: JsonObject[], words = ""): JsonObject => ({
    type,
    group,
    exactness: "exact",
    doc: `A ${type}.`,
    words,
    children: CHILDREN[group] ?? "many",
    params,
});
const text = (name: string, type: string): JsonObject => ({ name, type, default: "", doc: name });
const length = { unit: "length" };

export const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            node("sphere", "primitive", [float("radius", { ...length, above_min: true })], "ball"),
            node("box", "primitive", [vec3("size", { default: [1, 1, 1], ...length })]),
            node("torus", "primitive", [float("radius", length), float("tube", length)], "donut"),
            node("plane", "primitive", [vec3("normal", { default: [0, 1, 0], direction: true })]),
            node("union", "operation", []),
            node("difference", "operation", []),
            node("smooth_union", "operation", [float("k", { default: 0.1 })]),
            node("group", "structure", []),
            node("circle", "shape", [float("radius", length)], "disc"),
            node("polygon", "shape", [
                {
                    name: "points",
                    type: "points",
                    default: [
                        [0, 0],
                        [1, 0],
                        [0, 1],
                    ],
                    min: 3,
                    max: 5,
                },
            ]),
            node("extrude", "modifier", [float("height")]),
            node("revolve", "modifier", [float("offset")]),
            node("model", "structure", [text("model", "model")], "instance copy"),
            node("field", "structure", [
                text("primitive", "function"),
                text("code", "code"),
                float("lipschitz"),
            ]),
        ],
        resources: {
            primitive: [
                { name: "params", type: "rows", default: [] },
                text("code", "code"),
                float("lipschitz"),
            ],
            shader: [{ name: "properties", type: "rows", default: [] }, text("code", "code")],
            model: [{ name: "params", type: "rows", default: [] }],
            declared_types: [
                "float",
                "int",
                "bool",
                "vec2",
                "vec3",
                "vec4",
                "ivec2",
                "ivec3",
                "ivec4",
                "color",
            ],
        },
        node: [
            { name: "name", type: "text", default: "" },
            { name: "material", type: "material", default: "" },
            { name: "visible", type: "bool", default: true },
        ],
        transform: [
            vec3("translation", length),
            vec3("rotation", { unit: "angle" }),
            vec3("scale", { default: [1, 1, 1], nonzero: true, uniform: true }),
        ],
        lights: [
            {
                type: "directional",
                params: [
                    vec3("direction", { default: [0, -1, 0], direction: true }),
                    float("intensity"),
                ],
            },
            { type: "point", params: [vec3("position", length), float("intensity")] },
        ],
        volumes: [
            { type: "box", params: [vec3("size", length), float("density")] },
            { type: "sphere", params: [float("radius", length), float("density")] },
        ],
        shaders: [
            {
                type: "phong",
                params: [
                    { name: "diffuse", type: "color", default: [1, 1, 1], max: 1, means: "color" },
                    float("shininess", { default: 32, min: 1, max: 2048, means: "gloss" }),
                    float("opacity", { max: 1, means: "opacity" }),
                    float("ambient", { max: 1 }),
                ],
            },
            {
                type: "standard",
                params: [
                    { name: "base_color", type: "color", default: [1, 1, 1], means: "color" },
                    float("roughness", { default: 0.5, max: 1, means: "roughness" }),
                    float("transmission", { default: 0, max: 1, means: "transmission" }),
                ],
            },
            {
                type: "flat",
                params: [
                    { name: "diffuse", type: "color", default: [1, 1, 1] },
                    float("glow", { max: 2 }),
                ],
            },
        ],
        camera: [
            vec3("position", { default: [0, 1, 5], ...length }),
            vec3("target", length),
            vec3("up", { default: [0, 1, 0], direction: true }),
            float("fov", { default: 45, min: 1, max: 170, unit: "degrees" }),
        ],
        environment: [{ name: "type", type: "enum", choices: ["sky", "solid"], default: "sky" }],
        render: [{ name: "samples", type: "int", default: 2, min: 1, max: 4 }],
        limits: [{ name: "nodes", value: 100000, unit: "nodes", doc: "" }],
    },
});

export const SCENE: Json = {
    format: "fieldcast/1",
    name: "Snowman",
    camera: { position: [0, 1.5, 6], target: [0, 1, 0], fov: 45 },
    lights: [
        { id: "sun", type: "directional", direction: [0, -1, 0], intensity: 3 },
        { id: "lamp", type: "point", intensity: 2 },
    ],
    volumes: [{ id: "smoke", type: "box", size: [1, 2, 3], density: 4 }],
    materials: {
        snow: { shader: "phong", properties: { diffuse: [0.9, 0.9, 0.95] } },
        coal: { shader: "flat", properties: { diffuse: [0, 0, 0], glow: 1 } },
        stone: { shader: "marble", properties: { glow: 0.5 } },
    },
    primitives: {
        rod: {
            params: [
                { name: "radius", type: "float", default: 0.5, range: [0, 10] },
                { name: "tint", type: "color", default: [1, 1, 1] },
            ],
            code: "float sdf(vec3 p) { return length(p.xz) - radius; }",
        },
        slab: {
            params: [
                { name: "radius", type: "int" },
                { name: "extent", type: "vec2", range: [1, 4] },
            ],
            code: "",
        },
    },
    shaders: {
        marble: {
            properties: [
                { name: "_Color", type: "color", default: [1, 0, 0] },
                { name: "glow", type: "float", range: [0, 1] },
            ],
            code: "vec3 shade(FragmentProperties properties) { return _Color; }",
        },
    },
    models: {
        pawn: {
            id: "pawn-root",
            type: "group",
            children: [{ id: "foot", type: "sphere" }],
        },
        rook: {
            id: "rook-root",
            type: "group",
            children: [{ id: "rook-pawn", type: "model", params: { model: "pawn" } }],
        },
    },
    environment: { type: "sky" },
    render: { samples: 2 },
    root: {
        id: "root",
        type: "union",
        children: [
            {
                id: "neck",
                type: "smooth_union",
                material: "snow",
                params: { k: 0.2 },
                children: [
                    { id: "body", type: "sphere", params: { radius: 1 } },
                    {
                        id: "head",
                        type: "sphere",
                        params: { radius: 0.6 },
                        transform: { translation: [0, 1.3, 0] },
                    },
                ],
            },
            { id: "hat", type: "box", name: "Hat", visible: false },
            { id: "stick", type: "field", params: { primitive: "rod", radius: 0.7 } },
        ],
    },
};

export function scene(): SceneDocument {
    return readDocument(SCENE);
}

/* Mulberry32 (Tommy Ettinger): the same numbers for the same seed everywhere. */
export function random(seed: number): () => number {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
    };
}

export function choose<T>(items: readonly T[], next: () => number): T {
    return items[Math.floor(next() * items.length)] as T;
}

const MISSING = "gone";

/* Declarations that agree and disagree about names, types and ranges. */
const DECLARATIONS: readonly Json[] = [
    [],
    [{ name: "radius", type: "float" }],
    [{ name: "radius", type: "float", range: [0, 1] }],
    [
        { name: "tint", type: "vec3" },
        { name: "radius", type: "int" },
        { name: "glow", type: "float" },
    ],
];

/* One operation that may or may not fit the document. */
export function randomOperation(
    document: SceneDocument,
    next: () => number,
    fresh: () => string,
): Operation {
    const ids = [...everyNode(document), MISSING];
    const id = choose(ids, next);
    const x = Math.round(next() * 100) / 10;
    const materials = [...document.materials.map(({ name }) => name), MISSING];
    const material = choose(materials, next);
    const primitives = [...document.primitives.map(({ name }) => name), MISSING];
    const primitive = choose(primitives, next);
    const models = [...document.models.map(({ name }) => name), MISSING];
    const shaders = [...document.shaders.map(({ name }) => name), MISSING];
    const rows = choose(DECLARATIONS, next);
    const list = choose(["lights", "volumes"] as const, next);
    const typed = [...document[list].map(({ name }) => name), MISSING];
    const one = choose(typed, next);
    const children = document.nodes.get(id)?.children ?? [];
    const before = choose([null, null, ...children], next);
    const set = (at: string, value: Json): Operation => ({ op: "set", at, value });
    const kinds: readonly (() => Operation)[] = [
        () => set(`/nodes/${id}/transform/translation`, choose([[x, 0, 1], null], next)),
        () => set(`/nodes/${id}/transform`, choose([{ scale: 2 }, {}, null], next)),
        () => set(`/nodes/${id}/params/radius`, choose([x + 1, null], next)),
        () => set(`/nodes/${id}/params/k`, x),
        () => set(`/nodes/${id}/name`, choose(["x", null], next)),
        () => set(`/nodes/${id}/visible`, choose([false, null], next)),
        () => set(`/nodes/${id}/material`, choose([material, null], next)),
        () =>
            set(
                `/nodes/${id}/type`,
                choose(["sphere", "torus", "field", "union", "model", "?"], next),
            ),
        () => set("/camera/fov", choose([x + 1, null], next)),
        () => set("/camera", choose([{ fov: 30 }, null], next)),
        () => set("/render/samples", 3),
        () => set("/name", choose(["A", null], next)),
        () => set(`/lights/${one}/intensity`, x),
        () => set(`/lights/${one}/type`, choose(["point", "directional"], next)),
        () => set(`/volumes/${one}/radius`, x + 1),
        () => set(`/volumes/${one}/type`, choose(["box", "sphere", "point"], next)),
        () => set(`/materials/${material}/properties/diffuse`, [x, x, x]),
        () => set(`/materials/${material}/shader`, choose(["phong", "flat", "marble"], next)),
        () => set(`/materials/${material}/properties/glow`, choose([0.5, null], next)),
        () => set(`/nodes/${id}/params/primitive`, choose([...primitives, "", null], next)),
        () => set(`/nodes/${id}/params/tint`, [x, x, x]),
        () => set(`/nodes/${id}/params/model`, choose([...models, "", null], next)),
        () => set(`/primitives/${primitive}/params`, rows),
        () => set(`/primitives/${primitive}/code`, choose(["x", null], next)),
        () => set(`/shaders/${choose(shaders, next)}/properties`, rows),
        () => ({
            op: "insert",
            into: `/nodes/${id}`,
            before,
            value: {
                id: fresh(),
                type: "union",
                children: [{ id: fresh(), type: "sphere", params: { radius: x + 1 } }],
            },
        }),
        () => ({
            op: "insert",
            into: "/materials",
            before: choose([null, ...materials], next),
            name: fresh(),
            value: { shader: "phong", properties: {} },
        }),
        () => ({
            op: "insert",
            into: `/${list}`,
            before: choose([null, ...typed], next),
            value: { id: fresh(), type: list === "lights" ? "point" : "sphere" },
        }),
        () => ({
            op: "insert",
            into: "/models",
            before: choose([null, ...models], next),
            name: fresh(),
            value: {
                id: fresh(),
                type: "group",
                children: [{ id: fresh(), type: "model", params: { model: choose(models, next) } }],
            },
        }),
        () => ({
            op: "insert",
            into: "/primitives",
            before: choose([null, ...primitives], next),
            name: fresh(),
            value: { params: rows, code: "" },
        }),
        () => ({ op: "remove", at: `/models/${choose(models, next)}` }),
        () => ({ op: "remove", at: `/primitives/${primitive}` }),
        () => ({ op: "remove", at: `/shaders/${choose(shaders, next)}` }),
        () => ({ op: "remove", at: `/nodes/${id}` }),
        () => ({ op: "remove", at: `/materials/${material}` }),
        () => ({ op: "remove", at: `/${list}/${one}` }),
        () => ({ op: "move", at: `/nodes/${choose(ids, next)}`, into: `/nodes/${id}`, before }),
        () => ({
            op: "move",
            at: `/${list}/${one}`,
            into: `/${list}`,
            before: choose([null, ...typed], next),
        }),
        () => ({
            op: "move",
            at: `/materials/${material}`,
            into: "/materials",
            before: choose([null, ...materials], next),
        }),
    ];
    return choose(kinds, next)();
}

/* Of a guide at rest. */
export const HEADER: FrameHeader = {
    codec: "guide",
    key: true,
    still: true,
    lossless: false,
    stale: false,
    depths: false,
    delta: false,
    number: 7,
    payloadBytes: 0,
    revision: 12,
    input: 5,
    width: 6,
    height: 4,
    viewWidth: 12,
    viewHeight: 8,
    round: 1,
    rounds: 1,
    chain: 0,
    link: 0,
    stages: [],
};
