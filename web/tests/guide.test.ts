/* SPDX-License-Identifier: MIT */
/* Guides: from bytes to nodes under a point, distances and masks, and when they belong to what is shown. */
import { deflateSync } from "node:zlib";
import { expect, test } from "vitest";
import type { Frame } from "../src/link/decode.ts";
import { decodeGuide } from "../src/link/guide.ts";
import { packFrame, readPacket } from "../src/link/protocol.ts";
import { DEFAULT_CAMERA } from "../src/model/camera.ts";
import { distanceAt, surfaceAt } from "../src/model/distances.ts";
import {
    contourOf,
    DISTANCE_STEP,
    type Guide,
    nodeAt,
    nodesIn,
    shownGuide,
} from "../src/model/guide.ts";
import { projectionOf } from "../src/model/projection.ts";
import { IDLE_LINK, NO_FRAME } from "../src/model/stores.ts";
import { add, length, scale, subtract, type Vector } from "../src/model/transform.ts";
import { HEADER, random } from "./fixture.ts";

const samplesOf = (side: number): number => Math.ceil(side / DISTANCE_STEP);

/* As protocol/README.md has it: 0 nothing, 65535 the nearest, 1 the farthest. */
function packDepths(distances: readonly number[], width: number): Buffer {
    const hit = distances.filter(Number.isFinite);
    const [nearest, farthest] = hit.length > 0 ? [Math.min(...hit), Math.max(...hit)] : [0, 0];
    const folds = Math.log(farthest / nearest) || 1;
    const depths = distances.map((far) =>
        Number.isFinite(far) ? Math.round(65535 - (65534 * Math.log(far / nearest)) / folds) : 0,
    );
    const head = Buffer.alloc(8);
    head.writeFloatLE(nearest);
    head.writeFloatLE(farthest, 4);
    const bytes = Buffer.alloc(2 * depths.length);
    depths.forEach((depth, i) => {
        const at = (dx: number, dy: number): number =>
            (i % width) + dx < 0 ? 0 : (depths[i + dx + dy * width] ?? 0);
        const apart = ((depth - at(-1, 0) - at(0, -1) + at(-1, -1) + 0x18000) & 0xffff) - 0x8000;
        const folded = apart < 0 ? -2 * apart - 1 : 2 * apart;
        bytes[i] = folded & 255;
        bytes[depths.length + i] = folded >> 8;
    });
    return Buffer.concat([head, bytes]);
}

/* As the server writes it, in parts of `size` bytes; nothing is hit unless `distances` says where. */
function frameOf(
    ids: readonly string[],
    indices: readonly number[],
    size = 1000,
    width = 6,
    height = 4,
    distances: readonly number[] = new Array(samplesOf(width) * samplesOf(height)).fill(
        Number.POSITIVE_INFINITY,
    ),
): Frame {
    const names = ids.map((id) => Buffer.from(id));
    const head = Buffer.alloc(2);
    head.writeUInt16LE(ids.length);
    const pixels = Buffer.alloc(2 * indices.length);
    indices.forEach((index, i) => {
        pixels.writeUInt16LE(index, 2 * i);
    });
    const depths = packDepths(distances, samplesOf(width));
    const payload = Buffer.concat([
        head,
        ...names.flatMap((name) => [Buffer.from([name.length]), name]),
        depths.subarray(0, 8),
        deflateSync(Buffer.concat([pixels, depths.subarray(8)])),
    ]);
    const parts: Uint8Array<ArrayBuffer>[] = [];
    for (let at = 0; at < payload.length; at += size) {
        parts.push(Uint8Array.from(payload.subarray(at, at + size)));
    }
    return { header: { ...HEADER, width, height }, parts, firstAt: 0, lastAt: 0 };
}

/* Segments as texts, their ends in order. */
function pairs(segments: readonly number[]): string[] {
    const texts: string[] = [];
    for (let i = 0; i < segments.length; i += 4) {
        const [a, b, c, d] = segments.slice(i, i + 4);
        texts.push([`${a},${b}`, `${c},${d}`].sort().join(" "));
    }
    return texts.sort();
}

/* How many segments end at a point. */
function endsOf(segments: readonly number[]): Map<string, number> {
    const ends = new Map<string, number>();
    for (let i = 0; i < segments.length; i += 2) {
        const key = `${segments[i]},${segments[i + 1]}`;
        ends.set(key, (ends.get(key) ?? 0) + 1);
    }
    return ends;
}

const INDICES = [
    ...[0, 0, 0, 0, 0, 0],
    ...[0, 1, 1, 2, 0, 0],
    ...[0, 1, 3, 2, 2, 0],
    ...[0, 0, 0, 0, 0, 3],
];
const IDS = ["ball", "Küche", "box"];

test("the bytes of a frame become ids and indices, in whatever parts they come", async () => {
    for (const size of [1, 3, 1000]) {
        const guide = await decodeGuide(frameOf(IDS, INDICES, size));
        expect(guide).toMatchObject({ input: 5, revision: 12, width: 6, height: 4, ids: IDS });
        expect([...guide.indices]).toEqual(INDICES);
    }
});

test("the header of a guide is read as one", () => {
    const packet = readPacket(packFrame(HEADER, new Uint8Array([1, 2])));
    expect(packet).toMatchObject({ kind: "head", header: { codec: "guide", revision: 12 } });
});

test("damaged bytes are refused", async () => {
    const short = frameOf(IDS, INDICES.slice(1));
    await expect(decodeGuide(short)).rejects.toThrow();
    const torn = frameOf(IDS, INDICES);
    const parts = torn.parts.map((part) => part.slice(0, -8));
    await expect(decodeGuide({ ...torn, parts })).rejects.toThrow();
    await expect(decodeGuide({ ...torn, parts: [] })).rejects.toThrow();
});

test("the node under a point is that of its pixel; outside, that of the nearest", async () => {
    const guide = await decodeGuide(frameOf(IDS, INDICES));
    INDICES.forEach((index, i) => {
        const [u, v] = [((i % 6) + 0.5) / 6, (Math.floor(i / 6) + 0.5) / 4];
        expect(nodeAt(guide, u, v)).toBe(IDS[index - 1] ?? null);
    });
    expect(nodeAt(guide, 1.5, 1)).toBe("box");
    expect(nodeAt(guide, -0.1, 0)).toBe(null);
});

test("distances come back within half a step, also on both sides of an edge", async () => {
    const next = random(9);
    for (let round = 0; round < 20; round++) {
        const [width, height] = [9 + Math.floor(next() * 9), 1 + Math.floor(next() * 20)];
        const count = samplesOf(width) * samplesOf(height);
        const wanted = Array.from({ length: count }, () =>
            next() < 0.2 ? Number.POSITIVE_INFINITY : 0.1 * 10000 ** next(),
        );
        const indices = new Array(width * height).fill(0);
        const guide = await decodeGuide(frameOf([], indices, 50, width, height, wanted));
        expect(guide.distances.length).toBe(count);
        wanted.forEach((far, i) => {
            const got = guide.distances[i] as number;
            expect(Number.isFinite(got)).toBe(Number.isFinite(far));
            expect(far === got || Math.abs(Math.log(got / far)) < 1e-4).toBe(true);
        });
    }
});

/* A wall at z = 0 and a square before it at z = 1, seen by a camera: node 1 and 2, nothing above. */
function wallGuide(width: number, height: number) {
    const camera = { ...DEFAULT_CAMERA, position: [0.4, 0.3, 6] as Vector };
    const projection = projectionOf(camera, { width, height });
    const meet = (x: number, y: number): { node: number; at: Vector | null } => {
        const { from, along } = projection.rayAt({ x: x + 0.5, y: y + 0.5 });
        const on = (z: number): Vector => add(from, scale(along, (z - from[2]) / along[2]));
        const [near, far] = [on(1), on(0)];
        const front = Math.max(Math.abs(near[0]), Math.abs(near[1])) < 0.5;
        return front
            ? { node: 2, at: near }
            : far[1] < 1
              ? { node: 1, at: far }
              : { node: 0, at: null };
    };
    const all = Array.from({ length: width * height }, (_, i) =>
        meet(i % width, Math.floor(i / width)),
    );
    const distances = all
        .filter((_, i) => (i % width) % DISTANCE_STEP === 0)
        .filter((_, i) => Math.floor(i / samplesOf(width)) % DISTANCE_STEP === 0)
        .map(({ at }) => (at ? length(subtract(at, camera.position)) : Number.POSITIVE_INFINITY));
    return {
        ...{ projection, all },
        guide: {
            ...{ input: 1, revision: 1, width, height, ids: ["wall", "square"] },
            indices: Uint16Array.from(all, ({ node }) => node),
            distances: Float32Array.from(distances),
        } satisfies Guide,
    };
}

/* All pixels around show the same node. */
function isInner(all: readonly { node: number }[], width: number, x: number, y: number): boolean {
    const reach = Array.from({ length: 9 }, (_, i) => i - 4);
    const { node } = all[y * width + x] as { node: number };
    return reach.every((dy) =>
        reach.every((dx) => all[(y + dy) * width + x + dx]?.node === node && x + dx < width),
    );
}

test("a place between the pixels that have a distance is on the surface of its own node", () => {
    const [width, height] = [121, 83];
    const { guide, projection, all } = wallGuide(width, height);
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const { at } = all[y * width + x] as { at: Vector | null };
            const got = surfaceAt(guide, projection, { x: x + 0.5, y: y + 0.5 });
            expect(got === null).toBe(at === null);
            const far = at && got ? length(subtract(at, got)) : 0;
            /* At an edge, what is on the other side of it tells nothing. */
            expect(far).toBeLessThan(isInner(all, width, x, y) ? 4e-3 : 0.06);
        }
    }
});

test("where no pixel around is of the same node, the nearest one says how far", () => {
    const indices = Uint16Array.from({ length: 25 }, (_, i) => Number(i === 12));
    const distances = Float32Array.from([3, 5, 7, 9]);
    const guide: Guide = {
        input: 1,
        revision: 1,
        width: 5,
        height: 5,
        ids: ["a"],
        indices,
        distances,
    };
    expect(distanceAt(guide, 2.4 / 5, 2.4 / 5)).toBe(3);
    expect(distanceAt(guide, 2.6 / 5, 2.4 / 5)).toBe(5);
    expect(distanceAt(guide, 2, 2)).toBe(9);
});

test("a rectangle names what is seen in it, each once", async () => {
    const twice = await decodeGuide(frameOf(["ball", "ball", "box"], INDICES));
    const guide = await decodeGuide(frameOf(IDS, INDICES));
    expect(nodesIn(guide, 0, 0, 1, 1)).toEqual(IDS);
    expect(nodesIn(twice, 0, 0, 1, 1)).toEqual(["ball", "box"]);
    expect(nodesIn(guide, 0, 0, 0.99, 0.24)).toEqual([]);
    expect(nodesIn(guide, 1.5 / 6, 1.5 / 4, 2.5 / 6, 1.5 / 4)).toEqual(["ball"]);
    expect(nodesIn(guide, 3.5 / 6, 2.5 / 4, 7, 7)).toEqual(["Küche", "box"]);
});

test("a contour goes around the pixels of its nodes", async () => {
    const guide = await decodeGuide(frameOf(["a", "b", "c"], [0, 0, 0, 0, 1, 0, 0, 0, 0], 9, 3, 3));
    const segments = contourOf(guide, new Set(["a", "nobody"]));
    expect(pairs(segments)).toEqual(["1,1.5 1.5,1", "1,1.5 1.5,2", "1.5,1 2,1.5", "1.5,2 2,1.5"]);
    expect(contourOf(guide, new Set(["b"]))).toEqual([]);
    expect(contourOf(guide, new Set())).toEqual([]);
});

test("the border of the picture is no contour", async () => {
    const guide = await decodeGuide(frameOf(["a"], [1, 1, 1, 1, 1, 1], 9, 3, 2));
    expect(contourOf(guide, new Set(["a"]))).toEqual([]);
});

/* A line through the middles of pixels crosses the contour as often as it goes in or out. */
test("contours of random guides part what is inside from what is not", () => {
    const next = random(5);
    for (let round = 0; round < 200; round++) {
        const [width, height] = [2 + Math.floor(next() * 9), 2 + Math.floor(next() * 9)];
        const indices = Uint16Array.from({ length: width * height }, () => Math.floor(next() * 4));
        const distances = new Float32Array();
        const guide: Guide = { input: 1, revision: 1, width, height, ids: IDS, indices, distances };
        const nodes = new Set(IDS.filter(() => next() < 0.5));
        const ends = endsOf(contourOf(guide, nodes));
        const inside = (x: number, y: number): boolean =>
            nodes.has(IDS[(indices[y * width + x] ?? 0) - 1] ?? "");
        for (let y = 0; y < height; y++) {
            for (let x = 0; x < width - 1; x++) {
                const changes = inside(x, y) !== inside(x + 1, y);
                const squares = Number(y > 0) + Number(y < height - 1);
                expect(ends.get(`${x + 1},${y + 0.5}`) ?? 0).toBe(changes ? squares : 0);
            }
        }
        for (let y = 0; y < height - 1; y++) {
            for (let x = 0; x < width; x++) {
                const changes = inside(x, y) !== inside(x, y + 1);
                const squares = Number(x > 0) + Number(x < width - 1);
                expect(ends.get(`${x + 0.5},${y + 1}`) ?? 0).toBe(changes ? squares : 0);
            }
        }
    }
});

test("a guide is shown with its own picture alone", () => {
    const guide: Guide = {
        input: 5,
        revision: 12,
        width: 0,
        height: 0,
        ids: [],
        indices: new Uint16Array(),
        distances: new Float32Array(),
    };
    const frame = { ...NO_FRAME, input: 5, revision: 12 };
    const shown = (change: object): Guide | null =>
        shownGuide({ ...IDLE_LINK, guide, frame: { ...frame, ...change } });
    expect(shown({})).toBe(guide);
    expect(shown({ input: 6 })).toBe(null);
    expect(shown({ revision: 13 })).toBe(null);
    expect(shown({ outdated: true })).toBe(null);
    expect(shownGuide({ ...IDLE_LINK, frame })).toBe(null);
});
