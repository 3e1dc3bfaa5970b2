/* SPDX-License-Identifier: MIT */
/* Models, distance functions, shaders: what they declare, who names them, and edits about them. */
import { expect, test } from "vitest";
import { addNode, whatAdding } from "../src/model/add.ts";
import type { Box } from "../src/model/camera.ts";
import { clip, paste } from "../src/model/clipboard.ts";
import { declaredParams, whyNotIdentifier, whyNotRows } from "../src/model/declaredParams.ts";
import {
    findResource,
    nodeParams,
    paramAt,
    resourceParams,
    type SceneDocument,
} from "../src/model/document.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { equalJson, type Json } from "../src/model/json.ts";
import { newLightValues } from "../src/model/lights.ts";
import { makeModel, unpackModel } from "../src/model/models.ts";
import { type Change, mixedAt, multiEdit } from "../src/model/multiEdit.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { placing } from "../src/model/placing.ts";
import { PRESETS } from "../src/model/presets.ts";
import {
    addProblem,
    brokenCode,
    dropGone,
    endProblem,
    NO_PROBLEMS,
    problemIn,
    settleProblems,
} from "../src/model/problems.ts";
import {
    duplicateResource,
    newMaterialOf,
    newResource,
    removeResource,
    renameDeclared,
    renameResource,
} from "../src/model/resources.ts";
import type { DeclaredRow } from "../src/model/schema.ts";
import { changeShader } from "../src/model/shading.ts";
import { cycleThrough, modelsFor, usersOf, whyNotRemoved } from "../src/model/usage.ts";
import { checkValue } from "../src/model/values.ts";
import { SCHEMA, scene } from "./fixture.ts";

function after(document: SceneDocument, ops: readonly Operation[]): SceneDocument {
    const result = apply(document, ops, SCHEMA);
    if (!result.ok) {
        throw new Error(`${result.problem.place}: ${result.problem.message}`);
    }
    return result.document;
}

const set = (at: string, value: Json): Operation => ({ op: "set", at, value });
const refusal = (ops: readonly Operation[]) => {
    const result = apply(scene(), ops, SCHEMA);
    return result.ok ? null : result.problem;
};

/* --- declarations --- */

test("declared rows become rows of a table", () => {
    const [a, b, c, d] = declaredParams([
        { name: "a", type: "float", range: [2, 4] },
        { name: "b", type: "float3", default: [1, 2, 3], doc: "Help." },
        { name: "c", type: "bool" },
        { name: "d", type: "vec2", range: [-4, -1] },
    ]);
    expect(a).toMatchObject({ type: "float", default: 2, min: 2, max: 4 });
    expect(b).toMatchObject({ type: "vec3", default: [1, 2, 3], min: null, doc: "Help." });
    expect(c?.default).toBe(false);
    expect(d?.default).toEqual([-1, -1]);
    const rows: DeclaredRow[] = [{ name: "a", type: "float" }];
    expect(declaredParams(rows)).toBe(declaredParams(rows));
});

test.each([
    ["radius", null],
    ["_Color1", null],
    ["1a", "not a name"],
    ["a__b", "not a name"],
    ["gl_Position", "not a name"],
    ["taken", "twice"],
])("a parameter called %s", (name, reason) => {
    const found = whyNotIdentifier(name, ["taken"]);
    expect(reason === null ? found : found?.includes(reason)).toBe(reason === null ? null : true);
});

test("ranges go upwards, and only numbers have one", () => {
    expect(whyNotRows([{ name: "a", type: "float", range: [1, 0] }])).toContain("range");
    expect(whyNotRows([{ name: "a", type: "color", range: [0, 1] }])).toContain("no range");
    expect(whyNotRows([{ name: "a", type: "int", range: [0, 1] }])).toBeNull();
    expect(whyNotRows([{ name: "a", type: "int3", range: [0, 1] }])).toBeNull();
});

test("whole numbers of several parts have fields and checks of their own", () => {
    const rows: DeclaredRow[] = [
        { name: "a", type: "int2" },
        { name: "b", type: "ivec4", range: [1, 4] },
    ];
    const [a, b] = declaredParams(rows);
    expect([a?.type, a?.default]).toEqual(["ivec2", [0, 0]]);
    expect([b?.type, b?.default]).toEqual(["ivec4", [1, 1, 1, 1]]);
    expect(a && checkValue(a, [1, 0.5])).toContain("not a whole number");
    expect(a && checkValue(a, [1, -2])).toBeNull();
    expect(b && checkValue(b, [1, 2, 3])).toContain("four numbers");
    expect(b && checkValue(b, [1, 2, 3, 5])).toContain("above the maximum 4");
});

test("a node has its type's rows and those of the function it names", () => {
    const document = scene();
    const stick = document.nodes.get("stick");
    const names = stick && nodeParams(SCHEMA, document, stick).map(({ name }) => name);
    expect(names).toEqual(["primitive", "code", "lipschitz", "radius", "tint"]);
    expect(stick && nodeParams(SCHEMA, document, stick)).toBe(
        stick && nodeParams(SCHEMA, document, stick),
    );
    const stone = resourceParams(SCHEMA, document, "materials", "marble");
    expect(stone.map(({ name }) => name)).toEqual(["_Color", "glow"]);
    expect(paramAt(SCHEMA, document, "/materials/stone/properties/glow")?.values.glow).toBe(0.5);
});

test("new rows keep what fits, by name", () => {
    const rows = [
        { name: "tint", type: "vec3" },
        { name: "radius", type: "float", range: [0, 0.5] },
    ];
    const before = after(scene(), [set("/nodes/stick/params/tint", [0, 1, 0])]);
    const document = after(before, [set("/primitives/rod/params", rows)]);
    expect(document.nodes.get("stick")?.params).toEqual({ primitive: "rod", tint: [0, 1, 0] });
    const marble = after(scene(), [set("/shaders/marble/properties", [])]);
    expect(marble.materials.find(({ name }) => name === "stone")?.values).toEqual({});
});

test("another function keeps what both declare; a type keeps what its row knows", () => {
    const slab = after(scene(), [
        set("/nodes/stick/params/radius", 2),
        set("/nodes/stick/params/primitive", "slab"),
    ]);
    expect(slab.nodes.get("stick")?.params).toEqual({ primitive: "slab", radius: 2 });
    const ball = apply(scene(), [set("/nodes/stick/type", "sphere")], SCHEMA);
    expect(ball.ok && ball.document.nodes.get("stick")?.params).toEqual({ radius: 0.7 });
    const back = ball.ok ? after(ball.document, ball.inverse) : null;
    expect(equalJson(back && printDocument(back), printDocument(scene()))).toBe(true);
});

test("a new name of a declared parameter keeps values, and code follows", () => {
    const document = scene();
    const rod = document.primitives[0];
    const rows: DeclaredRow[] = [{ name: "thickness", type: "float" }];
    const ops = rod
        ? renameDeclared(document, SCHEMA, "primitives", rod, rows, "radius", "thickness")
        : [];
    const renamed = after(document, ops);
    expect(renamed.nodes.get("stick")?.params).toEqual({ primitive: "rod", thickness: 0.7 });
    expect(renamed.primitives[0]?.values.code).toBe(
        "float sdf(vec3 p) { return length(p.xz) - thickness; }",
    );
});

/* --- who names what --- */

test("what is used is known and stays", () => {
    const document = scene();
    const users = (list: "models" | "primitives" | "shaders" | "materials", name: string) =>
        usersOf(SCHEMA, document, list, name).map((user) => user.name);
    expect(users("models", "pawn")).toEqual(["rook-pawn"]);
    expect(users("primitives", "rod")).toEqual(["stick"]);
    expect(users("shaders", "marble")).toEqual(["stone"]);
    expect(users("materials", "snow")).toEqual(["neck"]);
    expect(users("materials", "coal")).toEqual([]);
    expect(whyNotRemoved(SCHEMA, document, "models", "pawn")).toBe(
        "the model pawn is used by node rook-pawn",
    );
    for (const place of ["/models/pawn", "/primitives/rod", "/shaders/marble"]) {
        expect(refusal([{ op: "remove", at: place }])?.code).toBe("conflict");
    }
    expect(refusal([{ op: "remove", at: "/models/rook" }])).toBeNull();
});

test("an edit that frees something may remove it", () => {
    const document = after(scene(), [
        set("/nodes/rook-pawn/params/model", null),
        { op: "remove", at: "/models/pawn" },
    ]);
    expect(document.models.map(({ name }) => name)).toEqual(["rook"]);
    expect(document.nodes.has("foot")).toBe(false);
});

const instance = (id: string, model: string) => ({ id, type: "model", params: { model } });

test("models do not hold themselves", () => {
    const ways: Operation[][] = [
        [
            {
                op: "insert",
                into: "/nodes/pawn-root",
                before: null,
                value: instance("x", "rook"),
            },
        ],
        [
            { op: "insert", into: "/nodes/root", before: null, value: instance("x", "rook") },
            { op: "move", at: "/nodes/x", into: "/nodes/pawn-root", before: null },
        ],
        [set("/nodes/rook-pawn/params/model", "rook")],
    ];
    const messages = ways.map((ops) => refusal(ops)?.message);
    expect(messages).toEqual([
        "a model would hold itself: /models/pawn -> /models/rook -> /models/pawn",
        "a model would hold itself: /models/pawn -> /models/rook -> /models/pawn",
        "a model would hold itself: /models/rook -> /models/rook",
    ]);
    expect(cycleThrough(SCHEMA, scene(), "rook")).toBeNull();
    expect(modelsFor(SCHEMA, scene(), "foot")).toEqual([]);
    expect(modelsFor(SCHEMA, scene(), "rook-pawn")).toEqual(["pawn"]);
    expect(modelsFor(SCHEMA, scene(), "root")).toEqual(["pawn", "rook"]);
});

test("roots of models stay where they are; what is built in keeps its name", () => {
    expect(refusal([{ op: "remove", at: "/nodes/pawn-root" }])?.code).toBe("conflict");
    expect(
        refusal([{ op: "move", at: "/nodes/pawn-root", into: "/nodes/root", before: null }])?.code,
    ).toBe("conflict");
    const phong: Operation = {
        op: "insert",
        into: "/shaders",
        before: null,
        name: "phong",
        value: {},
    };
    expect(refusal([phong])?.code).toBe("conflict");
    expect(refusal([set("/nodes/stick/params/primitive", "gone")])?.code).toBe("not_found");
    expect(refusal([set("/nodes/rook-pawn/params/model", "gone")])?.code).toBe("not_found");
});

/* --- edits --- */

test("a part becomes a model, its transform the instance's, and back again", () => {
    const before = scene();
    const edit = makeModel(before, SCHEMA, ["head"]);
    const document = after(before, edit?.ops ?? []);
    expect(document.nodes.get("neck")?.children).toEqual(["body", "head-1"]);
    expect(document.nodes.get("head-1")).toMatchObject({
        type: "model",
        params: { model: "head" },
        transform: { translation: [0, 1.3, 0] },
    });
    expect(document.nodes.get("head")).toMatchObject({ parent: "head-root-1", transform: {} });
    const unpacked = after(document, unpackModel(document, SCHEMA, "head-1")?.ops ?? []);
    const group = unpacked.nodes.get(unpacked.nodes.get("neck")?.children[1] ?? "");
    expect(group).toMatchObject({ type: "group", transform: { translation: [0, 1.3, 0] } });
    expect(unpacked.nodes.get(group?.children[0] ?? "")?.params.radius).toBe(0.6);
});

test("several parts become one model without moving", () => {
    const before = after(scene(), [set("/nodes/neck/transform/translation", [1, 0, 0])]);
    const document = after(before, makeModel(before, SCHEMA, ["head", "hat"])?.ops ?? []);
    expect(document.nodes.get("head-1")).toMatchObject({ type: "model", parent: "neck" });
    expect(document.nodes.get("head")?.transform.translation).toEqual([0, 1.3, 0]);
    expect(document.nodes.get("hat")?.transform.translation).toEqual([-1, 0, 0]);
    expect(makeModel(before, SCHEMA, ["root"])).toBeNull();
});

test("a flat shape comes with what makes it a solid, unless there is that above", () => {
    const document = scene();
    const edit = addNode(document, SCHEMA, { type: "circle" }, []);
    expect(edit.ops).toMatchObject([
        { value: { type: "extrude", children: [{ id: "circle-1", type: "circle" }] } },
    ]);
    expect(edit.select).toEqual(["circle-1"]);
    const what = whatAdding(document, SCHEMA, { type: "circle" }, [], "union");
    expect(what.words).toContain("extrude");
    const inside = after(document, edit.ops);
    const second = addNode(inside, SCHEMA, { type: "polygon" }, ["circle-1"]);
    const both = after(inside, second.ops);
    expect(both.nodes.get("extrude-1")?.children).toEqual(["circle-1", "polygon-1"]);
    const again = addNode(inside, SCHEMA, { type: "polygon" }, ["extrude-1"]);
    expect(again.ops).toEqual(second.ops);
});

test("new nodes go into what is made to hold them", () => {
    const document = after(scene(), [
        { op: "insert", into: "/nodes/root", before: null, value: { id: "ex", type: "extrude" } },
    ]);
    const row = SCHEMA.nodes.find(({ type }) => type === "sphere") ?? null;
    const spotOf = (id: string) => placing(document, SCHEMA, [id], row, "union").spot;
    expect(spotOf("ex")).toEqual({ into: "ex", before: null });
    expect(spotOf("stick")).toEqual({ into: "root", before: "ex" });
    expect(spotOf("pawn-root")).toEqual({ into: "pawn-root", before: null });
    const rod = addNode(document, SCHEMA, { type: "field", named: "rod" }, []);
    expect(rod.ops).toMatchObject([{ value: { params: { primitive: "rod" } } }]);
    const code = addNode(document, SCHEMA, { type: "field" }, []).ops[0];
    expect(JSON.stringify(code)).toContain("float sdf(vec3 p)");
});

test("new resources come with something that shows them", () => {
    const document = scene();
    const rod = after(document, newResource(document, SCHEMA, "primitives", null, []).ops);
    expect(rod.nodes.get("primitive-2")).toBeUndefined();
    expect(rod.nodes.get("primitive-1")?.params.primitive).toBe("primitive-1");
    const model = after(document, newResource(document, SCHEMA, "models", null, []).ops);
    expect(model.nodes.get("model-1")?.params.model).toBe("model-1");
    const look = after(document, newResource(document, SCHEMA, "shaders", null, ["hat"]).ops);
    expect(look.nodes.get("hat")?.common.material).toBe("shader-1");
    expect(look.materials.at(-1)).toMatchObject({ name: "shader-1", type: "shader-1" });
    const used = newResource(document, SCHEMA, "primitives", "/nodes/stick/params/primitive", []);
    expect(after(document, used.ops).nodes.get("stick")?.params.primitive).toBe("primitive-1");
    const of = after(document, newMaterialOf(document, "marble").ops);
    expect(of.materials.at(-1)).toMatchObject({ name: "marble-1", type: "marble" });
});

test("resources are copied and get other names, whoever names them", () => {
    const document = scene();
    for (const list of [
        "models",
        "primitives",
        "shaders",
        "materials",
        "lights",
        "volumes",
    ] as const) {
        const [first] = document[list];
        if (!first) {
            throw new Error(`no ${list}`);
        }
        const copy = after(document, duplicateResource(document, list, first).ops);
        expect(copy[list][1]?.name).toBe(`${first.name}-1`);
        const other = after(document, renameResource(document, SCHEMA, list, first, "other").ops);
        expect(other[list].map(({ name }) => name)).not.toContain(first.name);
        const before = usersOf(SCHEMA, document, list, first.name).length;
        expect(usersOf(SCHEMA, other, list, "other")).toHaveLength(before);
    }
    const renamed = renameResource(
        document,
        SCHEMA,
        "primitives",
        document.primitives[0] as never,
        "other",
    );
    expect(after(document, renamed.ops).nodes.get("stick")?.params).toEqual({
        primitive: "other",
        radius: 0.7,
    });
});

test("nodes of a material that goes take what their parents have", () => {
    const document = after(scene(), removeResource(scene(), SCHEMA, "materials", "snow").ops);
    expect(document.nodes.get("neck")?.common.material).toBeUndefined();
});

/* --- clipboard --- */

test("what copied nodes name comes along into another scene", () => {
    const from = after(scene(), [
        { op: "insert", into: "/nodes/root", before: null, value: instance("r", "rook") },
        set("/nodes/stick/material", "stone"),
    ]);
    const text = clip(SCHEMA, from, ["r", "stick"]);
    const empty = readDocument({ root: { id: "root", type: "union" } });
    const edit = paste(empty, SCHEMA, [], text);
    const document = after(empty, edit?.ops ?? []);
    expect(document.models.map(({ name }) => name)).toEqual(["pawn", "rook"]);
    expect(document.primitives.map(({ name }) => name)).toEqual(["rod"]);
    expect(document.shaders.map(({ name }) => name)).toEqual(["marble"]);
    expect(document.materials.map(({ name }) => name)).toEqual(["stone"]);
    expect(edit?.select.map((id) => document.nodes.get(id)?.type)).toEqual(["field", "model"]);
});

test("in the same scene they name what is there; strangers lose their names", () => {
    const text = clip(SCHEMA, scene(), ["stick"]);
    expect(paste(scene(), SCHEMA, [], text)?.ops).toHaveLength(1);
    const bare = JSON.stringify({
        nodes: [
            { type: "field", params: { primitive: "gone", x: 1 }, material: "gone" },
            { type: "model", params: { model: "gone" }, children: [{ type: "box" }] },
        ],
    });
    const pasted = paste(scene(), SCHEMA, [], bare)?.ops.map((op) => "value" in op && op.value);
    expect(pasted).toMatchObject([{ type: "field" }, { children: [{ type: "box" }] }]);
    expect(JSON.stringify(pasted)).not.toContain("gone");
});

/* One of everything that a node can name, all of it in other words than in `scene()`. */
function strangerWith(glow: number): SceneDocument {
    return readDocument({
        name: "Stranger",
        materials: { stone: { shader: "marble", properties: { glow } }, coal: { shader: "flat" } },
        shaders: { marble: { properties: [{ name: "glow", type: "float" }], code: `${glow}` } },
        primitives: { rod: { params: [], code: `${glow}` } },
        models: {
            pawn: {
                id: "foot",
                type: "field",
                material: "stone",
                params: { primitive: "rod" },
            },
        },
        root: {
            id: "root",
            type: "union",
            children: [{ id: "stick", type: "model", params: { model: "pawn" } }],
        },
    });
}

test("what differs under the same name comes along under a new one, and is named so", () => {
    const text = clip(SCHEMA, strangerWith(0.25), ["stick"], "other");
    const edit = paste(scene(), SCHEMA, [], text, "mine");
    const document = after(scene(), edit?.ops ?? []);
    const node = document.nodes.get(edit?.select[0] ?? "");
    expect(node?.params).toEqual({ model: "pawn-1" });
    const root = document.nodes.get(findResource(document, "models", "pawn-1")?.root ?? "");
    expect(root).toMatchObject({ common: { material: "stone-1" }, params: { primitive: "rod-1" } });
    expect(findResource(document, "materials", "stone-1")?.type).toBe("marble-1");
    expect(findResource(document, "materials", "stone")).toEqual(
        findResource(scene(), "materials", "stone"),
    );
    expect(new Set(document.nodes.keys()).size).toBe(scene().nodes.size + 2);
    const again = paste(document, SCHEMA, [], text, "mine");
    expect(again?.ops.filter(({ op }) => op === "insert").length).toBeGreaterThan(1);
});

test("what is the same under the same name is used", () => {
    const there = after(strangerWith(0.25), [
        { op: "remove", at: "/nodes/stick" },
        { op: "set", at: "/nodes/foot/name", value: null },
    ]);
    const text = clip(SCHEMA, strangerWith(0.25), ["stick"], "other");
    expect(paste(there, SCHEMA, [], text, "mine")?.ops).toHaveLength(1);
});

test("in the scene that they are from, nodes name what is there, changed as it may be", () => {
    const text = clip(SCHEMA, strangerWith(0.25), ["stick"], "mine");
    expect(paste(strangerWith(0.5), SCHEMA, [], text, "mine")?.ops).toHaveLength(1);
    expect(paste(strangerWith(0.5), SCHEMA, [], text, "else")?.ops.length).toBeGreaterThan(3);
});

test("a whole scene comes as one node with its name and what it needs, no more", () => {
    const text = JSON.stringify(printDocument(strangerWith(0.25)));
    const empty = readDocument({ root: { id: "root", type: "union" } });
    const edit = paste(empty, SCHEMA, [], text, "mine");
    const document = after(empty, edit?.ops ?? []);
    const [id = ""] = edit?.select ?? [];
    expect(document.nodes.get(id)).toMatchObject({ type: "union", common: { name: "Stranger" } });
    expect(document.materials.map(({ name }) => name)).toEqual(["stone"]);
    expect(document.models).toHaveLength(1);
    expect(document.lights).toHaveLength(0);
});

/* --- lights and materials --- */

test("a new light stands beside what it is for and lights it", () => {
    const head: Box = { low: [-0.5, 0.8, -0.5], high: [0.5, 1.8, 0.5] };
    const post: Box = { low: [-0.5, 0.8, -0.5], high: [0.5, 30.8, 0.5] };
    for (const lit of [head, post]) {
        const values = newLightValues(SCHEMA, "point", lit, false);
        const [x = 0, y = 0, z = 0] = values.position as number[];
        const height = lit.high[1] - lit.low[1];
        const away = Math.hypot(x, y - lit.low[1] - height / 2, z);
        expect(away).toBeGreaterThan(Math.max(2, height));
        expect(away).toBeLessThan(Math.max(4, 2 * height));
        expect(Number(values.intensity) / (Math.PI * away ** 2)).toBeCloseTo(1, 1);
        const beside = newLightValues(SCHEMA, "point", lit, true);
        expect(Number(beside.intensity) / Number(values.intensity)).toBeCloseTo(1 / 3, 1);
        expect(newLightValues(SCHEMA, "directional", lit, true)).toEqual({});
    }
});

test("a material of a preset has its name, plainly where that is free", () => {
    const [preset] = PRESETS;
    const first = newResource(scene(), SCHEMA, "materials", null, [], "union", preset);
    expect(first.name).toBe(preset?.name);
    const place = "/nodes/hat/material";
    const second = newResource(scene(), SCHEMA, "materials", place, [], "union", preset);
    expect(second.ops.at(-1)).toEqual(set(place, preset?.name ?? ""));
    expect(new Set(PRESETS.map(({ name }) => name)).size).toBe(PRESETS.length);
});

test("a preset that is used once more is the same material, until it is changed", () => {
    const [preset] = PRESETS;
    const use = (document: SceneDocument, node: string) =>
        newResource(document, SCHEMA, "materials", `/nodes/${node}/material`, [], "union", preset);
    const after = (document: SceneDocument, ops: readonly Operation[]) => {
        const result = apply(document, ops, SCHEMA);
        return result.ok ? result.document : document;
    };
    const once = after(scene(), use(scene(), "hat").ops);
    expect(use(once, "head").ops).toEqual([set("/nodes/head/material", preset?.name ?? "")]);
    const [property] = Object.keys(preset?.properties ?? {});
    const changed = after(once, [
        set(`/materials/${preset?.name}/properties/${property}`, [0, 0, 0]),
    ]);
    expect(changed).not.toBe(once);
    expect(use(changed, "head").name).toBe(`${preset?.name}-1`);
});

/* --- another shader --- */

const SHADED = readDocument({
    materials: {
        sea: {
            shader: "phong",
            properties: {
                diffuse: [0.1, 0.2, 0.9],
                shininess: 126,
                opacity: 0.25,
                ambient: 0.5,
            },
        },
    },
    root: { type: "union" },
});

test("another shader keeps what means the same, by another name and scale", () => {
    const { ops, lost } = changeShader(SHADED, SCHEMA, "sea", "standard");
    expect(lost).toEqual(["ambient"]);
    const standard = after(SHADED, ops);
    expect(findResource(standard, "materials", "sea")).toMatchObject({
        type: "standard",
        values: { base_color: [0.1, 0.2, 0.9], roughness: 0.353553, transmission: 0.75 },
    });
    const back = after(standard, changeShader(standard, SCHEMA, "sea", "phong").ops);
    const values = findResource(back, "materials", "sea")?.values;
    expect(values).toMatchObject({ diffuse: [0.1, 0.2, 0.9], opacity: 0.25 });
    expect(Number(values?.shininess)).toBeCloseTo(126, 2);
});

test("what another shader knows by the same name stays as it is", () => {
    const { ops, lost } = changeShader(scene(), SCHEMA, "snow", "flat");
    expect(ops).toEqual([set("/materials/snow/shader", "flat")]);
    expect(lost).toEqual([]);
});

/* --- several nodes at once --- */

const all = (at: string, value: Json, selection: string[], change?: Change) =>
    multiEdit(SCHEMA, scene(), selection, at, value as never, change);

test("a typed value is the same for all selected nodes that can take it", () => {
    expect(all("/nodes/body/params/radius", 2, ["hat", "head", "body"])).toEqual([
        set("/nodes/body/params/radius", 2),
        set("/nodes/head/params/radius", 2),
    ]);
    expect(all("/nodes/head/material", null, ["hat", "head"])).toHaveLength(2);
    expect(all("/nodes/stick/params/radius", 20, ["body", "stick"])).toHaveLength(2);
    expect(all("/nodes/body/params/radius", 2, ["head"])).toHaveLength(1);
    expect(all("/camera/fov", 30, ["head"])).toHaveLength(1);
    /* One component alone. */
    const x: Change = { axis: 0, by: () => 5 };
    expect(all("/nodes/hat/transform/translation", [5, 0, 0], ["hat", "head"], x)[1]).toEqual(
        set("/nodes/head/transform/translation", [5, 1.3, 0]),
    );
});

test("a drag changes each from where it is", () => {
    const more: Change = { axis: null, by: (own) => own + 0.5 };
    expect(all("/nodes/body/params/radius", 1.5, ["head", "body"], more)).toEqual([
        set("/nodes/body/params/radius", 1.5),
        set("/nodes/head/params/radius", 1.1),
    ]);
    const least: Change = { axis: null, by: (own) => own - 0.7 };
    const [, head] = all("/nodes/body/params/radius", 0.3, ["head", "body"], least);
    expect(head).toMatchObject({ at: "/nodes/head/params/radius" });
    expect(head?.op === "set" && Number(head.value)).toBeGreaterThan(0);
    const quarter: Change = { axis: 1, by: (own) => own + Math.PI / 2 };
    expect(all("/nodes/hat/transform/rotation", [0, 1, 0], ["hat", "head"], quarter)[1]).toEqual(
        set("/nodes/head/transform/rotation", [0, Math.PI / 2, 0]),
    );
});

test("where selected nodes differ is told by component", () => {
    const mixed = (selection: string[], at: string) => mixedAt(SCHEMA, scene(), selection, at);
    expect(mixed(["head", "body"], "/nodes/body/params/radius")).toBe("1");
    expect(mixed(["head", "body"], "/nodes/body/transform/translation")).toBe("010");
    expect(mixed(["head", "body"], "/nodes/body/transform/scale")).toBe("");
    expect(mixed(["body"], "/nodes/body/params/radius")).toBe("");
    expect(mixed(["head", "neck"], "/nodes/neck/material")).toBe("1");
    expect(mixed(["hat", "body"], "/nodes/body/params/radius")).toBe("");
});

/* --- problems --- */

test("problems stand at their places until they end", () => {
    const document = scene();
    const place = "/primitives/rod/code";
    const broken = { code: "compile", place, message: "no ;", line: 1, column: 4 };
    const problems = addProblem(NO_PROBLEMS, broken);
    expect(problemIn(problems, "/primitives/rod")).toMatchObject({ line: 1, column: 4 });
    expect(problemIn(problems, "/primitives/ro")).toBeNull();
    expect(brokenCode(problems)).toHaveLength(1);
    expect(endProblem(problems, "/primitives/slab/code")).toBe(problems);
    expect(endProblem(problems, place).size).toBe(0);
    expect(dropGone(problems, document)).toBe(problems);
    const without = readDocument({ root: { type: "union" } });
    expect(dropGone(problems, without).size).toBe(0);
    expect(dropGone(problems, null)).toBe(problems);
});

test("a refused edit is settled by the next one there; broken code is not", () => {
    const refused = { code: "invalid", place: "/0/nodes/body/params/radius", message: "too big" };
    const broken = { code: "compile", place: "/nodes/body/params/code", message: "no ;" };
    const problems = addProblem(addProblem(NO_PROBLEMS, refused), broken);
    expect(problems.has("/nodes/body/params/radius")).toBe(true);
    expect(settleProblems(problems, [set("/nodes/head/name", "x")])).toBe(problems);
    const left = settleProblems(problems, [set("/nodes/body/name", "x")]);
    expect([...left.keys()]).toEqual(["/nodes/body/params/code"]);
});
