/* SPDX-License-Identifier: MIT */
/* Vectors, rotations, cameras, bounds. */
import { expect, test } from "vitest";
import { ballOf } from "../src/model/bounds.ts";
import {
    axes,
    type Box,
    type Camera,
    cameraOf,
    distance,
    dolly,
    frame,
    frameBox,
    orbit,
    pan,
    pointUnder,
    printCamera,
    unitsPerPixel,
    viewFrom,
} from "../src/model/camera.ts";
import type { SceneDocument } from "../src/model/document.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { moveNodes } from "../src/model/edits.ts";
import type { Json } from "../src/model/json.ts";
import { landingBeside, landingTransform } from "../src/model/landing.ts";
import {
    add,
    anglesOf,
    apply,
    dot,
    fromWorld,
    length,
    type Matrix,
    normalize,
    rotation,
    scale,
    standingUnder,
    subtract,
    toWorld,
    transformUnder,
    type Vector,
} from "../src/model/transform.ts";
import { random, SCHEMA, scene } from "./fixture.ts";

function close(a: Vector, b: Vector, tolerance = 1e-9): void {
    expect(length(subtract(a, b))).toBeLessThanOrEqual(tolerance);
}

function closeMatrix(a: Matrix, b: Matrix): void {
    for (const i of [0, 1, 2] as const) {
        close(a[i], b[i], 1e-6);
    }
}

const randomVector = (next: () => number, size: number): Vector => [
    (next() - 0.5) * size,
    (next() - 0.5) * size,
    (next() - 0.5) * size,
];

test("R = Rz Ry Rx: x turns first", () => {
    const quarter = Math.PI / 2;
    close(apply(rotation([quarter, 0, 0]), [0, 1, 0]), [0, 0, 1]);
    close(apply(rotation([0, quarter, 0]), [0, 0, 1]), [1, 0, 0]);
    close(apply(rotation([0, 0, quarter]), [1, 0, 0]), [0, 1, 0]);
    close(apply(rotation([quarter, 0, quarter]), [0, 1, 0]), [0, 0, 1]);
});

test("angles come back from their rotation, near to what they were", () => {
    const next = random(2);
    for (let i = 0; i < 2000; i++) {
        const angles = randomVector(next, 20);
        const matrix = rotation(angles);
        closeMatrix(rotation(anglesOf(matrix)), matrix);
        close(anglesOf(matrix, angles), angles, 1e-6);
    }
    for (const y of [Math.PI / 2, -Math.PI / 2]) {
        const matrix = rotation([0.3, y, 0.7]);
        closeMatrix(rotation(anglesOf(matrix, [0.3, y, 0.7])), matrix);
    }
});

const NESTED = readDocument({
    root: {
        id: "root",
        type: "union",
        transform: { translation: [1, 2, 3], rotation: [0.1, 0.2, 0.3], scale: 2 },
        children: [
            {
                id: "a",
                type: "group",
                transform: { rotation: [1, 0, 0], translation: [0, 5, 0] },
                children: [
                    { id: "x", type: "sphere", transform: { rotation: [0, 1, 0], scale: 3 } },
                ],
            },
            { id: "b", type: "group", transform: { scale: 0.5, rotation: [0, 0, 2] } },
            { id: "c", type: "group", transform: { scale: [1, 2, 1] } },
        ],
    },
});

const QUARTER = Math.PI / 2;

function turned(rotation: Json, parentRotation: Json): SceneDocument {
    return readDocument({
        root: {
            id: "root",
            type: "union",
            children: [
                {
                    id: "from",
                    type: "group",
                    transform: { translation: [1, 0, 0], scale: 2, rotation: parentRotation },
                    children: [{ id: "x", type: "sphere", transform: { rotation } }],
                },
                { id: "to", type: "group", transform: { rotation: parentRotation } },
            ],
        },
    });
}

const rotationOps = (document: SceneDocument, into: string) =>
    moveNodes(document, ["x"], { into, before: null }).ops.filter(
        (op) => op.op === "set" && op.at.endsWith("/rotation"),
    );

test("angles that nothing turns are not written again", () => {
    for (const angles of [
        [QUARTER, 0, 0],
        [0, QUARTER, 0],
        [1.5708, 3, -4],
        [7, QUARTER, 8],
    ]) {
        expect(rotationOps(turned(angles, [0, 0, 0]), "to")).toEqual([]);
        expect(rotationOps(turned(angles, [0.1, 0.2, 0.3]), "to")).toEqual([]);
    }
});

test("angles that are turned are whole degrees to the last bit where they are whole", () => {
    const document = turned([QUARTER, 0, 0], [Math.PI / 6, 0, 0]);
    expect(rotationOps(document, "root")).toEqual([
        { op: "set", at: "/nodes/x/transform/rotation", value: [(120 * Math.PI) / 180, 0, 0] },
    ]);
});

test("world and own space are inverse, and a new parent keeps the place", () => {
    const point: Vector = [0.3, -0.4, 0.5];
    close(fromWorld(NESTED, "x", toWorld(NESTED, "x", point)), point);
    const transform = transformUnder(NESTED, "x", "b");
    expect(transform).not.toBeNull();
    const nodes = new Map(NESTED.nodes);
    const node = nodes.get("x");
    if (node && transform) {
        nodes.set("x", { ...node, parent: "b", transform: { ...transform } });
    }
    close(toWorld({ ...NESTED, nodes }, "x", point), toWorld(NESTED, "x", point), 1e-6);
    expect(transformUnder(NESTED, "x", "c")).toBeNull();
});

const CAMERA: Camera = {
    position: [0, 1, 5],
    target: [0, 1, 0],
    up: [0, 1, 0],
    fov: 45,
    height: null,
};
const FLAT: Camera = { ...CAMERA, height: 3 };

/* Where a point of the world is seen, in pixels of a view. */
function seenAt(camera: Camera, point: Vector, width: number, height: number): number[] {
    const { right, up, forward } = axes(camera);
    const to = subtract(point, camera.position);
    const tangent = Math.tan((camera.fov * Math.PI) / 360);
    const half = camera.height === null ? dot(to, forward) * tangent : camera.height / 2;
    const scaled = height / 2 / half;
    return [width / 2 + dot(to, right) * scaled, height / 2 - dot(to, up) * scaled];
}

test("orbit keeps the distance, goes right and up, and stops at the poles", () => {
    const right = orbit(CAMERA, 0.1, 0);
    expect(right.position[0]).toBeGreaterThan(0);
    const raised = orbit(CAMERA, 0, 0.1);
    expect(raised.position[1]).toBeGreaterThan(1);
    expect(distance(orbit(CAMERA, 1, 0.5))).toBeCloseTo(5, 9);
    const top = orbit(CAMERA, 0, 10);
    expect(top.position[1]).toBeCloseTo(6, 2);
    expect(axes(top).up[1]).toBeGreaterThan(0);
    close(orbit(orbit(CAMERA, 0.4, 0.2), -0.4, -0.2).position, CAMERA.position, 1e-9);
});

test("pan moves what is at the target by exactly the pointer's way", () => {
    const height = 400;
    const moved = pan(CAMERA, 10, 0, height);
    expect(moved.target[0]).toBeCloseTo(-10 * unitsPerPixel(CAMERA, height), 9);
    close(subtract(moved.position, moved.target), subtract(CAMERA.position, CAMERA.target));
    expect(pan(CAMERA, 0, 10, height).target[1]).toBeGreaterThan(1);
});

test("a camera beyond the limits of a dolly comes back to them in steps", () => {
    const at = (far: number) => ({ ...CAMERA, position: add(CAMERA.target, [0, 0, far]) });
    expect(distance(dolly(at(1e6), 0.8))).toBeCloseTo(8e5, 0);
    expect(distance(dolly(at(1e6), 1.25))).toBeCloseTo(1e6, 0);
    expect(distance(dolly(at(1e-5), 1.25))).toBeCloseTo(1.25e-5, 9);
    expect(distance(dolly(at(1e4), 1e6))).toBeCloseTo(1e5, 0);
});

test("dolly keeps what lies under the pointer, with perspective or without", () => {
    const pointer = { x: 100, y: 50, width: 640, height: 360 };
    for (const camera of [CAMERA, FLAT, { ...CAMERA, position: [2, 4, 1] as Vector }]) {
        const point = pointUnder(camera, pointer);
        const nearer = dolly(camera, 0.5, pointer);
        for (const one of [camera, nearer]) {
            const [x = 0, y = 0] = seenAt(one, point, pointer.width, pointer.height);
            expect([x, y].map((side) => Math.round(side * 1e6) / 1e6)).toEqual([100, 50]);
        }
        expect(distance(nearer)).toBeCloseTo(distance(camera) / 2, 9);
    }
    expect(dolly(FLAT, 0.5).height).toBe(1.5);
    expect(distance(dolly(CAMERA, 0))).toBeGreaterThan(0);
});

test("the middle of the view is the target", () => {
    close(pointUnder(FLAT, { x: 320, y: 180, width: 640, height: 360 }), FLAT.target);
});

test("a camera without perspective keeps its height where it frames, reads and prints", () => {
    const ball = { center: [3, 0, 0] as Vector, radius: 2 };
    for (const aspect of [0.5, 1, 2]) {
        const high = frame(FLAT, ball, aspect).height ?? 0;
        expect(Math.min(high, high * aspect)).toBeGreaterThan(4);
        expect(Math.min(high, high * aspect)).toBeLessThan(5);
    }
    const read = cameraOf({ type: "orthographic" }, { height: 4, fov: 30 });
    expect(read.height).toBe(4);
    expect(printCamera(read)).toMatchObject({ height: 4 });
    expect(printCamera(read)).not.toHaveProperty("fov");
    expect(cameraOf({ type: "perspective", height: 9 }).height).toBeNull();
});

test("framing shows the whole ball, high or wide", () => {
    const ball = { center: [3, 0, 0] as Vector, radius: 2 };
    for (const aspect of [0.5, 1, 2]) {
        const framed = frame(CAMERA, ball, aspect);
        close(framed.target, ball.center);
        const half = Math.asin(ball.radius / distance(framed));
        const vertical = (framed.fov * Math.PI) / 360;
        const horizontal = Math.atan(Math.tan(vertical) * aspect);
        expect(half).toBeLessThan(Math.min(vertical, horizontal));
        expect(half).toBeGreaterThan(0.7 * Math.min(vertical, horizontal));
    }
});

/* From the middle of the view to its edge along an axis of the picture, 1. */
function placeIn(camera: Camera, aspect: number, p: Vector): [number, number] {
    const { right, up, forward } = axes(camera);
    const from = subtract(p, camera.position);
    const half =
        camera.height === null
            ? Math.tan((camera.fov * Math.PI) / 360) * dot(from, forward)
            : camera.height / 2;
    return [dot(from, right) / half / aspect, dot(from, up) / half];
}

const BOXES: readonly Box[] = [
    { low: [2, -1, 0.5], high: [2.5, 5, 1] } /* high */,
    { low: [-3, 0, -4], high: [5, 0.5, 3] } /* wide and deep */,
];

test.each(BOXES)("framing a box leaves the same room around it, however it is turned", (box) => {
    const ends = [box.low, box.high];
    for (const aspect of [0.4, 1, 2.5]) {
        for (const seen of [CAMERA, FLAT, orbit(CAMERA, 1, 0.4)]) {
            const framed = frameBox(seen, box, aspect);
            close(framed.target, scale(add(box.low, box.high), 0.5));
            const reach = ends.flatMap((x) =>
                ends.flatMap((y) =>
                    ends.flatMap((z) => placeIn(framed, aspect, [x[0], y[1], z[2]]).map(Math.abs)),
                ),
            );
            expect(Math.max(...reach)).toBeLessThan(0.9);
            expect(Math.max(...reach)).toBeGreaterThan(0.75);
        }
    }
});

test("fixed views look along their axis with the picture upright", () => {
    close(axes(viewFrom(CAMERA, "right")).forward, [-1, 0, 0]);
    close(axes(viewFrom(CAMERA, "top")).up, [0, 0, -1], 0.02);
    expect(distance(viewFrom(CAMERA, "top"))).toBeCloseTo(5, 9);
});

test("a camera is read with defaults and printed with few digits", () => {
    expect(cameraOf({ position: [1, 2, 3] }, { fov: 50 })).toMatchObject({
        position: [1, 2, 3],
        fov: 50,
    });
    expect(printCamera({ ...CAMERA, position: [1 / 3, 0, 0] }).position).toEqual([0.333333, 0, 0]);
});

test("the ball of what has no length of its own is where that is", () => {
    const transform = { translation: [5, 1, 0] };
    const document = readDocument({
        models: {
            pawn: {
                id: "pawn-root",
                type: "group",
                children: [
                    {
                        id: "foot",
                        type: "sphere",
                        params: { radius: 0.2 },
                        transform: { translation: [0, 1, 0] },
                    },
                ],
            },
        },
        root: {
            id: "root",
            type: "union",
            children: [
                {
                    id: "sign",
                    type: "extrude",
                    transform,
                    children: [
                        { id: "outline", type: "polygon", transform: { translation: [0, 2, 0] } },
                    ],
                },
                { id: "one", type: "model", transform, params: { model: "pawn" } },
                { id: "nothing", type: "group", transform },
                { id: "hidden", type: "sphere", visible: false, transform },
            ],
        },
    });
    const center = (id: string) => ballOf(document, SCHEMA, [id]).center;
    close(center("outline"), [5, 3, 0]);
    close(center("sign"), [5, 3, 0]);
    close(center("one"), [5, 2, 0]);
    close(center("nothing"), [5, 1, 0]);
    close(center("hidden"), [5, 1, 0]);
});

test("the ball of a node holds it, through its parents", () => {
    const document = scene();
    const head = ballOf(document, SCHEMA, ["head"]);
    close(head.center, [0, 1.3, 0]);
    expect(head.radius).toBeGreaterThanOrEqual(0.6);
    const all = ballOf(document, SCHEMA);
    expect(all.radius + 1e-9).toBeGreaterThanOrEqual(length(subtract(head.center, all.center)));
    expect(ballOf(document, SCHEMA, ["hat"]).radius).toBe(1); /* hidden: nothing to see */
    close(ballOf(NESTED, SCHEMA, ["x"]).center, toWorld(NESTED, "x", [0, 0, 0]));
});

test("what stands on a surface has its y axis along the normal, below any parent", () => {
    const next = random(11);
    for (let i = 0; i < 200; i++) {
        const document = readDocument({
            format: "fieldcast/1",
            root: {
                id: "root",
                type: "union",
                transform: { rotation: [...randomVector(next, 6)], scale: 0.5 + next() },
                children: [
                    {
                        id: "parent",
                        type: "union",
                        transform: { translation: [...randomVector(next, 4)] },
                    },
                ],
            },
        });
        const at = randomVector(next, 5);
        const up = normalize(i === 0 ? [0, -1, 0] : randomVector(next, 2));
        const placed = standingUnder(document, "parent", at, up, [0, 0, 0]);
        close(toWorld(document, "parent", placed.translation), at, 1e-9);
        const tip = apply(rotation(placed.rotation), [0, 1, 0]);
        const raised = subtract(
            toWorld(document, "parent", tip),
            toWorld(document, "parent", [0, 0, 0]),
        );
        close(normalize(raised), up, 1e-6);
    }
});

test("what stands upright is not turned; where a scale is not uniform it keeps its own turn", () => {
    const document = readDocument({
        format: "fieldcast/1",
        root: {
            id: "root",
            type: "union",
            children: [{ id: "flat", type: "union", transform: { scale: [1, 2, 1] } }],
        },
    });
    const ground = { at: [1, 2, 3], normal: [0, 1, 1e-5] } as const;
    expect(landingTransform(document, "root", ground)).toEqual({ translation: [1, 2, 3] });
    const own = { rotation: [0.5, 0, 0], scale: 2 };
    const sideways = { at: [1, 2, 3], normal: [1, 0, 0] } as const;
    expect(landingTransform(document, "flat", sideways, own)).toEqual({
        rotation: [0.5, 0, 0],
        scale: 2,
        translation: [1, 1, 3],
    });
});

test("what lands is combined with what is selected there, else with the shape, never inside a modifier", () => {
    const document = readDocument({
        format: "fieldcast/1",
        models: { nut: { id: "thread", type: "sphere" } },
        root: {
            id: "root",
            type: "union",
            children: [
                { id: "pair", type: "union", children: [{ id: "ball", type: "sphere" }] },
                { id: "twirl", type: "extrude", children: [{ id: "bar", type: "circle" }] },
            ],
        },
    });
    const beside = (selection: string[], seen: string | null) =>
        landingBeside(document, SCHEMA, selection, seen);
    expect(beside([], "ball")).toEqual(["ball"]);
    expect(beside(["pair"], "ball")).toEqual(["pair"]);
    expect(beside(["root"], "ball")).toEqual(["ball"]);
    expect(beside(["twirl", "pair"], "bar")).toEqual(["twirl"]);
    expect(beside([], "bar")).toEqual(["twirl"]);
    expect(beside(["ball"], null)).toEqual([]);
    expect(beside([], "thread")).toEqual([]);
});
