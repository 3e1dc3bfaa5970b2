/* SPDX-License-Identifier: MIT */
/* Outputs, conditions and headings of the schema; pictures as files; what a thumbnail reads. */
import { afterEach, expect, test, vi } from "vitest";
import { createRest, RestError } from "../src/link/rest.ts";
import type { App } from "../src/model/actions.ts";
import { focusOn } from "../src/model/actions.ts";
import { commandById, runCommand } from "../src/model/commandLookup.ts";
import {
    extensionOf,
    FIRST_CHOICE,
    type PictureChoice,
    toggleOutput,
    whyNotPicture,
} from "../src/model/picture.ts";
import {
    findParam,
    grouped,
    matters,
    outputsShown,
    type Param,
    readSchema,
    type Values,
} from "../src/model/schema.ts";
import { createStores } from "../src/model/stores.ts";
import { readHdr } from "../src/ui/fields/thumbnail.ts";
import { conditionOf } from "../src/ui/reference/topics.ts";

const SCHEMA = readSchema({
    nodes: [],
    environment: [
        { name: "type", type: "enum", choices: ["sky", "image"], default: "sky" },
        { name: "zenith", type: "color", default: [0, 0, 0], when: "type=sky" },
        { name: "fog", type: "float", default: 0, group: "fog" },
        { name: "intensity", type: "float", default: 1 },
        { name: "fog_height", type: "float", default: 0, group: "fog", when: "fog!=0" },
        { name: "fog_base", type: "float", default: 0, group: "fog", when: "fog_height!=0" },
        { name: "floor", type: "bool", default: false, group: "floor" },
        { name: "floor_color", type: "color", group: "floor", when: "floor=true" },
        { name: "odd", type: "float", when: "nothing like it" },
        { name: "shape", type: "equation", group: "shape" },
        { name: "a", type: "float", group: "shape", when: "shape~a" },
    ],
    outputs: [
        { name: "color", doc: "What is seen.", channels: 4, picture: true },
        { name: "position", doc: "Places.", channels: 3, picture: false },
        { name: "normal", doc: "Normals.", channels: 3, picture: true },
    ],
    limits: [{ name: "image_pixels", value: 4_000_000, unit: "pixels", doc: "" }],
});

/* --- conditions and headings --- */

test("rows stand under their headings, those without first", () => {
    expect(grouped(SCHEMA.environment).map(([title, rows]) => [title, rows.length])).toEqual([
        ["", 4],
        ["fog", 3],
        ["floor", 2],
        ["shape", 2],
    ]);
    expect(grouped([])).toEqual([]);
});

test("a row matters where its condition holds, and what that hangs on matters", () => {
    const shown = (values: Values): string[] =>
        SCHEMA.environment
            .filter((param) => matters(SCHEMA.environment, values, param))
            .map(({ name }) => name);
    const always = ["fog", "intensity", "floor", "odd", "shape"];
    expect(shown({})).toEqual(["type", "zenith", ...always]);
    expect(shown({ type: "image" })).toEqual(["type", ...always]);
    expect(shown({ fog: 0.1, fog_height: 2 })).toContain("fog_base");
    expect(shown({ fog: 0, fog_height: 2 })).not.toContain("fog_base");
    expect(shown({ floor: true })).toContain("floor_color");
    expect(findParam(SCHEMA.environment, "fog_base")?.when).toEqual({
        name: "fog_height",
        value: 0,
        test: "!=",
    });
    expect(
        ["", "x = tan(x)", "A*x", "2a*x = 1", "x^(1/a)", "a := 2; a*x"].map((shape) =>
            shown({ shape }).includes("a"),
        ),
    ).toEqual([false, false, false, true, true, false]);
});

test("conditions are told in words", () => {
    const told = (name: string) => conditionOf(findParam(SCHEMA.environment, name) as Param);
    expect(["type", "zenith", "fog_base", "floor_color", "a"].map(told)).toEqual([
        "",
        "type is sky",
        "fog height is not 0",
        "floor is yes",
        "shape has a",
    ]);
});

/* --- the output shown --- */

function newApp(): App {
    const stores = createStores(null);
    stores.document.setState({ schema: SCHEMA, document: { camera: {} } as never });
    return { stores, edit: vi.fn(() => true) } as unknown as App;
}

const run = (app: App, id: string): string | null => {
    const command = commandById(id);
    return command ? runCommand(app, command) : "no such command";
};

test("the outputs with a picture follow each other", () => {
    const app = newApp();
    const shown = () => app.stores.view.getState().aov;
    expect(outputsShown(SCHEMA).map(({ name }) => name)).toEqual(["color", "normal"]);
    expect(run(app, "view.color")).toBe("The colours are shown.");
    run(app, "view.output");
    expect(shown()).toBe("normal");
    run(app, "view.output");
    expect(shown()).toBe("color");
    run(app, "view.output");
    run(app, "view.color");
    expect(shown()).toBe("color");
});

test("the focus is a distance along the view, not along the ray", () => {
    const app = newApp();
    expect(run(app, "camera.focus")).toBe("The camera has no aperture: everything is sharp.");
    app.stores.document.setState({ document: { camera: { aperture: 0.1 } } as never });
    expect(run(app, "camera.focus")).toBeNull();
    expect(app.stores.view.getState().aiming).toBe(true);
    const camera = { position: [0, 0, 5], target: [0, 0, 0] } as const;
    app.stores.camera.setState((state) => ({ camera: { ...state.camera, ...camera } }));
    focusOn(app, [3, 2, 1]);
    expect(app.edit).toHaveBeenCalledWith([{ op: "set", at: "/camera/focus", value: 4 }], {
        label: "focus",
    });
});

/* --- pictures as files --- */

test("what no file can be says why", () => {
    const why = (part: Partial<PictureChoice>) =>
        whyNotPicture(SCHEMA, { ...FIRST_CHOICE, ...part });
    expect(why({})).toBeNull();
    expect(why({ outputs: [] })).toBe("Choose an output.");
    expect(why({ width: 4000, height: 2000 })).toBe("Pictures have 4 million pixels at most.");
    expect(why({ outputs: ["color", "position"] })).toMatch("position has no picture");
    expect(why({ outputs: ["color", "position"], format: "npy" })).toBeNull();
    expect(why({ outputs: ["color", "normal"], format: "jpg" })).toMatch("one output");
    expect(why({ outputs: ["normal"], format: "hdr" })).toMatch("light of color alone");
    expect(why({ format: "hdr" })).toBeNull();
    expect(why({ transparent: true, format: "jpg" })).toMatch("transparent");
    expect(why({ transparent: true })).toBeNull();
});

test("several outputs are one file", () => {
    const two = toggleOutput(FIRST_CHOICE, "normal");
    expect(extensionOf(FIRST_CHOICE)).toBe("png");
    expect(extensionOf(two)).toBe("zip");
    expect(extensionOf({ ...two, format: "npy" })).toBe("npz");
    expect(toggleOutput(two, "color").outputs).toEqual(["normal"]);
});

afterEach(() => vi.unstubAllGlobals());

test("a picture is asked for by its address", () => {
    const { imageUrl } = createRest("http://host", null);
    const plain = imageUrl("a b", { width: 4, height: 2, format: "jpg" });
    expect(plain).toBe("http://host/v1/scenes/a%20b/image.jpg?width=4&height=2");
    const url = new URL(
        imageUrl("s", {
            ...FIRST_CHOICE,
            outputs: ["color", "normal"],
            level: "final",
            transparent: true,
            camera: { position: [1, 2, 3], fov: 40 },
            section: { normal: [0, 0, -1], offset: 0.5 },
        }),
    );
    expect(Object.fromEntries(url.searchParams)).toEqual({
        width: "1920",
        height: "1080",
        aov: "color,normal",
        level: "final",
        transparent: "true",
        "camera.position": "1,2,3",
        "camera.fov": "40",
        "section.normal": "0,0,-1",
        "section.offset": "0.5",
    });
});

test("a file is sent as it is, and refused with the server's words", async () => {
    const asset = { id: "ab", type: "image/png", width: 2, height: 1 };
    const fetch = vi.fn(async () => Response.json(asset, { status: 201 }));
    vi.stubGlobal("fetch", fetch);
    const rest = createRest("", "secret");
    const file = new Blob(["x"]);
    expect(await rest.uploadAsset(file)).toEqual(asset);
    const [path, init] = fetch.mock.calls[0] as unknown as [string, RequestInit];
    expect([path, init.method, init.body]).toEqual(["/v1/assets", "POST", file]);
    expect(new Headers(init.headers).get("Authorization")).toBe("Bearer secret");
    const problem = { code: "invalid", detail: "this is no picture" };
    vi.stubGlobal("fetch", async () => Response.json(problem, { status: 422 }));
    await expect(rest.uploadAsset(file)).rejects.toThrow(RestError);
    await expect(rest.uploadAsset(file)).rejects.toThrow("this is no picture");
});

/* --- thumbnails --- */

const line = (...runs: number[]): number[] => [2, 2, 0, 8, ...runs];
const hdr = (lines: readonly number[]): Uint8Array => {
    const head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
    return new Uint8Array([...new TextEncoder().encode(head), ...lines]);
};

test("Radiance pictures are read line by line, runs and plain bytes", () => {
    const even = line(136, 10, 136, 20, 136, 30, 136, 128);
    const mixed = line(4, 1, 2, 3, 4, 132, 9, 136, 0, 136, 0, 136, 129);
    const pixels = readHdr(hdr([...even, ...mixed]));
    expect([pixels?.width, pixels?.height]).toEqual([8, 2]);
    expect([...(pixels?.bytes.slice(0, 8) ?? [])]).toEqual([10, 20, 30, 128, 10, 20, 30, 128]);
    const red = Array.from({ length: 8 }, (_, x) => pixels?.bytes[4 * (8 + x)]);
    expect(red).toEqual([1, 2, 3, 4, 9, 9, 9, 9]);
});

test("what is no such picture is told apart from one that is damaged", () => {
    const even = line(136, 10, 136, 20, 136, 30, 136, 128);
    expect(readHdr(new TextEncoder().encode("\x89PNG"))).toBeNull();
    expect(readHdr(hdr([1, 1, 1, 1]))).toBeNull();
    expect(() => readHdr(hdr([...even, ...line(137, 1)]))).toThrow("damaged");
    expect(() => readHdr(hdr([...even, ...line(0, 1, 136, 0, 136, 0)]))).toThrow("damaged");
    expect(() => readHdr(hdr([...even, ...line(136, 1, 136, 0)]))).toThrow("damaged");
});
