/* SPDX-License-Identifier: MIT */
/* Names of the schema in the words of the page. */
import { expect, test } from "vitest";
import { readSchema } from "../src/model/schema.ts";
import { drawnBy, outputTitle, paramTitle, placeTitle, typeTitle, words } from "../src/ui/names.ts";

test("names are words, spelled as the page's texts are", () => {
    expect(words("base_color")).toBe("base colour");
    expect(words("color1")).toBe("colour 1");
    expect(typeTitle("color2")).toBe("Colour 2");
    expect(typeTitle("floor_color")).toBe("Floor colour");
    expect(outputTitle("color")).toBe("Colour");
    expect(outputTitle("node_id")).toBe("Node id");
});

test("a letter of an equation is called as it is, another k by what it means", () => {
    const { environment } = readSchema({
        nodes: [],
        environment: [
            { name: "k", type: "float" },
            { name: "k", type: "float", when: "equation~k" },
        ],
        outputs: [],
        limits: [],
    });
    expect(environment.map(paramTitle)).toEqual(["smoothness", "k"]);
});

test("what draws is the device, but for the engine, which needs none", () => {
    const name = "llvmpipe (LLVM 15)";
    expect(drawnBy({ name, stage: "compute" })).toBe(name);
    expect(drawnBy({ name, stage: "fragment" })).toBe(name);
    expect(drawnBy({ name, stage: "engine" })).toBe("the processors of the server");
});

test("a place is told by who has it, in the words of the page", () => {
    expect(placeTitle(null, "/environment/image")).toBe("Backdrop · image");
    expect(placeTitle(null, "/camera/fov")).toBe("Camera · field of view");
    expect(placeTitle(null, "/materials/clay")).toBe("clay");
    expect(placeTitle(null, "/lights/sun/intensity")).toBe("sun · intensity");
    expect(placeTitle(null, "/nodes/gone")).toBe("/nodes/gone");
});
