/* SPDX-License-Identifier: MIT */
/* The ground grid: its lines are where the plane is, fade, and are hidden by what is before them. */
import { expect, test } from "vitest";
import { type Camera, DEFAULT_CAMERA, dolly } from "../src/model/camera.ts";
import { type GridStroke, gridStrokes, levelsOf } from "../src/model/grid.ts";
import { onPlane, projectionOf, type Spot } from "../src/model/projection.ts";
import { length, subtract, type Vector } from "../src/model/transform.ts";
import { random } from "./fixture.ts";

const SIZE = { width: 900, height: 600 };

interface Piece {
    readonly axis: GridStroke["axis"];
    readonly strength: number;
    readonly ends: readonly [Spot, Spot];
}

function piecesOf(strokes: readonly GridStroke[]): Piece[] {
    return strokes.flatMap(({ axis, strength, pieces }) =>
        Array.from({ length: pieces.length / 4 }, (_, i) => {
            const [ax, ay, bx, by] = pieces.slice(4 * i) as [number, number, number, number];
            return {
                axis,
                strength,
                ends: [
                    { x: ax, y: ay },
                    { x: bx, y: by },
                ] as const,
            };
        }),
    );
}

/* Where the ground is under a spot. */
function groundAt(camera: Camera, spot: Spot): Vector {
    const point = onPlane(projectionOf(camera, SIZE).rayAt(spot), [0, 0, 0], [0, 1, 0]);
    return point ?? [Number.NaN, 0, 0];
}

function randomCamera(next: () => number): Camera {
    const at = (reach: number): number => reach * (2 * next() - 1);
    return {
        ...DEFAULT_CAMERA,
        position: [at(12), at(8), at(12)],
        target: [at(3), at(2), at(3)],
        height: next() < 0.4 ? 1 + 9 * next() : null,
    };
}

const isMultiple = (x: number, step: number): boolean =>
    Math.abs(x / step - Math.round(x / step)) * step < 1e-6;

test("each piece lies on the ground, on a line of the world, in the picture", () => {
    const next = random(3);
    let seen = 0;
    const places = new Set<string>();
    for (let round = 0; round < 60; round++) {
        const camera = randomCamera(next);
        const [least] = levelsOf(camera);
        for (const { axis, ends } of piecesOf(gridStrokes(camera, SIZE, null))) {
            seen++;
            places.add(`${round} ${ends.map(({ x, y }) => `${x.toFixed(3)} ${y.toFixed(3)}`)}`);
            const [a, b] = ends.map((spot) => groundAt(camera, spot)) as [Vector, Vector];
            for (const { x, y } of ends) {
                expect(x > -1e-6 && x < SIZE.width + 1e-6).toBe(true);
                expect(y > -1e-6 && y < SIZE.height + 1e-6).toBe(true);
            }
            const along = Math.abs(b[0] - a[0]) > Math.abs(b[2] - a[2]) ? 0 : 2;
            const aside = (along === 0 ? a[2] : a[0]) as number;
            expect(Math.abs((b[2 - along] as number) - aside)).toBeLessThan(1e-6);
            expect(isMultiple(aside, axis === null ? (least?.step ?? 1) : 1e9)).toBe(true);
            expect(axis === null || axis === along).toBe(true);
        }
    }
    expect(seen).toBeGreaterThan(3000);
    /* Each once. */
    expect(places.size).toBe(seen);
});

test("lines are 1 and 10 units apart, stronger near the target than far from it", () => {
    const camera = { ...DEFAULT_CAMERA, position: [0, 6, 6] as Vector };
    const pieces = piecesOf(gridStrokes(camera, SIZE, null)).filter(({ axis }) => axis === null);
    const near = pieces.filter(({ ends }) => length(groundAt(camera, ends[0])) < 3);
    const lines = new Set(
        near.map(({ ends }) =>
            groundAt(camera, ends[0])
                .map((x) => Math.round(x * 1e4))
                .join(),
        ),
    );
    expect(lines.size).toBeGreaterThan(10);
    const strongest = (from: number, to: number): number =>
        Math.max(
            0,
            ...pieces
                .filter(({ ends }) => {
                    const far = length(groundAt(camera, ends[0]));
                    return far >= from && far < to;
                })
                .map(({ strength }) => strength),
        );
    expect(strongest(0, 5)).toBeGreaterThan(strongest(15, 22));
});

test("as the camera goes away, no level jumps", () => {
    let before = new Map<string, number>();
    for (let i = 0; i <= 400; i++) {
        const levels = levelsOf(dolly(DEFAULT_CAMERA, 10 ** (i / 100 - 2)));
        const now = new Map(levels.map(({ step, strength }) => [step.toPrecision(3), strength]));
        for (const step of new Set([...now.keys(), ...(i > 0 ? before.keys() : [])])) {
            /* Those beyond the third are not drawn: as strong as it. */
            const of = (all: ReadonlyMap<string, number>): number =>
                all.get(step) ?? (Number(step) > Math.max(...[...all.keys()].map(Number)) ? 1 : 0);
            expect(i === 0 || Math.abs(of(now) - of(before)) < 0.02).toBe(true);
        }
        before = now;
    }
});

test("what a ball is before is not drawn, and its edge is found", () => {
    for (const height of [null, 8]) {
        const camera: Camera = { ...DEFAULT_CAMERA, position: [1, 3, 7], height };
        const projection = projectionOf(camera, SIZE);
        /* How far a ball of radius 1 in the origin is along a ray; infinite beside it. */
        const ball = (spot: Spot): number => {
            const { from, along } = projection.rayAt(spot);
            const b = from.reduce((sum, x, i) => sum + x * (along[i] as number), 0);
            const root = b * b - from.reduce((sum, x) => sum + x * x, 0) + 1;
            return root < 0 ? Number.POSITIVE_INFINITY : -b - Math.sqrt(root);
        };
        const seesAt = (x: number, y: number, far: number): boolean => far <= ball({ x, y });
        const whole = piecesOf(gridStrokes(camera, SIZE, null));
        const rest = piecesOf(gridStrokes(camera, SIZE, seesAt));
        const total = (all: readonly Piece[]): number =>
            all.reduce((sum, { ends: [a, b] }) => sum + Math.hypot(b.x - a.x, b.y - a.y), 0);
        let hidden = 0;
        for (const { ends } of whole) {
            const [a, b] = ends;
            for (let i = 0; i < 200; i++) {
                const t = (i + 0.5) / 200;
                const spot = { x: a.x + t * (b.x - a.x), y: a.y + t * (b.y - a.y) };
                const { from } = projection.rayAt(spot);
                const far = length(subtract(groundAt(camera, spot), from));
                hidden += far > ball(spot) ? Math.hypot(b.x - a.x, b.y - a.y) / 200 : 0;
            }
        }
        expect(hidden).toBeGreaterThan(500);
        expect(Math.abs(total(whole) - total(rest) - hidden)).toBeLessThan(hidden / 100);
        for (const { ends } of rest) {
            const [a, b] = ends;
            const spot = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
            const far = length(subtract(groundAt(camera, spot), projection.rayAt(spot).from));
            const short = Math.hypot(b.x - a.x, b.y - a.y) < 2;
            expect(short || far <= ball(spot)).toBe(true);
        }
    }
});

test("a ground seen from its edge has no lines", () => {
    const camera: Camera = { ...DEFAULT_CAMERA, position: [0, 0, 6], target: [0, 0, 0] };
    expect(gridStrokes(camera, SIZE, null)).toEqual([]);
});

test("a whole grid is few pieces, so that it is drawn in half a millisecond", () => {
    const pieces = gridStrokes(DEFAULT_CAMERA, { width: 1440, height: 900 }, null);
    expect(pieces.reduce((sum, stroke) => sum + stroke.pieces.length / 4, 0)).toBeLessThan(2500);
});
