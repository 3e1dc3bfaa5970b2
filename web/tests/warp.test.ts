/* SPDX-License-Identifier: MIT */
/* A picture as another camera sees it, against a plane and a ball whose places are known; depths from
 * bytes and from guides. */
import { deflateSync } from "node:zlib";
import { expect, test } from "vitest";
import { depthsOfGuide, splitDepths } from "../src/link/depths.ts";
import { Meter } from "../src/link/meter.ts";
import { axes, type Camera, DEFAULT_CAMERA, orbit, pan } from "../src/model/camera.ts";
import { projectionOf } from "../src/model/projection.ts";
import { add, dot, length, scale, subtract, type Vector } from "../src/model/transform.ts";
import {
    type Depths,
    FARTHEST_WARP,
    meshOf,
    moveMesh,
    nearCamera,
    type Shot,
    trianglesOf,
} from "../src/model/warp.ts";
import { HEADER, random } from "./fixture.ts";

const SIZE = { width: 640, height: 360 };
const ASPECT = SIZE.width / SIZE.height;
const SIDE = 4;
const FROM: Camera = { ...DEFAULT_CAMERA, position: [0.4, 1.5, 5], target: [0, 0.3, 0], fov: 40 };
const shot = (camera: Camera): Shot => ({ camera, aspect: ASPECT });

type Hit = (from: Vector, along: Vector) => number;

/* A floor at y = -1. */
const floor: Hit = (from, along) =>
    along[1] < 0 ? (from[1] + 1) / -along[1] : Number.POSITIVE_INFINITY;

/* Of radius 1 about the origin. */
const ball: Hit = (from, along) => {
    const b = dot(from, along);
    const root = b * b - dot(from, from) + 1;
    return root >= 0 ? -b - Math.sqrt(root) : Number.POSITIVE_INFINITY;
};

const nearest =
    (...all: readonly Hit[]): Hit =>
    (from, along) =>
        Math.min(...all.map((hit) => hit(from, along)));

const distanceAt = (hit: Hit, x: number, y: number): number => {
    const ray = projectionOf(FROM, SIZE).rayAt({ x, y });
    return hit(ray.from, ray.along);
};

/* As the server makes them: of each block the nearest of its pixels. */
function depthsOf(hit: Hit): Depths {
    const [columns, rows] = [SIZE.width / SIDE, SIZE.height / SIDE];
    const inverses = Float32Array.from({ length: columns * rows }, (_, i) => {
        const [left, top] = [SIDE * (i % columns), SIDE * Math.floor(i / columns)];
        const all = Array.from({ length: SIDE * SIDE }, (_, k) =>
            distanceAt(hit, left + (k % SIDE) + 0.5, top + Math.floor(k / SIDE) + 0.5),
        );
        return 1 / Math.min(...all);
    });
    return { columns, rows, across: SIDE / SIZE.width, down: SIDE / SIZE.height, inverses };
}

interface Corner {
    /* Pixels of the picture, and of the new one. */
    readonly x: number;
    readonly y: number;
    readonly movedX: number;
    readonly movedY: number;
    readonly depth: number;
    readonly w: number;
}

function cornersOf(hit: Hit, to: Camera): Corner[] {
    const mesh = meshOf(depthsOf(hit), shot(FROM));
    const out = new Float32Array(4 * mesh.inverses.length);
    moveMesh(mesh, shot(FROM), shot(to), out);
    return Array.from(mesh.inverses, (_, i) => {
        const [cx, cy, cz, w] = out.slice(4 * i, 4 * i + 4) as unknown as [
            number,
            number,
            number,
            number,
        ];
        return {
            x: (mesh.spots[2 * i] as number) * SIZE.width,
            y: (mesh.spots[2 * i + 1] as number) * SIZE.height,
            movedX: (0.5 + cx / w / 2) * SIZE.width,
            movedY: (0.5 - cy / w / 2) * SIZE.height,
            depth: cz / w,
            w,
        };
    });
}

const isInside = ({ x, y }: Corner): boolean =>
    x >= 0 && x <= SIZE.width && y >= 0 && y <= SIZE.height;

const ORBITED = orbit(FROM, 0.09, 0.03);

/* Pixels between where a corner is and where what it shows is seen from the other camera. */
function errorsOf(hit: Hit, to: Camera, fits: (corner: Corner) => boolean): number[] {
    const [before, after] = [projectionOf(FROM, SIZE), projectionOf(to, SIZE)];
    return cornersOf(hit, to)
        .filter((corner) => isInside(corner) && fits(corner))
        .map(({ x, y, movedX, movedY }) => {
            const ray = before.rayAt({ x, y });
            const spot = after.spotOf(add(ray.from, scale(ray.along, hit(ray.from, ray.along))));
            return Math.hypot(movedX - (spot?.x ?? 1e9), movedY - (spot?.y ?? 1e9));
        });
}

test("corners on a plane are where the other camera sees them", () => {
    const isFloor = ({ x, y }: Corner): boolean => distanceAt(floor, x, y - SIDE) < 30;
    for (const to of [ORBITED, pan(FROM, 20, -14, SIZE.height)]) {
        const errors = errorsOf(floor, to, isFloor);
        expect(errors.length).toBeGreaterThan(4000);
        /* Without the warp they are this far away. */
        const still = cornersOf(floor, to)
            .filter((corner) => isInside(corner) && isFloor(corner))
            .map(({ x, y, movedX, movedY }) => Math.hypot(movedX - x, movedY - y));
        expect(Math.max(...still)).toBeGreaterThan(20);
        expect(Math.max(...errors)).toBeLessThan(1);
    }
});

test("corners on a ball are where the other camera sees them, the rim excepted", () => {
    const faces = ({ x, y }: Corner): boolean => {
        const ray = projectionOf(FROM, SIZE).rayAt({ x, y });
        const far = ball(ray.from, ray.along);
        const normal = add(ray.from, scale(ray.along, far));
        return Number.isFinite(far) && -dot(ray.along, normal) > 0.5;
    };
    const errors = errorsOf(ball, ORBITED, faces);
    expect(errors.length).toBeGreaterThan(800);
    expect(Math.max(...errors)).toBeLessThan(1);
});

test("where nothing is, only the turn of the camera counts", () => {
    const nothing: Hit = () => Number.POSITIVE_INFINITY;
    const { right, up, forward } = axes(ORBITED);
    const half = Math.tan((FROM.fov * Math.PI) / 360);
    for (const { x, y, movedX, movedY, depth } of cornersOf(nothing, ORBITED).filter(isInside)) {
        const { along } = projectionOf(FROM, SIZE).rayAt({ x, y });
        const z = dot(along, forward);
        const u = 0.5 + dot(along, right) / z / half / ASPECT / 2;
        const v = 0.5 - dot(along, up) / z / half / 2;
        expect(Math.hypot(movedX - u * SIZE.width, movedY - v * SIZE.height)).toBeLessThan(0.01);
        expect(depth).toBeCloseTo(1, 6);
    }
});

test("what stands in front keeps its shape, is nearer, and the rest is stretched", () => {
    const hit = nearest(floor, ball);
    const corners = cornersOf(hit, ORBITED);
    const [before, after] = [projectionOf(FROM, SIZE), projectionOf(ORBITED, SIZE)];
    let rim = 0;
    for (const corner of corners.filter(isInside)) {
        /* Pixels of the ball in one of the four blocks. */
        const seen = [-2, 2].flatMap((dx) =>
            [-2, 2].map((dy) => distanceAt(ball, corner.x + dx, corner.y + dy)),
        );
        if (seen.some(Number.isFinite) && !Number.isFinite(distanceAt(ball, corner.x, corner.y))) {
            rim++;
            const { along } = before.rayAt(corner);
            const point = add(FROM.position, scale(along, Math.min(...seen)));
            const spot = after.spotOf(point) ?? { x: 0, y: 0 };
            expect(Math.hypot(corner.movedX - spot.x, corner.movedY - spot.y)).toBeLessThan(4);
        }
    }
    expect(rim).toBeGreaterThan(60);
    const depthAt = (x: number, y: number): number =>
        corners.find((corner) => Math.hypot(corner.x - x, corner.y - y) < 0.01)?.depth ?? 2;
    expect(depthAt(320, 180)).toBeLessThan(depthAt(320, 340));
    expect(depthAt(320, 340)).toBeLessThan(depthAt(320, 0));
});

test("triangles cover the mesh once", () => {
    const mesh = meshOf(depthsOf(floor), shot(FROM));
    const triangles = trianglesOf(mesh);
    let area = 0;
    for (let i = 0; i < triangles.length; i += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => {
            const at = 2 * (triangles[i + k] as number);
            return [mesh.spots[at] as number, mesh.spots[at + 1] as number, 0] as Vector;
        }) as [Vector, Vector, Vector];
        const [p, q] = [subtract(b, a), subtract(c, a)];
        const twice = p[0] * q[1] - p[1] * q[0];
        expect(twice).toBeGreaterThan(0);
        area += twice / 2;
    }
    expect(area).toBeCloseTo(9, 4);
});

test("a camera far away is shown on the way to it", () => {
    expect(nearCamera(FROM, ORBITED)).toBe(ORBITED);
    const next = random(5);
    for (let i = 0; i < 200; i++) {
        const to = orbit(FROM, 4 * next() - 2, next() - 0.5);
        const shown = nearCamera(FROM, to);
        const cosine = dot(axes(FROM).forward, axes(shown).forward);
        expect(Math.acos(Math.min(1, cosine))).toBeLessThan(FARTHEST_WARP * 1.3);
        const way = length(subtract(shown.position, FROM.position));
        expect(way).toBeLessThan(
            FARTHEST_WARP * 1.001 * length(subtract(FROM.position, FROM.target)),
        );
    }
});

/* --- depths --- */

function pack(depths: readonly number[], columns: number, nearestOne: number, side: number): Blob {
    const plain = depths.map((depth, i) => {
        const at = (dx: number, dy: number): number =>
            (i % columns) + dx < 0 ? 0 : (depths[i + dx + dy * columns] ?? 0);
        return (depth - at(-1, 0) - at(0, -1) + at(-1, -1)) & 255;
    });
    const bytes = deflateSync(Uint8Array.from(plain));
    const tail = new DataView(new ArrayBuffer(10));
    tail.setFloat32(0, nearestOne, true);
    tail.setUint16(4, side, true);
    tail.setUint32(6, bytes.length, true);
    return new Blob(["picture", new Uint8Array(bytes), tail], { type: "image/jpeg" });
}

const DEPTHS_HEADER = { ...HEADER, depths: true, width: 11, height: 7 };

test("depths stand behind the bytes of the picture", async () => {
    const next = random(3);
    const told = Array.from({ length: 12 }, () => Math.floor(256 * next()));
    const { picture, depths } = await splitDepths(pack(told, 4, 2, 3), DEPTHS_HEADER);
    expect(await picture.text()).toBe("picture");
    expect(picture.type).toBe("image/jpeg");
    expect(depths).toMatchObject({ columns: 4, rows: 3, across: 3 / 11, down: 3 / 7 });
    told.forEach((depth, i) => {
        expect(depths?.inverses[i]).toBeCloseTo(depth / 510, 6);
    });
});

test("a picture stays where its depths are damaged, or nothing is hit", async () => {
    const { picture, depths } = await splitDepths(pack([1, 2], 2, 1, 3), DEPTHS_HEADER);
    expect([await picture.text(), depths]).toEqual(["picture", null]);
    const none = await splitDepths(pack(Array(12).fill(0), 4, 0, 3), DEPTHS_HEADER);
    expect(none.depths?.inverses.every((inverse) => inverse === 0)).toBe(true);
});

test("a guide tells depths too, of fewer blocks where it is large", () => {
    const base = { input: 1, revision: 1, ids: [], indices: new Uint16Array(0) };
    const small = depthsOfGuide({
        ...base,
        width: 10,
        height: 6,
        distances: Float32Array.from([1, 2, 4, Number.POSITIVE_INFINITY, 8, 5]),
    });
    expect([small.columns, small.rows, small.across, small.down]).toEqual([3, 2, 0.4, 4 / 6]);
    expect([...small.inverses].map((x) => Math.round(1e4 * x))).toEqual([
        10000, 5000, 2500, 0, 1250, 2000,
    ]);
    const [width, height] = [1280, 720];
    const distances = new Float32Array((width / 4) * (height / 4)).fill(3);
    distances[81 * 320 + 201] = 1.5;
    const large = depthsOfGuide({ ...base, width, height, distances });
    expect([large.columns, large.rows]).toEqual([160, 90]);
    expect(large.inverses[40 * 160 + 100]).toBeCloseTo(1 / 1.5, 6);
    expect(large.inverses.filter((inverse) => Math.abs(inverse - 1 / 3) < 1e-6).length).toBe(
        160 * 90 - 1,
    );
});

test("the latency is that of the last views, once enough are measured", () => {
    const meter = new Meter();
    const show = (seq: number, took: number): void => {
        meter.viewSent(seq, 1000 * seq);
        const header = { ...HEADER, codec: "jpeg" as const, number: seq, input: seq };
        meter.frameShown(
            { header, parts: [], firstAt: 0, lastAt: 0 },
            1000 * seq,
            1000 * seq + took,
        );
    };
    for (let seq = 1; seq <= 4; seq++) {
        show(seq, 500);
        expect(meter.latency()).toBe(null);
    }
    show(5, 400);
    expect(meter.latency()).toBe(500);
    for (let seq = 6; seq <= 14; seq++) {
        show(seq, seq);
    }
    expect(meter.latency()).toBe(10);
});
