/* SPDX-License-Identifier: MIT */
/* Corners of flat shapes: dragged in their plane, put in on edges, taken away within the row's limits. */
import { expect, test } from "vitest";
import { DEFAULT_CAMERA } from "../src/model/camera.ts";
import { dropCorner, edgeAt, putCorner } from "../src/model/corners.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { dragHandle, type Handle, handleLabel, handlesOf } from "../src/model/handles.ts";
import { IDENTITY, movablesOf } from "../src/model/movables.ts";
import type { Operation } from "../src/model/operation.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { readSchema } from "../src/model/schema.ts";
import { fromWorld, toWorld, type Vector } from "../src/model/transform.ts";
import { random } from "./fixture.ts";

const POINTS = {
    name: "corners",
    type: "points",
    unit: "length",
    min: 3,
    max: 5,
    doc: "",
    handle: "",
};
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            {
                ...{ type: "sheet", group: "shape", doc: "", children: "none" },
                params: [{ ...POINTS, default: [] }],
            },
            { type: "thick", group: "modifier", doc: "", children: "one", params: [] },
            {
                ...{ type: "revolve", group: "modifier", doc: "", children: "one" },
                params: [{ name: "offset", type: "float", default: 0, doc: "" }],
            },
        ],
    },
});
const CORNERS = [
    [-0.5, -0.4],
    [0.6, -0.4],
    [0.5, 0.7],
    [-0.3, 0.5],
] as const;
const documentWith = (corners: readonly (readonly number[])[]) =>
    readDocument({
        root: {
            id: "root",
            type: "thick",
            transform: { rotation: [0.2, 0.5, 0.1], scale: 1.5 },
            children: [
                {
                    id: "sheet",
                    type: "sheet",
                    transform: { rotation: [0.3, -0.4, 0.2], translation: [0.2, 0.1, 0.3] },
                    params: { corners: corners.map((corner) => [...corner]) },
                },
            ],
        },
    });
const DOCUMENT = documentWith(CORNERS);
const PROJECTION = projectionOf(
    { ...DEFAULT_CAMERA, position: [2, 2, 6] },
    { width: 900, height: 600 },
);
const of = (document = DOCUMENT): readonly Handle[] =>
    handlesOf(document, SCHEMA, ["sheet"], { kind: "nodes" }, PROJECTION);

function seen([x, y]: readonly number[]): Spot {
    const spot = PROJECTION.spotOf(toWorld(DOCUMENT, "sheet", [x ?? 0, y ?? 0, 0] as Vector));
    if (!spot) {
        throw new Error("behind the camera");
    }
    return spot;
}

function corner(index: number, document = DOCUMENT): Handle {
    const found = of(document)[index];
    if (!found) {
        throw new Error(`no corner ${index}`);
    }
    return found;
}

const pointsOf = (op: unknown): number[][] => (op as { value: number[][] }).value;

test("each point of a row of points has a handle where it is seen, beside its edge", () => {
    expect(of().map(({ key }) => key)).toEqual([0, 1, 2, 3].map((i) => `corners.${i}`));
    CORNERS.forEach((point, i) => {
        const { spot, look } = corner(i);
        expect(Math.hypot(spot.x - seen(point).x, spot.y - seen(point).y)).toBeLessThan(1e-9);
        expect(look).toEqual({ kind: "corner", next: seen(CORNERS[(i + 1) % 4] ?? [0, 0]) });
    });
    expect(handleLabel(corner(2))).toBe("point 3 of 4: 0.5 0.7");
});

test("500 random drags bring a corner to the point of its plane that is under the pointer", () => {
    const next = random(7);
    for (let i = 0; i < 500; i++) {
        const index = i % 4;
        const wanted = [next() * 2 - 1, next() * 2 - 1];
        const change = dragHandle(
            corner(index),
            PROJECTION,
            seen(CORNERS[index] ?? []),
            seen(wanted),
            false,
        );
        const points = pointsOf(change?.op);
        expect(Math.abs((points[index]?.[0] ?? 9) - (wanted[0] ?? 0))).toBeLessThan(1e-6);
        expect(Math.abs((points[index]?.[1] ?? 9) - (wanted[1] ?? 0))).toBeLessThan(1e-6);
        expect(points.filter((_, at) => at !== index)).toEqual(
            CORNERS.filter((_, at) => at !== index),
        );
    }
});

test("a drag that snaps goes in tenths", () => {
    const change = dragHandle(corner(1), PROJECTION, seen([0.6, -0.4]), seen([0.83, 0.12]), true);
    expect(pointsOf(change?.op)[1]).toEqual([0.8, 0.1]);
    expect(change?.label).toBe("point 2 of 4: 0.8 0.1");
});

test("a plane that is seen from its edge gives nothing", () => {
    const across = toWorld(DOCUMENT, "sheet", [3, 0.3, 0]);
    const flat = projectionOf(
        { ...DEFAULT_CAMERA, position: across, target: toWorld(DOCUMENT, "sheet", [0, 0.3, 0]) },
        { width: 900, height: 600 },
    );
    const [first] = handlesOf(DOCUMENT, SCHEMA, ["sheet"], { kind: "nodes" }, flat);
    const to = { x: 450, y: 300 };
    expect(first && dragHandle(first, flat, first.spot, to, false)).toBeNull();
});

test("a point more lies on its edge, behind the corner where the edge begins", () => {
    const middle = seen([0.55, 0.15]);
    const edge = edgeAt(of(), { x: middle.x + 3, y: middle.y }, 8);
    expect(edge?.handle.component).toBe(1);
    const points = edge ? pointsOf(putCorner(edge, PROJECTION)) : [];
    const [x = 0, y = 0] = points[2] ?? [];
    /* On the line from (0.6, -0.4) to (0.5, 0.7). */
    expect(Math.abs((x - 0.6) * 1.1 + (y + 0.4) * 0.1)).toBeLessThan(1e-6);
    expect([points[1], points[3], points.length]).toEqual([[0.6, -0.4], [0.5, 0.7], 5]);
    expect(edgeAt(of(), { x: middle.x + 20, y: middle.y }, 8)).toBeNull();
});

test("the row says how many points there may be", () => {
    const full = documentWith([...CORNERS, [-0.5, 0]]);
    const edge = edgeAt(of(full), seen([0.05, -0.4]), 8);
    expect(edge && putCorner(edge, PROJECTION)).toEqual({ most: 5 });
    expect(pointsOf(dropCorner(corner(1)))).toEqual([CORNERS[0], CORNERS[2], CORNERS[3]]);
    const least = documentWith(CORNERS.slice(0, 3));
    expect(dropCorner(corner(0, least))).toEqual({ least: 3 });
});

/* What an operation sets. */
const numbers = (op: Operation | undefined): number[] =>
    op?.op === "set" && Array.isArray(op.value)
        ? op.value.flat().map((part) => Number(Number(part).toFixed(3)))
        : [];

test("inside of what is revolved, corners are where the shape is", () => {
    const scene = (offset: number) =>
        readDocument({
            root: {
                ...{ id: "root", type: "revolve", params: { offset } },
                transform: { rotation: [0, 0.5, 0], scale: 2 },
                children: [
                    {
                        ...{
                            id: "sheet",
                            type: "sheet",
                            params: {
                                corners: [
                                    [1, 0],
                                    [2, 0],
                                    [1, 1],
                                ],
                            },
                        },
                        transform: { translation: [0.5, 0, 0] },
                    },
                ],
            },
        });
    const away = scene(3);
    const [x, , z] = toWorld(away, "sheet", [1, 0, 0]);
    expect(Math.hypot(x, z)).toBeCloseTo(2 * (1 + 0.5 + 3), 9);
    const back = fromWorld(away, "sheet", toWorld(away, "sheet", [0.3, 0.2, 0.1]));
    expect(back.map((part) => Number(part.toFixed(9)))).toEqual([0.3, 0.2, 0.1]);
    /* Where the gizmo puts a node is where it is then. */
    const [movable] = movablesOf(away, SCHEMA, ["sheet"], { kind: "nodes" });
    const origin = movable?.origin ?? [0, 0, 0];
    const [op] = movable?.ops({ motion: "move", by: [0, 1, 0] }, origin, IDENTITY) ?? [];
    expect(numbers(op)).toEqual([0.5, 0.5, 0]);
    /* A drag by the way that the picture shows. */
    const [first] = of(away);
    const there = PROJECTION.spotOf(toWorld(away, "sheet", [1.4, 0.3, 0])) as Spot;
    const change = first && dragHandle(first, PROJECTION, first.spot, there, false);
    expect(numbers(change?.op)).toEqual([1.4, 0.3, 2, 0, 1, 1]);
});
