/* SPDX-License-Identifier: MIT */
/* Hands in the picture, without a browser: projections, what a drag means in the world, and what it
 * makes of a document. */
import { expect, test } from "vitest";
import { axes, type Camera, cameraOf, DEFAULT_CAMERA } from "../src/model/camera.ts";
import type { SceneDocument } from "../src/model/document.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { clearOf, gizmoParts, type Part, partAt } from "../src/model/gizmo.ts";
import {
    AXES,
    type Axis,
    axisOf,
    type Constraint,
    type Delta,
    deltaOf,
    deltaTo,
    type Grip,
} from "../src/model/grip.ts";
import type { Pivot } from "../src/model/hands.ts";
import {
    frameOf,
    IDENTITY,
    motionOps,
    movablesOf,
    moved,
    pivotOf,
    turnMatrix,
} from "../src/model/movables.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply as applyOperations } from "../src/model/operations.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { snapTo, surfaceUnder, targetsOf } from "../src/model/snapping.ts";
import {
    add,
    apply,
    length,
    type Matrix,
    normalize,
    product,
    rotation,
    scale,
    subtract,
    toWorld,
    turnAbout,
    type Vector,
} from "../src/model/transform.ts";
import { random, SCHEMA } from "./fixture.ts";

const SIZE = { width: 900, height: 600 };
const next = random(14);
const within = (size: number): Vector => [
    (next() - 0.5) * size,
    (next() - 0.5) * size,
    (next() - 0.5) * size,
];
const close = (a: Vector, b: Vector, tolerance = 1e-6): void =>
    expect(length(subtract(a, b))).toBeLessThanOrEqual(tolerance);

function someCamera(): Camera {
    return {
        ...DEFAULT_CAMERA,
        position: add(within(4), [0, 0, 9]),
        target: within(2),
        fov: 20 + next() * 60,
        height: next() < 0.3 ? 3 + next() * 5 : null,
    };
}

const someGrip = (constraint: Constraint, frame: Matrix): Grip => {
    const projection = projectionOf(someCamera(), SIZE);
    const pivot = within(2);
    return {
        constraint,
        pivot,
        frame,
        projection,
        from: projection.spotOf(pivot) ?? { x: 0, y: 0 },
    };
};

test("a ray through the place of a point meets the point", () => {
    for (let i = 0; i < 500; i++) {
        const projection = projectionOf(someCamera(), SIZE);
        const point = within(3);
        const spot = projection.spotOf(point);
        expect(spot).not.toBeNull();
        const ray = projection.rayAt(spot ?? { x: 0, y: 0 });
        const far = length(subtract(point, ray.from));
        close(add(ray.from, scale(ray.along, far)), point);
    }
});

test("what is behind the camera has no place", () => {
    const projection = projectionOf(DEFAULT_CAMERA, SIZE);
    expect(projection.spotOf([0, 1.5, 7])).toBeNull();
});

/* The closed form: the hand goes to where the moved pivot is seen, so the move must come out. */
test("1,000 random drags along axes and in planes give the move that was seen", () => {
    for (let i = 0; i < 1000; i++) {
        const frame = rotation(within(6));
        const axis = (i % 3) as Axis;
        const plane = i % 2 === 0;
        const grip = someGrip({ motion: "move", axis, plane }, frame);
        const view = grip.projection.towards(grip.pivot);
        const slant = Math.abs(axisOf(frame, axis).reduce((s, x, k) => s + x * (view[k] ?? 0), 0));
        if (plane ? slant < 0.2 : slant > 0.95) {
            continue;
        }
        const arms = AXES.map((one) => ((one === axis) !== plane ? (next() - 0.5) * 2 : 0));
        const by = apply(frame, [arms[0] ?? 0, arms[1] ?? 0, arms[2] ?? 0]);
        const to = grip.projection.spotOf(add(grip.pivot, by));
        const delta = to && deltaTo(grip, to);
        close(delta?.motion === "move" ? delta.by : [9, 9, 9], by);
    }
});

/* Four units above a floor, whose horizon is across the middle of the picture. */
const LEVEL = projectionOf({ ...DEFAULT_CAMERA, position: [0, 4, 10], target: [0, 4, 0] }, SIZE);
const onFloor = (from: Spot): Grip => ({
    constraint: { motion: "move", axis: 1, plane: true },
    pivot: [0, 0, 0],
    frame: IDENTITY,
    projection: LEVEL,
    from,
});
const above = (spot: Spot, by: number): Spot => ({ x: spot.x, y: SIZE.height / 2 - by });

test("a hand above the horizon of its plane brings nothing behind the camera, or out of sight", () => {
    const middle = LEVEL.spotOf([0, 0, 0]) ?? { x: 0, y: 0 };
    const grip = onFloor(middle);
    for (const height of [-1e-3, 0, 1, 100]) {
        expect(deltaTo(grip, above(middle, height))).toBeNull();
    }
    const far = deltaTo(grip, above(middle, -10));
    expect(far?.motion === "move" && far.by[2]).toBeLessThan(-20);
    const axis: Grip = { ...grip, constraint: { motion: "move", axis: 2, plane: false } };
    expect(deltaTo(axis, above(middle, 100))).toBeNull();
});

test("a hand that begins above the horizon goes as if it had taken the pivot", () => {
    const middle = LEVEL.spotOf([0, 0, 0]) ?? { x: 0, y: 0 };
    const from = above(middle, 100);
    const right = deltaTo(onFloor(from), { x: from.x + 50, y: from.y });
    const wanted = deltaTo(onFloor(middle), { x: middle.x + 50, y: middle.y });
    if (right?.motion !== "move" || wanted?.motion !== "move") {
        throw new Error("no move");
    }
    close(right.by, wanted.by);
    expect(right.by[0]).toBeGreaterThan(0.5);
});

test("a scaling along an axis that begins beside the pivot grows by the way of the hand", () => {
    const projection = projectionOf({ ...DEFAULT_CAMERA, position: [0, 0, 6] }, SIZE);
    const { x, y } = projection.spotOf([0, 0, 0]) ?? { x: 0, y: 0 };
    const factor = (axis: Axis, from: Spot, to: Spot): unknown => {
        const constraint: Constraint = { motion: "scale", axis, plane: false };
        const delta = deltaTo(
            { constraint, pivot: [0, 0, 0], frame: IDENTITY, projection, from },
            to,
        );
        return delta?.motion === "scale" ? delta.factors[axis] : null;
    };
    for (const beside of [-2, 0, 2]) {
        const from = { x: x + beside, y: y - 150 };
        expect(factor(0, from, { ...from, x: from.x + 100 })).toBeCloseTo(2, 6);
        expect(factor(0, from, { ...from, x: from.x - 100 })).toBeCloseTo(0.5, 6);
        expect(factor(0, from, { ...from, x: from.x + 3 })).toBeLessThan(1.05);
    }
    expect(factor(0, { x: x + 50, y }, { x: x + 100, y })).toBeCloseTo(2, 6);
    expect(factor(2, { x: x + 50, y }, { x: x + 150, y })).toBeCloseTo(2 ** Math.SQRT1_2, 6);
});

test("1,000 random turns give the angle that was seen", () => {
    let seen = 0;
    for (let i = 0; i < 1000; i++) {
        const frame = rotation(within(6));
        const axis = (i % 3) as Axis;
        const grip = someGrip({ motion: "turn", axis, plane: false }, frame);
        const normal = axisOf(frame, axis);
        const view = grip.projection.towards(grip.pivot);
        if (Math.abs(normal.reduce((s, x, k) => s + x * (view[k] ?? 0), 0)) < 0.25) {
            continue;
        }
        seen++;
        const arm = axisOf(frame, ((axis + 1) % 3) as Axis);
        const angle = (next() - 0.5) * 6;
        const from = grip.projection.spotOf(add(grip.pivot, arm));
        const to = grip.projection.spotOf(add(grip.pivot, apply(turnMatrix(normal, angle), arm)));
        const delta = from && to ? deltaTo({ ...grip, from }, to) : null;
        expect(delta?.motion === "turn" ? delta.angle : Number.NaN).toBeCloseTo(angle, 6);
    }
    expect(seen).toBeGreaterThan(500);
});

test("a hand that goes around three times turns by three turns", () => {
    const grip = someGrip({ motion: "turn", axis: null, plane: false }, IDENTITY);
    const { x, y } = grip.from;
    let turned = 0;
    for (let degrees = 0; degrees <= 1080; degrees += 10) {
        const angle = (-degrees * Math.PI) / 180;
        const spot = { x: x + 80 * Math.cos(angle), y: y + 80 * Math.sin(angle) };
        const delta = deltaTo({ ...grip, from: { x: x + 80, y } }, spot, 0, turned);
        turned = delta?.motion === "turn" ? delta.angle : Number.NaN;
    }
    expect(turned).toBeCloseTo(6 * Math.PI, 1);
});

test("steps: moves of 0.1, turns of 15 degrees, factors of 0.1", () => {
    for (let i = 0; i < 200; i++) {
        for (const motion of ["move", "turn", "scale"] as const) {
            const grip = someGrip({ motion, axis: 1, plane: false }, IDENTITY);
            const from = { x: grip.from.x + 40, y: grip.from.y - 60 };
            const to = { x: from.x + next() * 90, y: from.y - next() * 90 };
            const step = motion === "turn" ? Math.PI / 12 : 0.1;
            const delta = deltaTo({ ...grip, from }, to, step);
            const amount =
                delta?.motion === "move"
                    ? delta.by[1]
                    : delta?.motion === "turn"
                      ? delta.angle
                      : (delta?.factors[1] ?? Number.NaN);
            const steps = amount / step;
            expect(
                delta?.motion === "scale" && amount === 0.01 ? 0 : steps - Math.round(steps),
            ).toBeCloseTo(0, 6);
        }
    }
});

const DOCUMENT = readDocument({
    root: {
        id: "root",
        type: "union",
        transform: { translation: [1, 0, 0], rotation: [0, 0.4, 0.2], scale: 2 },
        children: [
            {
                id: "pair",
                type: "group",
                transform: { rotation: [0.3, 0, 0] },
                children: [
                    {
                        id: "a",
                        type: "sphere",
                        transform: { translation: [1, 2, 3], rotation: [0.1, 0.2, 0.3] },
                    },
                    {
                        id: "b",
                        type: "box",
                        transform: { translation: [-1, 0, 0], scale: [1, 2, 3] },
                    },
                ],
            },
        ],
    },
});

function after(
    ids: readonly string[],
    delta: Delta,
    pivot: Vector,
    frame: Matrix,
    mode: Pivot = "center",
) {
    const movables = movablesOf(DOCUMENT, SCHEMA, ids, { kind: "nodes" });
    return documentAfter(DOCUMENT, motionOps(movables, delta, pivot, frame, mode));
}

function documentAfter(document: SceneDocument, ops: readonly Operation[]): SceneDocument {
    const applied = applyOperations(document, ops, SCHEMA);
    if (!applied.ok) {
        throw new Error(applied.problem.message);
    }
    return applied.document;
}

test("a move in the world moves every point of a nested node by it", () => {
    for (let i = 0; i < 100; i++) {
        const by = within(2);
        const document = after(["a"], { motion: "move", by }, [0, 0, 0], IDENTITY);
        const point = within(1);
        close(toWorld(document, "a", point), add(toWorld(DOCUMENT, "a", point), by), 1e-4);
    }
});

test("a turn in the world turns every point of a nested node about the pivot", () => {
    for (let i = 0; i < 100; i++) {
        const delta: Delta = { motion: "turn", axis: normalize(within(1)), angle: next() * 6 - 3 };
        const pivot = within(3);
        const document = after(["a"], delta, pivot, IDENTITY);
        const point = within(1);
        const wanted = moved(toWorld(DOCUMENT, "a", point), delta, pivot, IDENTITY);
        close(toWorld(document, "a", point), wanted, 1e-4);
    }
});

test("a scaling acts along the node's own axes and about the pivot", () => {
    const movables = movablesOf(DOCUMENT, SCHEMA, ["b"], { kind: "nodes" });
    const frame = frameOf(movables, "world", "scale");
    const pivot = pivotOf(movables, "origin");
    const delta: Delta = { motion: "scale", factors: [1, 1.5, 1] };
    const document = after(["b"], delta, pivot, frame);
    const point: Vector = [0.3, 0.5, -0.2];
    close(toWorld(document, "b", point), toWorld(DOCUMENT, "b", [0.3, 0.75, -0.2]), 1e-4);
});

test("several nodes go together, each of them once", () => {
    const by: Vector = [0, 1, 0];
    const document = after(["pair", "a"], { motion: "move", by }, [0, 0, 0], IDENTITY);
    close(toWorld(document, "a", [0, 0, 0]), add(toWorld(DOCUMENT, "a", [0, 0, 0]), by), 1e-4);
});

test("each its own: a turn leaves the origins where they are", () => {
    const delta: Delta = { motion: "turn", axis: [0, 1, 0], angle: 1 };
    const document = after(["a", "b"], delta, [5, 5, 5], IDENTITY, "each");
    for (const id of ["a", "b"]) {
        close(toWorld(document, id, [0, 0, 0]), toWorld(DOCUMENT, id, [0, 0, 0]), 1e-5);
    }
});

test("local axes are those of the node in the world", () => {
    const movables = movablesOf(DOCUMENT, SCHEMA, ["a"], { kind: "nodes" });
    const frame = frameOf(movables, "local", "move");
    const start = toWorld(DOCUMENT, "a", [0, 0, 0]);
    for (const axis of AXES) {
        const unit = AXES.map((one) => (one === axis ? 1 : 0)) as unknown as Vector;
        const along = subtract(toWorld(DOCUMENT, "a", unit), start);
        close(axisOf(frame, axis), normalize(along));
    }
    close(axisOf(frameOf(movables, "world", "move"), 0), [1, 0, 0]);
    const turned = product(rotation([0, 0.4, 0.2]), rotation([0.3, 0, 0]));
    close(axisOf(frameOf(movables, "parent", "move"), 0), axisOf(turned, 0));
});

test("below a mirror, turns and local axes are those that are seen", () => {
    const mirror = (size: Vector) =>
        readDocument({
            root: {
                id: "root",
                type: "group",
                transform: { rotation: [0, 0.4, 0.2], scale: size },
                children: [{ id: "a", type: "box", transform: { rotation: [0.1, 0.2, 0.3] } }],
            },
        });
    for (const size of [
        [-1, 1, 1],
        [2, -2, 2],
        [-1, -1, -1],
    ] as const) {
        const document = mirror(size);
        const movables = movablesOf(document, SCHEMA, ["a"], { kind: "nodes" });
        const delta: Delta = { motion: "turn", axis: normalize([1, 2, 3]), angle: 0.7 };
        const turned = documentAfter(
            document,
            motionOps(movables, delta, [0, 0, 0], IDENTITY, "origin"),
        );
        for (const point of [within(1), within(1)]) {
            const wanted = moved(toWorld(document, "a", point), delta, [0, 0, 0], IDENTITY);
            close(toWorld(turned, "a", point), wanted, 1e-4);
        }
        for (const axis of AXES) {
            const unit = AXES.map((one) => (one === axis ? 1 : 0)) as unknown as Vector;
            close(
                axisOf(frameOf(movables, "local", "move"), axis),
                normalize(toWorld(document, "a", unit)),
            );
        }
    }
});

test("a typed number: units along the axis, radians, a factor", () => {
    const grip = (motion: Constraint["motion"]): Grip =>
        someGrip({ motion, axis: 2, plane: false }, IDENTITY);
    expect(deltaOf(grip("move"), 0.5)).toEqual({ motion: "move", by: [0, 0, 0.5] });
    expect(deltaOf(grip("turn"), 0.5)).toEqual({ motion: "turn", axis: [0, 0, 1], angle: 0.5 });
    expect(deltaOf(grip("scale"), 2)).toEqual({ motion: "scale", factors: [1, 1, 2] });
});

test("every part of a gizmo is found at its place, and nothing is far from it", () => {
    const camera = { ...DEFAULT_CAMERA, position: [4, 3, 5] as Vector };
    const projection = projectionOf(camera, SIZE);
    for (const motion of ["move", "turn", "scale"] as const) {
        const parts = gizmoParts({ pivot: [0, 0, 0], frame: IDENTITY, projection }, motion);
        expect(parts).toHaveLength(motion === "turn" ? 4 : 7);
        for (const part of parts) {
            if (part.kind === "arrow" || part.kind === "bar") {
                expect(partAt(parts, part.tip, 8)).toBe(part);
            } else if (part.kind === "middle") {
                expect(partAt(parts, part.at, 8)).toBe(part);
            } else if (part.kind === "square") {
                const sum = part.corners.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }));
                expect(partAt(parts, { x: sum.x / 4, y: sum.y / 4 }, 1)).toBe(part);
            }
        }
        expect(partAt(parts, { x: 20, y: 20 }, 24)).toBeNull();
    }
});

test("an arrow that points at the viewer cannot be held", () => {
    const projection = projectionOf({ ...DEFAULT_CAMERA, position: [0, 0, 6] }, SIZE);
    const parts = gizmoParts({ pivot: [0, 0, 0], frame: IDENTITY, projection }, "move");
    const axes = parts.filter(({ kind }) => kind === "arrow").map((part) => part.constraint.axis);
    expect(axes).toEqual([0, 1]);
});

test("a move that snaps is drawn to the middle of a shape, as far as its constraint goes", () => {
    const camera = { ...DEFAULT_CAMERA, position: [0, 0, 10], target: [0, 0, 0], fov: 45 } as const;
    const projection = projectionOf(camera, SIZE);
    const grip = (axis: Axis | null, plane = false): Grip => ({
        constraint: { motion: "move", axis, plane },
        pivot: [0, 0, 0],
        frame: IDENTITY,
        projection,
        from: { x: 450, y: 300 },
    });
    const targets = [
        { name: "far", at: [4, 4, 0] as Vector },
        { name: "near", at: [1.03, 0.02, -0.7] as Vector },
    ];
    const snapped = (axis: Axis | null, by: Vector, plane = false) =>
        snapTo(grip(axis, plane), by, targets);
    expect(snapped(null, [1, 0, 0])).toMatchObject({ target: { name: "near" } });
    close(snapped(null, [1, 0, 0])?.by ?? [9, 9, 9], [1.03, 0.02, -0.7]);
    close(snapped(0, [1, 0, 0])?.by ?? [9, 9, 9], [1.03, 0, 0]);
    close(snapped(2, [1, 0, 0], true)?.by ?? [9, 9, 9], [1.03, 0.02, 0]);
    /* Beside what is far along another axis. */
    close(snapped(1, [0, 3.98, 0])?.by ?? [9, 9, 9], [0, 4, 0]);
    expect(snapped(null, [1.5, 0, 0])).toBe(null);
    expect(snapTo(grip(null), [1, 0, 0], [])).toBe(null);
});

test("what is drawn to is every shape that does not move along", () => {
    const document = readDocument({
        format: "fieldcast/1",
        root: {
            id: "root",
            type: "union",
            transform: { translation: [1, 0, 0] },
            children: [
                { id: "a", type: "sphere", name: "A", transform: { translation: [0, 2, 0] } },
                { id: "pair", type: "group", children: [{ id: "b", type: "sphere" }] },
            ],
        },
    });
    const names = (moved: string[]) => targetsOf(document, SCHEMA, moved).map(({ name }) => name);
    expect(names([])).toEqual(["A", "b"]);
    expect(names(["pair"])).toEqual(["A"]);
    expect(names(["a"])).toEqual(["b"]);
    expect(names(["root"])).toEqual([]);
    close(targetsOf(document, SCHEMA, ["pair"])[0]?.at ?? [9, 9, 9], [1, 2, 0]);
});

test("the surface under a spot is that of what does not move along", () => {
    const document = readDocument({
        format: "fieldcast/1",
        root: {
            id: "root",
            type: "union",
            children: [
                { id: "a", type: "sphere", name: "A" },
                { id: "pair", type: "group", children: [{ id: "b", type: "sphere" }] },
            ],
        },
    });
    const camera = { ...DEFAULT_CAMERA, position: [0, 0, 10], target: [0, 0, 0] } as const;
    const size = { width: 8, height: 4 };
    const projection = projectionOf(camera, size);
    /* From the left: a at 5, b at 6, the floor at 7, nothing. */
    const guide = {
        ...{ input: 1, revision: 1, width: 16, height: 1, ids: ["a", "b"] },
        indices: Uint16Array.from({ length: 16 }, (_, x) => [1, 2, 0, 0][x >> 2] ?? 0),
        distances: Float32Array.of(5, 6, 7, Number.POSITIVE_INFINITY),
    };
    const under = (x: number, ...moved: string[]) =>
        surfaceUnder(document, guide, projection, moved, { x, y: 2 });
    expect(under(0.5)?.name).toBe("A");
    expect(length(subtract(under(0.5)?.at ?? [0, 0, 0], camera.position))).toBeCloseTo(5, 5);
    expect(under(0.5, "a")).toBe(null);
    expect(under(0.5, "root")).toBe(null);
    expect(under(2.5, "pair")).toBe(null);
    expect(under(2.5, "a")?.name).toBe("b");
    expect(under(4.2, "a", "pair")?.name).toBe("floor");
    expect(under(7.9)).toBe(null);
});

test("the document's camera moves with its target, and keeps its up unless it rolls", () => {
    const next = random(11);
    for (let round = 0; round < 200; round++) {
        const [position, target, axis] = Array.from({ length: 3 }, () =>
            [0, 1, 2].map(() => 6 * next() - 3),
        ) as unknown as [Vector, Vector, Vector];
        const document = readDocument({
            camera: { position: [...position], target: [...target] },
            root: { id: "root", type: "union" },
        });
        const [held] = movablesOf(document, SCHEMA, [], { kind: "camera" });
        const before = axes(cameraOf(document.camera));
        const after = (delta: Delta): Camera =>
            cameraOf(documentAfter(document, held?.ops(delta, held.origin, IDENTITY) ?? []).camera);
        close(held?.origin ?? [9, 9, 9], position);

        const shifted = after({ motion: "move", by: axis });
        close(shifted.position, add(position, axis), 1e-4);
        close(axes(shifted).forward, before.forward, 1e-4);

        const turn = { motion: "turn", axis: normalize(axis), angle: next() } as const;
        const turned = axes(after(turn));
        for (const way of ["right", "up", "forward"] as const) {
            close(turned[way], turnAbout(before[way], turn.axis, turn.angle), 2e-4);
        }
        /* About the world's up, nothing rolls. */
        const around = after({ motion: "turn", axis: [0, 1, 0], angle: next() });
        expect(around.up).toEqual([0, 1, 0]);
    }
});

test("an arrow ends before what else is held near its tip", () => {
    const arrow: Part = {
        ...{ kind: "arrow", constraint: { motion: "move", axis: 0, plane: false } },
        ...{ foot: { x: 120, y: 200 }, tip: { x: 192, y: 200 } },
    };
    const tipOf = (...spots: Spot[]) => {
        const [part] = clearOf([arrow], spots);
        return part?.kind === "arrow" ? part.tip : null;
    };
    expect(tipOf()).toEqual({ x: 192, y: 200 });
    expect(tipOf({ x: 225, y: 200 }, { x: 192, y: 240 })).toEqual({ x: 192, y: 200 });
    expect(tipOf({ x: 200, y: 203 })).toEqual({ x: 168, y: 200 });
    expect(tipOf({ x: 210, y: 200 }, { x: 190, y: 200 })).toEqual({ x: 158, y: 200 });
    /* Too little would be left of it. */
    expect(tipOf({ x: 164, y: 200 }, { x: 190, y: 200 })).toEqual({ x: 222, y: 200 });
});
