/* SPDX-License-Identifier: MIT */
/* The ends of the world's axes as a camera sees them, on a ball in a corner of the picture. */
import { axes, type Camera, type ViewName } from "./camera.ts";
import { dot, type Vector } from "./transform.ts";

export interface AxisEnd {
    /* What one sees who looks from there. */
    readonly view: ViewName;
    readonly axis: "x" | "y" | "z";
    readonly positive: boolean;
    /* From the middle of a ball with radius 1; y points down. */
    readonly x: number;
    readonly y: number;
    /* From -1, far, to 1, near. */
    readonly near: number;
    /* Something nearer stands before it. */
    readonly covered: boolean;
}

const ENDS: readonly (readonly [ViewName, AxisEnd["axis"], Vector])[] = [
    ["right", "x", [1, 0, 0]],
    ["left", "x", [-1, 0, 0]],
    ["top", "y", [0, 1, 0]],
    ["bottom", "y", [0, -1, 0]],
    ["front", "z", [0, 0, 1]],
    ["back", "z", [0, 0, -1]],
];

/* `apart`: the least distance of two ends, else the farther one is covered. */
export function axisEnds(camera: Camera, apart: number): readonly AxisEnd[] {
    const { right, up, forward } = axes(camera);
    const ends = ENDS.map(([view, axis, along]) => ({
        view,
        axis,
        positive: dot(along, [1, 1, 1]) > 0,
        x: dot(along, right),
        y: -dot(along, up),
        near: -dot(along, forward),
    }));
    const shown: { x: number; y: number }[] = [];
    const covered = new Set<ViewName>();
    for (const { view, x, y } of [...ends].sort((a, b) => b.near - a.near)) {
        if (shown.some((other) => Math.hypot(other.x - x, other.y - y) < apart)) {
            covered.add(view);
        } else {
            shown.push({ x, y });
        }
    }
    return ends.map((end) => ({ ...end, covered: covered.has(end.view) }));
}
