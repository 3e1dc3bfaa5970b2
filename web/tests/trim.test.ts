/* SPDX-License-Identifier: MIT */
/* The patch of an equation alone: the edit, and where there is none. */
import { expect, test } from "vitest";
import type { SceneDocument } from "../src/model/document.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import type { Json, JsonObject } from "../src/model/json.ts";
import { apply } from "../src/model/operations.ts";
import { readSchema } from "../src/model/schema.ts";
import { keepPatch } from "../src/model/trim.ts";

const row = (name: string, type: string, value: Json): JsonObject => ({
    ...{ name, type, default: value, doc: name },
});
const THICKNESS = { ...row("thickness", "float", 0.05), unit: "length", min: 0 };
const type = (name: string, children: string, params: JsonObject[]): JsonObject => ({
    ...{ type: name, group: children === "none" ? "primitive" : "operation" },
    ...{ children, params, doc: name },
});
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            type("implicit", "none", [
                row("equation", "equation", ""),
                { ...row("mode", "enum", "solid"), choices: ["solid", "sheet"] },
                THICKNESS,
                row("parametric", "surface", {}),
            ]),
            type("parametric", "none", [row("surface", "surface", {}), THICKNESS]),
            type("union", "many", []),
            type("intersection", "many", []),
        ],
    },
});
const SURFACE = { x: "s*t", y: "s", z: "t^2", s: [-1, 1], t: [0, 1] };
const PLACE = { translation: [1, 2, 3], rotation: [0, 0.5, 0], scale: [2, 2, 2] };
const equation = (more: JsonObject = {}, params: JsonObject = {}): JsonObject => ({
    ...{ id: "it", type: "implicit", ...more },
    params: { equation: "x^2 = y^2*z", parametric: SURFACE, ...params },
});
const scene = (children: JsonObject[], root = "union"): SceneDocument =>
    readDocument({ root: { id: "root", type: root, children } });

function kept(document: SceneDocument): Json {
    const result = apply(document, keepPatch(SCHEMA, document, "it") ?? [], SCHEMA);
    if (!result.ok) {
        throw new Error(result.problem.message);
    }
    const back = apply(result.document, result.inverse, SCHEMA);
    expect(back.ok && printDocument(back.document)).toEqual(printDocument(document));
    return printDocument(result.document).root ?? null;
}

test("the sheet is cut by a patch of twice its thickness, in its place and of its material", () => {
    const more = { material: "clay", transform: PLACE };
    const [before, after] = [
        { id: "before", type: "union" },
        { id: "after", type: "union" },
    ];
    const document = scene([before, equation(more, { thickness: 0.2 }), after]);
    expect(kept(document)).toEqual({
        id: "root",
        type: "union",
        children: [
            before,
            {
                id: "intersection-1",
                type: "intersection",
                name: "Intersection",
                children: [
                    equation(more, { thickness: 0.2, mode: "sheet" }),
                    {
                        ...{ id: "parametric-1", type: "parametric", ...more },
                        params: { surface: SURFACE, thickness: 0.4 },
                    },
                ],
            },
            after,
        ],
    });
});

test("without a thickness of its own the patch has twice the row's; nothing else is added", () => {
    const root = kept(scene([equation()])) as { children: { children: JsonObject[] }[] };
    expect(root.children[0]?.children[1]).toEqual({
        id: "parametric-1",
        type: "parametric",
        params: { surface: SURFACE, thickness: 0.1 },
    });
});

test("a root keeps its id, place and material, and cuts what it was", () => {
    const more = { id: "it", name: "Umbrella", material: "clay", transform: PLACE };
    expect(kept(readDocument({ root: equation(more, { thickness: 0.2 }) }))).toEqual({
        ...more,
        type: "intersection",
        children: [
            equation({ id: "implicit-1" }, { thickness: 0.2, mode: "sheet" }),
            {
                ...{ id: "parametric-1", type: "parametric" },
                params: { surface: SURFACE, thickness: 0.4 },
            },
        ],
    });
});

test("there is none without a surface, and where it is done", () => {
    const of = (document: SceneDocument, id = "it") => keepPatch(SCHEMA, document, id);
    const patch = { id: "patch", type: "parametric" };
    expect(of(scene([equation({}, { parametric: {} })]))).toBeNull();
    expect(of(scene([patch]), "patch")).toBeNull();
    expect(of(scene([]), "it")).toBeNull();
    expect(of(scene([equation(), patch], "intersection"))).toBeNull();
    /* Beside a patch that does not cut it, and cut by something else. */
    expect(of(scene([equation(), patch]))).not.toBeNull();
    expect(of(scene([equation(), { id: "ball", type: "union" }], "intersection"))).not.toBeNull();
});

test("a trimmed equation is not trimmed again", () => {
    const root = kept(scene([equation()]));
    const document = readDocument({ root });
    expect(keepPatch(SCHEMA, document, "it")).toBeNull();
});
