/* SPDX-License-Identifier: MIT */
/* A window on the plane that holds given points: its scale, its grid, and the way to and from the
 * coordinates of a drawing, whose y goes down. */
import { tidy } from "../../model/units.ts";

export type Point = [number, number];

export interface Frame {
    /* Of the drawing. */
    width: number;
    height: number;
    /* The point in its middle, and units of the drawing for one of the plane. */
    center: Point;
    scale: number;
    /* From line to line of the grid, in the plane. */
    tick: number;
}

const WIDTH = 280;
const HEIGHT = 200;
/* Room around the points. */
const MARGIN = 1.35;
const LEAST_EXTENT = 1e-3;
/* Lines of the grid stand at least this far apart. */
const LEAST_GAP = 18;

/* 1, 2 or 5 times a power of ten, at least `x`. */
function niceAbove(x: number): number {
    const decade = 10 ** Math.floor(Math.log10(x));
    const factor = [1, 2, 5, 10].find((one) => one * decade >= x * 0.999999) ?? 10;
    return tidy(factor * decade);
}

/* The origin is always in sight. */
export function frameOf(points: readonly Point[]): Frame {
    const xs = [0, ...points.map(([x]) => x)];
    const ys = [0, ...points.map(([, y]) => y)];
    const [left, right] = [Math.min(...xs), Math.max(...xs)];
    const [low, high] = [Math.min(...ys), Math.max(...ys)];
    const extent = Math.max((right - left) / WIDTH, (high - low) / HEIGHT, LEAST_EXTENT / WIDTH);
    const scale = 1 / (extent * MARGIN);
    return {
        width: WIDTH,
        height: HEIGHT,
        center: [(left + right) / 2, (low + high) / 2],
        scale,
        tick: niceAbove(LEAST_GAP / scale),
    };
}

export function toView(frame: Frame, [x, y]: Point): Point {
    return [
        frame.width / 2 + (x - frame.center[0]) * frame.scale,
        frame.height / 2 - (y - frame.center[1]) * frame.scale,
    ];
}

/* What lies at a share of the drawing's width and height, from its left top. */
export function pointAt(frame: Frame, u: number, v: number): Point {
    return [
        frame.center[0] + ((u - 0.5) * frame.width) / frame.scale,
        frame.center[1] - ((v - 0.5) * frame.height) / frame.scale,
    ];
}

/* Where the lines of the grid cross an axis of the drawing. */
export function ticksOf(frame: Frame, axis: 0 | 1): number[] {
    const size = axis === 0 ? frame.width : frame.height;
    const reach = size / 2 / frame.scale;
    const first = Math.ceil((frame.center[axis] - reach) / frame.tick);
    const last = Math.floor((frame.center[axis] + reach) / frame.tick);
    const lines: number[] = [];
    for (let n = first; n <= last; n++) {
        const at = n * frame.tick;
        lines.push(toView(frame, axis === 0 ? [at, 0] : [0, at])[axis]);
    }
    return lines;
}
