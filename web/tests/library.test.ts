/* SPDX-License-Identifier: MIT */
/* The library: what a node or a resource gives to it, and what a scene gets of an entry. */
import { expect, test } from "vitest";
import { findResource, type SceneDocument } from "../src/model/document.ts";
import { printNode, readDocument } from "../src/model/documentJson.ts";
import type { JsonObject } from "../src/model/json.ts";
import {
    entryOfNode,
    entryOfResource,
    renameEntry,
    type Target,
    takeEntry,
} from "../src/model/library.ts";
import { type Entry, readEntry, readEntryRows } from "../src/model/libraryEntries.ts";
import { apply } from "../src/model/operations.ts";
import { SCHEMA, scene } from "./fixture.ts";

const HERE: Target = { selection: [], way: "union" };

const EMPTY = readDocument({ format: "fieldcast/1", root: { id: "root", type: "union" } });

const MUG: SceneDocument = readDocument({
    format: "fieldcast/1",
    materials: {
        clay: { shader: "phong", properties: { diffuse: [0.8, 0.3, 0.2] } },
        glaze: { shader: "marble", properties: {} },
        unused: { shader: "phong", properties: {} },
    },
    shaders: { marble: { properties: [], code: "vec3 shade() { return vec3(1.0); }" } },
    primitives: { rod: { params: [], code: "float sdf(vec3 p) { return length(p) - 1.0; }" } },
    models: {
        foot: { id: "foot-root", type: "sphere" },
        stand: {
            id: "stand-root",
            type: "group",
            children: [{ id: "one", type: "model", params: { model: "foot" } }],
        },
    },
    root: {
        id: "root",
        type: "union",
        material: "clay",
        children: [
            {
                id: "mug",
                type: "difference",
                name: "Mug",
                visible: false,
                transform: { translation: [5, 0, 0], rotation: [0, 1, 0] },
                children: [
                    { id: "body", type: "sphere" },
                    { id: "hollow", type: "box", material: "glaze" },
                    { id: "base", type: "model", params: { model: "stand" } },
                ],
            },
            { id: "stick", type: "field", params: { primitive: "rod" } },
            { id: "disc", type: "circle" },
        ],
    },
});

function entry(document: SceneDocument, id: string): Entry {
    const found = entryOfNode(SCHEMA, document, id);
    if (!found) {
        throw new Error(`no node ${id}`);
    }
    return found;
}

function taken(document: SceneDocument, what: Entry, where: Partial<Target> = {}) {
    const edit = takeEntry(SCHEMA, document, what, { ...HERE, ...where });
    const result = edit && apply(document, edit.ops, SCHEMA);
    if (!edit || !result?.ok) {
        throw new Error(result ? JSON.stringify(result) : "nothing in it");
    }
    const [id = ""] = edit.select;
    return { document: result.document, edit, id };
}

const namesOf = (document: SceneDocument, list: "materials" | "models" | "shaders") =>
    document[list].map(({ name }) => name);

/* --- giving --- */

test("a node brings what it uses, and looks as it did", () => {
    const { kind, document } = entry(MUG, "mug");
    expect(kind).toBe("model");
    expect(document).toMatchObject({ format: "fieldcast/1", name: "Mug" });
    expect(Object.keys(document).sort()).toEqual(
        ["format", "materials", "models", "name", "root", "shaders"].sort(),
    );
    expect(Object.keys(document.materials as JsonObject).sort()).toEqual(["clay", "glaze"]);
    expect(Object.keys(document.models as JsonObject).sort()).toEqual(["foot", "stand"]);
    /* It inherits a material, stands at the origin, and is seen. */
    expect(document.root).toMatchObject({ id: "mug", material: "clay" });
    expect((document.root as JsonObject).transform).toEqual({ rotation: [0, 1, 0] });
    expect(document.root).not.toHaveProperty("visible");
});

test("a node of somebody's code is a primitive; with children it is a model", () => {
    const { kind, document } = entry(MUG, "stick");
    expect(kind).toBe("primitive");
    expect(document.primitives).toHaveProperty("rod");
    expect(entry(MUG, "disc").kind).toBe("model");
    expect(entryOfNode(SCHEMA, MUG, "nobody")).toBeNull();
});

test("a material, a primitive and a model are saved from their lists", () => {
    const save = (list: "materials" | "primitives" | "models", name: string) => {
        const resource = findResource(MUG, list, name);
        return resource && entryOfResource(SCHEMA, MUG, list, resource);
    };
    expect(save("materials", "glaze")).toMatchObject({
        kind: "material",
        document: {
            name: "glaze",
            materials: { glaze: { shader: "marble" } },
            shaders: { marble: {} },
            root: { type: "sphere", material: "glaze" },
        },
    });
    expect(save("primitives", "rod")).toMatchObject({
        kind: "primitive",
        document: { root: { type: "field", params: { primitive: "rod" } } },
    });
    expect(save("models", "stand")).toMatchObject({
        kind: "model",
        document: { models: { foot: {} }, root: { id: "stand-root" } },
    });
});

/* --- taking --- */

test("an empty scene gets the tree with all that it uses", () => {
    const { document, id, edit } = taken(EMPTY, entry(MUG, "mug"));
    expect(edit.label).toBe("add Mug");
    expect(document.nodes.get(id)).toMatchObject({
        parent: "root",
        type: "difference",
        common: { name: "Mug", material: "clay" },
    });
    expect(namesOf(document, "materials").sort()).toEqual(["clay", "glaze"]);
    expect(namesOf(document, "models")).toEqual(["foot", "stand"]);
    expect(namesOf(document, "shaders")).toEqual(["marble"]);
});

test("a second copy shares what is the same, and has a name and ids of its own", () => {
    const once = taken(EMPTY, entry(MUG, "mug"));
    const twice = taken(once.document, entry(MUG, "mug"));
    expect(twice.document.nodes.get(twice.id)?.common.name).toBe("Mug 2");
    for (const list of ["materials", "models", "shaders"] as const) {
        expect(namesOf(twice.document, list)).toEqual(namesOf(once.document, list));
    }
});

test("what has the same name here and is another thing stays, and the copy gets another name", () => {
    const other = readDocument({
        format: "fieldcast/1",
        materials: { clay: { shader: "flat" }, glaze: { shader: "marble" } },
        shaders: { marble: { properties: [], code: "vec3 shade() { return vec3(0.0); }" } },
        models: { foot: { id: "f", type: "box" } },
        root: { id: "root", type: "union" },
    });
    const { document, id } = taken(other, entry(MUG, "mug"));
    expect(findResource(document, "materials", "clay")?.type).toBe("flat");
    expect(document.nodes.get(id)?.common.material).toBe("clay-1");
    expect(findResource(document, "materials", "clay-1")?.type).toBe("phong");
    expect(findResource(document, "materials", "glaze-1")?.type).toBe("marble-1");
    const stand = findResource(document, "models", "stand");
    const inner = JSON.stringify(printNode(document, stand?.root ?? ""));
    expect(inner).toContain('"model":"foot-1"');
    /* The next copy finds the names that were made for the first. */
    const again = taken(document, entry(MUG, "mug"));
    expect(namesOf(again.document, "materials")).toEqual(namesOf(document, "materials"));
    expect(namesOf(again.document, "models")).toEqual(namesOf(document, "models"));
});

test("it goes where a new shape would: beside, or as a cut", () => {
    const ball = entry(MUG, "body");
    const cut = taken(scene(), ball, { selection: ["body"], way: "cut" });
    const parent = cut.document.nodes.get(cut.document.nodes.get(cut.id)?.parent ?? "");
    expect(parent?.type).toBe("difference");
    const input = taken(EMPTY, ball, { into: "root" });
    expect(input.document.nodes.get("root")?.children).toEqual([input.id]);
});

test("a union that cuts gets an id beside that of its place", () => {
    const two = readDocument({
        format: "fieldcast/1",
        root: {
            id: "root",
            type: "difference",
            children: [
                { id: "a", type: "sphere" },
                { id: "b", type: "sphere" },
            ],
        },
    });
    const pair = readDocument({
        format: "fieldcast/1",
        root: { id: "union-1", type: "union", children: [{ id: "c", type: "sphere" }] },
    });
    const both = entry(pair, "union-1");
    const { document, id } = taken(two, both, { selection: ["b"], way: "union" });
    expect(document.nodes.get(id)?.type).toBe("union");
});

test("a flat shape comes with what makes it a solid", () => {
    const { document, id } = taken(EMPTY, entry(MUG, "disc"));
    expect(document.nodes.get(id)?.type).toBe("circle");
    expect(document.nodes.get(document.nodes.get(id)?.parent ?? "")?.type).toBe("extrude");
});

test("a model inside a model is not shared: it could come to hold itself", () => {
    const stand = entry(MUG, "mug");
    const { document } = taken(MUG, stand, { selection: ["foot-root"], into: "foot-root" });
    expect(namesOf(document, "models")).toEqual(["foot", "stand", "foot-1", "stand-1"]);
});

test("a material goes to what is selected, or to the place that asked, or into the list", () => {
    const resource = findResource(MUG, "materials", "glaze");
    const glaze = resource && entryOfResource(SCHEMA, MUG, "materials", resource);
    if (!glaze) {
        throw new Error("no glaze");
    }
    const given = taken(scene(), glaze, { selection: ["body", "head"] });
    expect(given.document.nodes.get("head")?.common.material).toBe("glaze");
    expect(given.edit.select).toEqual(["body", "head"]);
    const used = taken(scene(), glaze, { use: "/nodes/body/material" });
    expect(used.document.nodes.get("body")?.common.material).toBe("glaze");
    expect(used.document.nodes.get("head")?.common.material).not.toBe("glaze");
    expect(namesOf(taken(EMPTY, glaze).document, "materials")).toEqual(["glaze"]);
    const empty = { kind: "material", document: { root: { type: "sphere" } } } as const;
    expect(takeEntry(SCHEMA, EMPTY, empty, HERE)).toBeNull();
});

/* --- what the server says --- */

test("rows and entries are read, whatever they hold", () => {
    const rows = readEntryRows({
        entries: [{ id: "a", kind: "material", name: "A", nodes: 1 }, { kind: "light" }, 7],
    });
    expect(rows).toEqual([
        { id: "a", kind: "material", name: "A", nodes: 1 },
        { id: "", kind: "model", name: "", nodes: 0 },
    ]);
    expect(readEntryRows(null)).toEqual([]);
    expect(readEntry(null)).toEqual({ kind: "model", document: {} });
    const renamed = renameEntry(entry(MUG, "mug"), "Cup");
    expect(renamed.document.name).toBe("Cup");
    expect(renamed.document.root).toEqual(entry(MUG, "mug").document.root);
});
