/* SPDX-License-Identifier: MIT */
/* The wire: examples of protocol/README.md, the frame header byte for byte, torn frames. */
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { FrameAssembler } from "../src/link/decode.ts";
import { frameInfo, isWorse, retryDelay } from "../src/link/engine.ts";
import { Meter } from "../src/link/meter.ts";
import { fitSize } from "../src/link/picture.ts";
import {
    FRAME_FIXED_BYTES,
    type FrameHeader,
    packFrame,
    packPart,
    readMessage,
    readPacket,
} from "../src/link/protocol.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { equalJson, isObject, type Json } from "../src/model/json.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { parsePlace } from "../src/model/places.ts";
import { readSchema } from "../src/model/schema.ts";
import { random } from "./fixture.ts";

const README = readFileSync(new URL("../../protocol/README.md", import.meta.url), "utf8");

/* The examples: each stands after a fence ```json KIND. */
const EXAMPLES = [...README.matchAll(/^```json (\w+)\n([\s\S]*?)^```/gm)].map(([, kind, body]) => ({
    kind,
    json: JSON.parse(body ?? "") as Json,
}));

function examples(kind: string): Json[] {
    return EXAMPLES.filter((example) => example.kind === kind).map(({ json }) => json);
}

/* The registry as far as the examples need it. */
const SCHEMA = readSchema({
    nodes: [
        { type: "union", group: "operation", params: [] },
        { type: "intersection", group: "operation", params: [] },
        {
            ...{ type: "implicit", group: "primitive" },
            params: [
                { name: "equation", type: "equation" },
                { name: "parametric", type: "surface" },
            ],
        },
        { type: "parametric", group: "primitive", params: [{ name: "surface", type: "surface" }] },
        { type: "smooth_union", group: "operation", params: [{ name: "k", type: "float" }] },
        { type: "sphere", group: "primitive", params: [{ name: "radius", type: "float" }] },
        { type: "box", group: "primitive", params: [{ name: "size", type: "vec3" }] },
        { type: "cone", group: "primitive", params: [{ name: "height", type: "float" }] },
        { type: "model", group: "structure", params: [{ name: "model", type: "model" }] },
        { type: "field", group: "structure", params: [{ name: "primitive", type: "function" }] },
    ],
    volumes: [
        { type: "box", params: [{ name: "density", type: "float" }] },
        { type: "sphere", params: [{ name: "source", type: "enum", choices: ["noise"] }] },
    ],
    resources: {
        primitive: [
            { name: "params", type: "rows" },
            { name: "code", type: "code" },
        ],
        shader: [],
        model: [{ name: "params", type: "rows" }],
        declared_types: ["float"],
    },
});

/* Empty members may be left out. */
function trimmed(json: Json): Json {
    const full = (value: Json | undefined): boolean =>
        !isObject(value) || Object.keys(value).length > 0;
    if (Array.isArray(json)) {
        return json.map(trimmed);
    }
    return isObject(json)
        ? Object.fromEntries(
              Object.entries(json)
                  .filter(([, value]) => full(value))
                  .map(([name, value]) => [name, trimmed(value as Json)]),
          )
        : json;
}

test("the scene of the protocol's page reads and prints", () => {
    const scenes = examples("scene");
    expect(scenes.length).toBe(7);
    for (const example of scenes) {
        expect(equalJson(trimmed(printDocument(readDocument(example))), trimmed(example))).toBe(
            true,
        );
    }
});

test("each edit of the protocol's page applies to the scene above it, and back", () => {
    let scene: Json = null;
    const edits: [Json, Json][] = [];
    for (const { kind, json } of EXAMPLES) {
        scene = kind === "scene" ? json : scene;
        if (kind === "edit") {
            edits.push([scene, json]);
        }
    }
    expect(edits).toHaveLength(5);
    for (const [i, [before, edit]] of edits.entries()) {
        const document = readDocument(before);
        const result = apply(document, edit as unknown as Operation[], SCHEMA);
        expect(result.ok ? "" : result.problem.message).toBe("");
        if (result.ok) {
            const { nodes } = result.document;
            const radii = ["body", "pawn-body"].map((id) => nodes.get(id)?.params.radius);
            expect(radii).toContain([1.2, undefined, 0.4, undefined][i]);
            const back = apply(result.document, result.inverse, SCHEMA);
            expect(
                back.ok && equalJson(printDocument(back.document), printDocument(document)),
            ).toBe(true);
        }
    }
});

test("every place that the protocol's page names can be parsed", () => {
    const row = README.split("\n").find((line) => line.startsWith("| `set` |")) ?? "";
    const places = [...row.matchAll(/`(\/[^`]+)`/g)].flatMap(([, place = ""]) => {
        const choices = /\{([^}]*)\}/.exec(place);
        return choices
            ? (choices[1] ?? "").split(",").map((choice) => place.replace(choices[0], choice))
            : [place];
    });
    expect(places.length).toBe(32);
    expect(places.filter((place) => parsePlace(place) === null)).toEqual([]);
    for (const wrong of [
        "",
        "nodes/a",
        "/nodes",
        "/nodes/a/b/c",
        "/nodes/a//x",
        "/materials/m/x",
    ]) {
        expect(parsePlace(wrong)).toBeNull();
    }
});

test("every message that the server sends is known, others are passed over", () => {
    const table = README.slice(
        README.indexOf("### Server to client"),
        README.indexOf("### Frames"),
    );
    const types = [...table.matchAll(/^\| `(\w+)` \|/gm)].map(([, type = ""]) => type);
    expect(types.length).toBe(10);
    for (const type of types) {
        expect(readMessage(JSON.stringify({ type }))).toEqual({ type });
    }
    for (const other of ['{"type":"hello"}', "[]", "{", "null", '{"type":1}']) {
        expect(readMessage(other)).toBeNull();
    }
});

/* --- frames --- */

const HEADER: FrameHeader = {
    codec: "jpeg",
    key: true,
    still: false,
    lossless: true,
    stale: true,
    depths: true,
    delta: true,
    number: 0x01020304,
    payloadBytes: 5,
    revision: 0x123456789a,
    input: 77,
    width: 640,
    height: 360,
    viewWidth: 1280,
    viewHeight: 720,
    round: 2,
    rounds: 3,
    chain: 5,
    link: 9,
    stages: [1, 2, 0x01020304],
};

test("the header stands at the offsets of the protocol's page", () => {
    const bytes = new Uint8Array(packFrame(HEADER, new Uint8Array([1, 2, 3])));
    const hex = [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
    expect(hex).toBe(
        "46434631" /* FCF1 */ +
            "03013d03" +
            "04030201" +
            "05000000" +
            "9a78563412000000" +
            "4d000000" +
            "8002680100" +
            "05d002" +
            "02030509" +
            "010000000200000004030201" +
            "010203",
    );
    expect(readPacket(bytes.buffer)).toMatchObject({ kind: "head", header: HEADER });
});

test("a picture of the same state and view in lower quality is no reason to change the screen", () => {
    const shown: FrameHeader = { ...HEADER, still: true, lossless: true };
    const moving: FrameHeader = { ...HEADER, still: false, lossless: false };
    expect(isWorse(moving, shown)).toBe(true);
    expect(isWorse(shown, moving)).toBe(false);
    expect(isWorse(shown, shown)).toBe(false);
    expect(isWorse({ ...moving, revision: moving.revision + 1 }, shown)).toBe(false);
    expect(isWorse({ ...moving, input: 78 }, shown)).toBe(false);
    expect(isWorse({ ...moving, viewWidth: 640 }, shown)).toBe(false);
});

test("every flag and codec comes back", () => {
    for (let flags = 0; flags < 16; flags++) {
        const header: FrameHeader = {
            ...HEADER,
            codec: flags & 1 ? "png" : "jpeg",
            key: (flags & 1) !== 0,
            still: (flags & 2) !== 0,
            lossless: (flags & 4) !== 0,
            stale: (flags & 8) !== 0,
        };
        const packet = readPacket(packFrame(header, new Uint8Array()));
        expect(packet).toMatchObject({ kind: "head", header });
    }
});

test("what is no frame is not taken for one", () => {
    const good = packFrame(HEADER, new Uint8Array());
    const broken = (at: number, value: number): ArrayBuffer => {
        const copy = good.slice(0);
        new Uint8Array(copy)[at] = value;
        return copy;
    };
    expect(readPacket(broken(0, 0))).toBeNull();
    expect(readPacket(broken(4, 1))).toBeNull();
    expect(readPacket(broken(5, 9))).toBeNull();
    expect(readPacket(broken(7, 4))).toBeNull(); /* more stages than there are bytes */
    const whole = FRAME_FIXED_BYTES + 4 * HEADER.stages.length;
    for (const length of [0, 4, 7, 8, FRAME_FIXED_BYTES - 1, whole - 1]) {
        expect(readPacket(good.slice(0, length))).toBeNull();
    }
});

function bytesOf(parts: readonly Uint8Array[]): number[] {
    return parts.flatMap((part) => [...part]);
}

function feed(assembler: FrameAssembler, data: ArrayBuffer): number[] | null {
    const packet = readPacket(data);
    const frame = packet && assembler.push(packet, 0);
    return frame ? bytesOf(frame.parts) : null;
}

const head = (number: number, payloadBytes: number, first: number[]): ArrayBuffer =>
    packFrame({ ...HEADER, number, payloadBytes }, new Uint8Array(first));
const part = (number: number, bytes: number[]): ArrayBuffer =>
    packPart(number, new Uint8Array(bytes));

test("a frame in one message, and in parts", () => {
    const assembler = new FrameAssembler();
    expect(feed(assembler, head(1, 3, [1, 2, 3]))).toEqual([1, 2, 3]);
    expect(feed(assembler, head(2, 5, [1, 2]))).toBeNull();
    expect(feed(assembler, part(2, [3]))).toBeNull();
    expect(feed(assembler, part(2, [4, 5]))).toEqual([1, 2, 3, 4, 5]);
});

test("a frame given up makes place for the next", () => {
    const assembler = new FrameAssembler();
    feed(assembler, head(1, 9, [1]));
    feed(assembler, part(1, [2]));
    expect(feed(assembler, head(2, 2, [7]))).toBeNull();
    expect(feed(assembler, part(1, [3]))).toBeNull();
    expect(feed(assembler, part(2, [8]))).toEqual([7, 8]);
});

test("torn frames are dropped and do no harm to the next", () => {
    const assembler = new FrameAssembler();
    expect(feed(assembler, part(1, [1]))).toBeNull();
    expect(feed(assembler, head(1, 2, [1, 2, 3]))).toBeNull();
    feed(assembler, head(2, 4, [1]));
    expect(feed(assembler, part(2, [2, 3, 4, 5]))).toBeNull();
    expect(feed(assembler, part(2, [2, 3, 4]))).toBeNull();
    expect(feed(assembler, head(3, 0xffffffff, [1]))).toBeNull();
    expect(feed(assembler, part(3, [1]))).toBeNull();
    expect(feed(assembler, head(4, 1, [9]))).toEqual([9]);
});

test("random streams: what arrives whole is what was sent", () => {
    const next = random(5);
    const assembler = new FrameAssembler();
    let whole = 0;
    for (let number = 1; number <= 500; number++) {
        const size = Math.floor(next() * 40);
        const payload = Array.from({ length: size }, () => Math.floor(next() * 256));
        const cuts = [0, ...payload.map((_, i) => i).filter(() => next() < 0.1), size];
        const pieces = cuts.slice(1).map((end, i) => payload.slice(cuts[i], end));
        const upTo = next() < 0.3 ? Math.floor(next() * pieces.length) : pieces.length;
        let result: number[] | null = null;
        pieces.slice(0, upTo).forEach((bytes, i) => {
            const data = i === 0 ? head(number, size, bytes) : part(number, bytes);
            result = feed(assembler, data) ?? result;
        });
        if (upTo === pieces.length) {
            expect(result).toEqual(payload);
            whole++;
        } else if (result !== null) {
            expect(result).toEqual(payload); /* the last piece was empty */
        }
    }
    expect(whole).toBeGreaterThan(200);
});

/* --- what is made of frames --- */

test("the state of a frame is the strongest that its flags say", () => {
    expect(frameInfo({ ...HEADER, still: true })).toMatchObject({ state: "lossless", scale: 0.5 });
    expect(frameInfo({ ...HEADER, lossless: false, still: true }).state).toBe("still");
    expect(frameInfo({ ...HEADER, lossless: false }).state).toBe("moving");
});

test("attempts to connect come later and later, never all at once", () => {
    expect(retryDelay(0, 0)).toBe(125);
    expect(retryDelay(3, 0.999)).toBeGreaterThan(1500);
    expect(retryDelay(100, 0.999)).toBeLessThanOrEqual(10_000);
    expect(retryDelay(4, 0.1)).not.toBe(retryDelay(4, 0.9));
});

test("the time from view to picture counts each view once", () => {
    const meter = new Meter();
    const show = (input: number, at: number) =>
        meter.frameShown(
            { header: { ...HEADER, input }, parts: [], firstAt: at - 9, lastAt: at - 5 },
            at - 2,
            at,
        );
    meter.viewSent(1, 100);
    meter.viewSent(2, 150);
    show(1, 160);
    show(1, 170);
    show(2, 190);
    const statistics = meter.read(200);
    expect(statistics).toMatchObject({ fps: 3, receive: 4, present: 2 });
    expect(statistics.decode).toBeCloseTo(3, 9);
    expect(statistics.stages[1]).toBeCloseTo(0.002, 9);
    expect([statistics.photonP50, statistics.photonP95]).toEqual([60, 60]);
    expect(meter.read(5000)).toMatchObject({ fps: 0, stages: statistics.stages });
});

test("times are of frames like the newest, which counts most", () => {
    const meter = new Meter();
    const show = (lossless: boolean, us: number, at: number) =>
        meter.frameShown(
            { header: { ...HEADER, lossless, stages: [us] }, parts: [], firstAt: at, lastAt: at },
            at,
            at,
        );
    show(false, 8000, 10);
    expect(meter.read(10)).toMatchObject({ state: "moving", stages: [8] });
    show(true, 1000, 20);
    expect(meter.read(20)).toMatchObject({ state: "lossless", stages: [1] });
    show(true, 2000, 30);
    const [mean = 0] = meter.read(30).stages;
    expect(mean).toBeCloseTo((2 + 0.8 * 1) / 1.8, 9);
    show(false, 8000, 40);
    expect(meter.read(40).stages).toEqual([8]);
});

test("a view is never larger than the server makes it", () => {
    expect(fitSize(1280, 720)).toEqual({ width: 1280, height: 720 });
    expect(fitSize(8192, 100)).toEqual({ width: 4096, height: 50 });
    expect(fitSize(0.2, 0)).toEqual({ width: 1, height: 1 });
});
