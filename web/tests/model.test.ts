/* SPDX-License-Identifier: MIT */
/* Schema, history, selection, notices, looking things up. */
import { expect, test } from "vitest";
import {
    everyNode,
    freeId,
    freeName,
    materialOf,
    modelOf,
    paramAt,
    preorder,
    topmost,
} from "../src/model/document.ts";
import {
    EMPTY_HISTORY,
    fitHistory,
    forgetStep,
    nameSteps,
    recordRedo,
    recordStep,
    recordUndo,
    redoTitle,
    undoTitle,
} from "../src/model/history.ts";
import { nodeOfPlace, resourceOfPlace } from "../src/model/places.ts";
import type { Param, Value } from "../src/model/schema.ts";
import { search } from "../src/model/search.ts";
import { addNotice, createStores, dismissNotice } from "../src/model/stores.ts";
import { text } from "../src/model/texts.ts";
import { checkValue, clampNumber } from "../src/model/values.ts";
import { select, selectAfter } from "../src/model/view.ts";
import { SCHEMA, scene } from "./fixture.ts";

const NOT_A_NAME = '"gl_a" is not a name for code: letters, digits and _, no digit first';

const paramOf = (place: string): Param => {
    const found = paramAt(SCHEMA, scene(), place);
    if (!found) {
        throw new Error(`nothing at ${place}`);
    }
    return found.param;
};

test.each<[string, Value, string | null]>([
    ["/nodes/body/params/radius", 1, null],
    ["/nodes/body/params/radius", 0, "0 is not above 0"],
    ["/nodes/body/params/radius", 2000, "2000 is above the maximum 1000"],
    ["/nodes/body/params/radius", -1, "-1 is below the minimum 0"],
    ["/nodes/body/params/radius", Number.NaN, "NaN is not a finite number"],
    ["/nodes/body/params/radius", "1", "a number is expected"],
    ["/nodes/body/transform/scale", 2, null],
    ["/nodes/body/transform/scale", [1, 0, 1], "0 is not allowed"],
    ["/nodes/body/transform/translation", 2, "three numbers are expected"],
    ["/nodes/body/transform/translation", [1, 2], "three numbers are expected"],
    ["/lights/sun/direction", [0, 0, 0], "a direction is not 0 0 0"],
    ["/materials/snow/properties/diffuse", [1, -1, 0], "-1 is below the minimum 0"],
    ["/environment/type", "sky", null],
    ["/environment/type", "moon", "one of sky, solid is expected"],
    ["/render/samples", 1.5, "1.5 is not a whole number"],
    ["/nodes/body/visible", 1, "true or false is expected"],
    ["/camera/fov", 171, "171 is above the maximum 170"],
    ["/nodes/stick/params/radius", 0.7, null],
    ["/nodes/stick/params/radius", 11, "11 is above the maximum 10"],
    ["/nodes/stick/params/tint", [1, 0, -1], "-1 is below the minimum 0"],
    ["/nodes/stick/params/primitive", "slab", null],
    ["/materials/stone/properties/glow", 2, "2 is above the maximum 1"],
    ["/primitives/rod/params", [], null],
    ["/primitives/rod/params", [{ name: "a", type: "float" }], null],
    ["/primitives/rod/params", [{ name: "gl_a", type: "float" }], NOT_A_NAME],
    ["/primitives/rod/code", 5, "text is expected"],
])("%s = %o", (place, value, problem) => {
    expect(checkValue(paramOf(place), value)).toBe(problem);
});

test("scrubbing stops at what is allowed", () => {
    for (const x of [-5, 0, 5, 5000]) {
        const radius = paramOf("/nodes/body/params/radius");
        expect(checkValue(radius, clampNumber(radius, x))).toBeNull();
        const samples = paramOf("/render/samples");
        expect(checkValue(samples, clampNumber(samples, x + 0.4))).toBeNull();
    }
});

test("a donut is found under torus", () => {
    const found = (query: string) =>
        search(SCHEMA.nodes, query, ({ type, words, group, doc }) => ({
            name: type,
            words,
            kind: group,
            doc,
        })).map(({ type }) => type);
    expect(found("donut")).toEqual(["torus"]);
    expect(found("union")[0]).toBe("union");
    expect(found("smooth union")[0]).toBe("smooth_union");
    expect(found("")).toHaveLength(SCHEMA.nodes.length);
    expect(found("donut xyzzy")).toEqual([]);
});

test("materials come from the nearest node that names one", () => {
    expect(materialOf(scene(), "head")).toEqual({ material: "snow", from: "neck" });
    expect(materialOf(scene(), "hat")).toBeNull();
});

test("walks, free names, the node of a place", () => {
    const document = scene();
    expect(preorder(document)).toEqual(["root", "neck", "body", "head", "hat", "stick"]);
    expect(everyNode(document).slice(-4)).toEqual(["pawn-root", "foot", "rook-root", "rook-pawn"]);
    expect(modelOf(document, "foot")?.name).toBe("pawn");
    expect(modelOf(document, "head")).toBeNull();
    expect(topmost(document, ["foot", "head", "pawn-root"])).toEqual(["head", "pawn-root"]);
    expect(topmost(document, ["head", "hat", "neck"])).toEqual(["neck", "hat"]);
    expect(freeId(document, "body")).toBe("body-1");
    expect(freeId(document, "body-1", new Set(["body-1"]))).toBe("body-2");
    expect(freeName(document, "materials", "snow")).toBe("snow-1");
    expect(nodeOfPlace("/nodes/body/params/radius")).toBe("body");
    expect(nodeOfPlace("/3/nodes/body")).toBe("body");
    expect(nodeOfPlace("/camera/fov")).toBeNull();
    expect(resourceOfPlace("/primitives/rod/code")).toEqual({ list: "primitives", name: "rod" });
    expect(resourceOfPlace("/nodes/body")).toBeNull();
});

test("one group is one step, and the server's counts win", () => {
    let history = recordStep(EMPTY_HISTORY, {
        group: "a",
        label: "move head",
        selection: ["head"],
    });
    history = recordStep(history, { group: "a", label: "", selection: [] });
    expect(history.undo.map(({ selection }) => selection)).toEqual([["head"]]);
    history = recordStep(history, { group: "", label: "delete hat", selection: [] });
    expect(undoTitle(history)).toBe("Undo delete hat");
    history = recordUndo(history);
    expect([undoTitle(history), redoTitle(history)]).toEqual(["Undo move head", "Redo delete hat"]);
    history = recordRedo(history);
    expect(undoTitle(history)).toBe("Undo delete hat");
    const fitted = fitHistory(history, 4, 0);
    expect(fitted.undo.map(({ label }) => label)).toEqual(["", "", "move head", "delete hat"]);
    expect(fitHistory(fitted, 1, 0).undo.map(({ label }) => label)).toEqual(["delete hat"]);
    expect(forgetStep(history, "a")).toBe(history);
});

test("steps of the page before get the server's names, newest first", () => {
    const own = recordStep(fitHistory(EMPTY_HISTORY, 2, 1), {
        group: "",
        label: "mine",
        selection: [],
    });
    const named = nameSteps(own, ["other name", "delete hat", "move head"], ["grow"]);
    expect(named.undo.map(({ label }) => label)).toEqual(["move head", "delete hat", "mine"]);
    expect(undoTitle(named)).toBe("Undo mine");
});

test("selection replaces, adds and toggles; the active node is last", () => {
    expect(select(["a"], "b", "replace")).toEqual(["b"]);
    expect(select(["a", "b"], "a", "add")).toEqual(["b", "a"]);
    expect(select(["a", "b"], "a", "toggle")).toEqual(["b"]);
    expect(select(["a"], null, "replace")).toEqual([]);
    expect(select(["a"], null, "add")).toEqual(["a"]);
});

test("an undo selects what it brings back, else what was selected before what it takes away", () => {
    const after = (...lists: [string[], string[], string[]]) => selectAfter(scene(), ...lists);
    expect(after(["gone"], ["hat"], ["head"])).toEqual(["hat"]);
    expect(after(["gone"], [], ["head", "lost", "hat"])).toEqual(["head", "hat"]);
    expect(after(["body", "gone"], [], ["head"])).toEqual(["body", "gone"]);
    expect(after([], [], ["head"])).toEqual([]);
});

test("equal notices in a row count up", () => {
    const { notices } = createStores(null);
    const one = { level: "info", code: "x", message: "m" } as const;
    addNotice(notices, one);
    addNotice(notices, one);
    addNotice(notices, { ...one, place: "/nodes/a" });
    expect(notices.getState().notices.map(({ count }) => count)).toEqual([2, 1]);
    dismissNotice(notices, notices.getState().notices[0]?.id ?? 0);
    expect(notices.getState().notices).toHaveLength(1);
});

test("texts are filled in", () => {
    expect(text("saved", { revision: 7 })).toBe("Everything is saved, revision 7.");
});
