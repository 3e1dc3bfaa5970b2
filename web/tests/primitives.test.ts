/* SPDX-License-Identifier: MIT */
/* Parameters of models: what they set, what instances show of them, and what edits make of them. */
import { expect, test } from "vitest";
import {
    type Choice,
    changeParameters,
    choose,
    chosenIn,
    type Field,
    groupsOf,
    makePrimitive,
    whyNotChoice,
} from "../src/model/choosing.ts";
import { clip, paste } from "../src/model/clipboard.ts";
import { findResource, nodeParams, type SceneDocument } from "../src/model/document.ts";
import { difference } from "../src/model/documentDiff.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { readText } from "../src/model/documentRead.ts";
import { documentText, partsOf } from "../src/model/documentText.ts";
import { removeNodes } from "../src/model/edits.ts";
import { equalJson, type Json } from "../src/model/json.ts";
import { parseText } from "../src/model/jsonText.ts";
import { entryOfNode, takeEntry } from "../src/model/library.ts";
import { released, settingParams, settingsOf, targetOf } from "../src/model/modelParams.ts";
import { unpackModel } from "../src/model/models.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { duplicateResource } from "../src/model/resources.ts";
import { SCHEMA } from "./fixture.ts";

const SCENE = {
    format: "fieldcast/1",
    models: {
        lamp: {
            params: [
                { name: "high", type: "float", sets: "/nodes/pole/params/size.y", range: [0.1, 9] },
                { name: "glow", type: "float", sets: "/nodes/head/params/wide", range: [1, 2] },
            ],
            root: {
                id: "lamp-root",
                type: "group",
                children: [
                    { id: "pole", type: "box", params: { size: [1, 4, 1] } },
                    { id: "head", type: "model", params: { model: "bulb" } },
                ],
            },
        },
        bulb: {
            params: [
                { name: "wide", type: "float", sets: "/nodes/ball/params/radius", range: [0.5, 3] },
            ],
            root: { id: "ball", type: "sphere", params: { radius: 2 } },
        },
    },
    root: {
        id: "root",
        type: "union",
        children: [
            { id: "a", type: "model", params: { model: "lamp", high: 5 } },
            { id: "b", type: "model", params: { model: "bulb" } },
            {
                id: "jug",
                type: "smooth_union",
                transform: { translation: [1, 0, 0] },
                children: [
                    { id: "body", type: "sphere", params: { radius: 0.5 } },
                    { id: "lid", type: "box", transform: { translation: [0, 1, 0] } },
                ],
            },
        ],
    },
};
const DOCUMENT = readDocument(SCENE as unknown as Json);

function after(document: SceneDocument, ops: readonly Operation[]): SceneDocument {
    const result = apply(document, ops, SCHEMA);
    if (!result.ok) {
        throw new Error(`${result.problem.place}: ${result.problem.message}`);
    }
    const back = apply(result.document, result.inverse, SCHEMA);
    expect(back.ok && equalJson(printDocument(back.document), printDocument(document))).toBe(true);
    return result.document;
}

const model = (document: SceneDocument, name: string) => {
    const found = findResource(document, "models", name);
    if (!found) {
        throw new Error(`no model ${name}`);
    }
    return found;
};
const rowsIn = (document: SceneDocument, id: string) => {
    const node = document.nodes.get(id);
    return node ? nodeParams(SCHEMA, document, node) : [];
};
const sets = (document: SceneDocument, name: string) =>
    settingsOf(model(document, name)).map((row) => row.sets);
const fieldOf = (document: SceneDocument, top: string, place: string): Field => {
    const target = targetOf(place);
    const field = groupsOf(SCHEMA, document, top)
        .flatMap(({ fields }) => fields)
        .find((one) => one.target.node === target?.node && one.target.name === target.name);
    if (!field) {
        throw new Error(`no field ${place}`);
    }
    return field;
};

test("documents with them read and print", () => {
    const printed = printDocument(DOCUMENT);
    expect(printed.models).toEqual(SCENE.models);
    const text = documentText(SCHEMA, DOCUMENT);
    const read = readText(SCHEMA, DOCUMENT, text);
    expect(read.ok && equalJson(printDocument(read.document), printed)).toBe(true);
    const parsed = parseText(text);
    const places = parsed.ok ? partsOf(parsed.value).map(({ place }) => place) : [];
    expect(places).toContain("/models/lamp/params");
    expect(places).toContain("/nodes/pole/params/size");
    const wrong = readText(SCHEMA, DOCUMENT, text.replace('"params": [', '"parms": ['));
    expect(wrong.ok ? [] : wrong.faults.map(({ place }) => place)).toContain("/models/lamp/parms");
});

test("instances have them with what the tree has as defaults", () => {
    expect(rowsIn(DOCUMENT, "a").map(({ name, default: now }) => [name, now])).toEqual([
        ["model", ""],
        ["high", 4],
        ["glow", 2],
    ]);
    expect(rowsIn(DOCUMENT, "a")[1]).toMatchObject({ min: 0.1, max: 9, unit: "length" });
    const lamp = model(DOCUMENT, "lamp");
    expect(settingParams(SCHEMA, DOCUMENT, lamp)).toBe(settingParams(SCHEMA, DOCUMENT, lamp));
    const other = after(DOCUMENT, [{ op: "set", at: "/nodes/pole/params/size", value: [1, 7, 1] }]);
    expect(rowsIn(other, "a")[1]?.default).toBe(7);
});

test("another model, or other rows, take the values away and bring them back", () => {
    const other = after(DOCUMENT, [{ op: "set", at: "/nodes/a/params/model", value: "bulb" }]);
    expect(other.nodes.get("a")?.params).toEqual({ model: "bulb" });
    const none = after(DOCUMENT, [{ op: "set", at: "/models/lamp/params", value: null }]);
    expect(none.nodes.get("a")?.params).toEqual({ model: "lamp" });
});

test("unpacking keeps an instance's own numbers", () => {
    const edit = unpackModel(DOCUMENT, SCHEMA, "a");
    const document = after(DOCUMENT, edit?.ops ?? []);
    const parts = document.nodes.get(edit?.select[0] ?? "")?.children ?? [];
    expect(document.nodes.get(parts[0] ?? "")?.params).toEqual({ size: [1, 5, 1] });
});

test("copies set their own nodes", () => {
    const copy = duplicateResource(DOCUMENT, "models", model(DOCUMENT, "lamp"));
    const document = after(DOCUMENT, copy.ops);
    expect(sets(document, copy.name)).toEqual([
        "/nodes/pole-1/params/size.y",
        "/nodes/head-1/params/wide",
    ]);
    const pasted = paste(document, SCHEMA, [], clip(SCHEMA, DOCUMENT, ["a"]), "other");
    expect(pasted?.ops.filter(({ op }) => op === "insert")).toHaveLength(1);
    const empty = readDocument({ root: { id: "root", type: "union" } } as unknown as Json);
    const entry = entryOfNode(SCHEMA, DOCUMENT, "a");
    const target = { selection: [], way: "union" } as const;
    const taken = entry && takeEntry(SCHEMA, empty, entry, target);
    const once = after(empty, taken?.ops ?? []);
    expect(sets(once, "lamp")).toEqual([
        "/nodes/pole-1/params/size.y",
        "/nodes/head-1/params/wide",
    ]);
    const again = entry && takeEntry(SCHEMA, once, entry, target);
    expect(after(once, again?.ops ?? []).models).toHaveLength(2);
});

test("what goes takes its parameters along, the outer ones first", () => {
    expect(released(SCHEMA, DOCUMENT, ["ball"])).toEqual([
        { op: "set", at: "/models/lamp/params", value: [SCENE.models.lamp.params[0]] },
        { op: "set", at: "/models/bulb/params", value: null },
    ]);
    const document = after(DOCUMENT, removeNodes(DOCUMENT, SCHEMA, ["pole"]).ops);
    expect(sets(document, "lamp")).toEqual(["/nodes/head/params/wide"]);
    expect(released(SCHEMA, DOCUMENT, ["jug"])).toEqual([]);
});

test("the edits between two documents take rows away before what they set", () => {
    const json = structuredClone(SCENE);
    json.models.lamp.params = [
        { name: "big", type: "float", sets: "/nodes/pole/params/radius", range: [1, 5] },
    ];
    json.models.lamp.root.children[0] = { id: "pole", type: "sphere", params: {} } as never;
    json.root.children[0] = { id: "a", type: "model", params: { model: "lamp", big: 3 } } as never;
    const wanted = readDocument(json as unknown as Json);
    for (const [from, to] of [
        [DOCUMENT, wanted],
        [wanted, DOCUMENT],
        [DOCUMENT, readDocument({ root: { id: "root", type: "union" } } as unknown as Json)],
        [readDocument({ root: { id: "root", type: "union" } } as unknown as Json), DOCUMENT],
    ] as const) {
        const found = difference(SCHEMA, from, to);
        expect(found.ok).toBe(true);
        const document = found.ok ? after(from, found.ops) : from;
        expect(equalJson(printDocument(document), printDocument(to))).toBe(true);
    }
    const found = difference(SCHEMA, DOCUMENT, wanted);
    const places = found.ok ? found.ops.map((op) => ("at" in op ? op.at : op.into)) : [];
    expect(places.indexOf("/models/lamp/params")).toBeLessThan(places.indexOf("/nodes/pole/type"));
    expect(places.lastIndexOf("/models/lamp/params")).toBeGreaterThan(
        places.indexOf("/nodes/pole/type"),
    );
});

test("numbers are chosen from all fields of a subtree", () => {
    const groups = groupsOf(SCHEMA, DOCUMENT, "jug").map(({ node, fields }) => [
        node.id,
        ...fields.map(({ target }) => `${target.group}/${target.name}`),
    ]);
    expect(groups[0]).toEqual(["jug", "params/k"]);
    expect(groups[1]?.slice(0, 3)).toEqual(["body", "params/radius", "transform/translation"]);
    const radius = fieldOf(DOCUMENT, "jug", "/nodes/body/params/radius");
    const size = fieldOf(DOCUMENT, "jug", "/nodes/lid/params/size");
    const first = choose(radius, { component: null, type: "float" }, "Body radius", ["k"]);
    expect(first).toMatchObject({ name: "body_radius", type: "float", range: [0.13, 2] });
    const second = choose(size, size.parts[2] as never, "Lid size", ["lid_size_y"]);
    expect(second).toMatchObject({ name: "lid_size_y_2", type: "float", range: [0.25, 4] });
    const whyNot = (part: Partial<Choice>) =>
        whyNotChoice({ ...first, ...part }, radius, ["model"]);
    expect(whyNot({})).toBeNull();
    expect(whyNot({ name: "model" })).toContain("declared twice");
    expect(whyNot({ name: "a b" })).toContain("is not a name");
    expect(whyNot({ range: [0, 1] })).toContain("above 0");
    expect(whyNot({ range: [2, 1] })).toContain("from less to more");
    expect(whyNot({ range: [1, 2000] })).toContain("leaves 0 to 1000");
});

test("a primitive is a model with parameters, and an instance of it", () => {
    const radius = fieldOf(DOCUMENT, "jug", "/nodes/body/params/radius");
    const choice = choose(radius, { component: null, type: "float" }, "wide", []);
    const made = makePrimitive(DOCUMENT, SCHEMA, "jug", "Big jug", [choice]);
    const document = after(DOCUMENT, made?.ops ?? []);
    expect(made?.name).toBe("Big-jug-1");
    expect(sets(document, "Big-jug-1")).toEqual(["/nodes/body/params/radius"]);
    const [id = ""] = made?.select ?? [];
    expect(rowsIn(document, id).map(({ name }) => name)).toEqual(["model", "wide"]);
    const set = after(document, [{ op: "set", at: `/nodes/${id}/params/wide`, value: 2 }]);
    const other = { ...(chosenIn(model(set, "Big-jug-1"))[0] as Choice), name: "across" };
    const changed = changeParameters(set, SCHEMA, model(set, "Big-jug-1"), [other]);
    expect(after(set, changed.ops).nodes.get(id)?.params.across).toBe(2);
});

/* The scene, with a model around the lamp; `names` of parameters come in place of others. */
function nested(names: Record<string, string> = {}): SceneDocument {
    const json = structuredClone(SCENE) as unknown as {
        models: Record<string, unknown>;
        root: { children: unknown[] };
    };
    json.models.room = {
        params: [{ name: "mood", type: "float", sets: "/nodes/hung/params/glow", range: [1, 2] }],
        root: { id: "hung", type: "model", params: { model: "lamp", glow: 1.5 } },
    };
    json.root.children.push(
        { id: "c", type: "model", params: { model: "room", mood: 1.25 } },
        { id: "d", type: "model", params: { model: "lamp", glow: 1.75 } },
        { id: "e", type: "model", params: { model: "bulb", wide: 0.75 } },
    );
    const text = JSON.stringify(json).replace(
        /\b(wide|glow|high)\b/g,
        (name) => names[name] ?? name,
    );
    return readDocument(JSON.parse(text) as Json);
}

function renamed(document: SceneDocument, name: string, names: Record<string, string>) {
    const found = model(document, name);
    const choices = chosenIn(found).map((one) => ({ ...one, name: names[one.name] ?? one.name }));
    return after(document, changeParameters(document, SCHEMA, found, choices).ops);
}

test.each([
    ["bulb", { wide: "across" }],
    ["lamp", { glow: "shine" }],
    ["lamp", { glow: "high", high: "glow" }],
])("a parameter of %s under another name keeps all that refers to it", (name, names) => {
    const document = renamed(nested(), name, names as Record<string, string>);
    expect(printDocument(document)).toEqual(printDocument(nested(names as Record<string, string>)));
});

test("a parameter that goes takes along those that set it in instances", () => {
    const document = nested();
    const gone = changeParameters(document, SCHEMA, model(document, "bulb"), []);
    const left = after(document, gone.ops);
    expect([sets(left, "bulb"), sets(left, "room")]).toEqual([[], []]);
    expect(sets(left, "lamp")).toEqual(["/nodes/pole/params/size.y"]);
    expect(left.nodes.get("a")?.params).toEqual({ model: "lamp", high: 5 });
    expect(left.nodes.get("e")?.params).toEqual({ model: "bulb" });
    expect(gone.ops.map((op) => "at" in op && op.at)).toEqual([
        ...["/models/room/params", "/models/lamp/params", "/models/bulb/params"],
    ]);
});
