/* SPDX-License-Identifier: MIT */
/* A picture as another camera sees it, until the server's own comes: a mesh over the picture, whose
 * corners are as far away as what they show (Mark, McMillan and Bishop, Post-rendering 3D warping,
 * 1997). Where something stands before something else the mesh stretches and does not tear. */
import { axes, type Camera, distance } from "./camera.ts";
import { add, dot, length, normalize, scale, subtract, type Vector } from "./transform.ts";

/* Of each block of a picture's pixels, rows from the top. */
export interface Depths {
    readonly columns: number;
    readonly rows: number;
    /* Sides of a block in parts of the picture's. */
    readonly across: number;
    readonly down: number;
    /* 1 over the distance from the eye to what is nearest in it; 0: nothing is hit. */
    readonly inverses: Float32Array;
}

/* What a picture shows: the camera, and its width over its height. */
export interface Shot {
    readonly camera: Camera;
    readonly aspect: number;
}

export interface Mesh {
    /* Corners to a row and to a column. Outermost is a frame far outside of the picture. */
    readonly columns: number;
    readonly rows: number;
    /* u and v of each, in parts of the picture's sides from the left top. */
    readonly spots: Float32Array;
    /* 1 over how far each is along the camera's axis. */
    readonly inverses: Float32Array;
    readonly greatest: number;
}

/* How far the frame is outside, in parts of a side. */
const BEYOND = 1;
/* Blocks that differ by less, in parts of the nearest, are of one surface. */
const EVEN = 0.05;
/* A camera that is further away, by angle or by way over distance, is not shown. */
export const FARTHEST_WARP = 0.105;

/* Half of what a picture spans at the distance 1. */
function spanOf({ camera, aspect }: Shot): readonly [number, number] {
    const half = Math.tan((camera.fov * Math.PI) / 360);
    return [half * aspect, half];
}

function placesOf(blocks: number, step: number): number[] {
    const inner = Array.from({ length: blocks + 1 }, (_, i) => Math.min(1, i * step));
    return [-BEYOND, ...inner, 1 + BEYOND];
}

const AROUND = [
    [1, 0],
    [0, 1],
    [1, 1],
    [1, -1],
] as const;

/* What lies behind, and beside the rim of something, is as near as the rim, so that what stands in front
 * keeps its shape, its blurred border included. On a plane inverses change evenly. */
function withRims({ columns, rows, inverses }: Depths): Float32Array {
    const at = (x: number, y: number): number =>
        inverses[
            Math.min(rows - 1, Math.max(0, y)) * columns + Math.min(columns - 1, Math.max(0, x))
        ] as number;
    return inverses.map((own, i) => {
        const [x, y] = [i % columns, Math.floor(i / columns)];
        let rim = Number.POSITIVE_INFINITY;
        for (const [dx, dy] of AROUND) {
            const [a, b] = [at(x - dx, y - dy), at(x + dx, y + dy)];
            const gap = Math.max(a, b) * EVEN;
            if (Math.abs(a + b - 2 * own) > gap) {
                rim = Math.min(rim, ...[a, b].filter((other) => other > own + gap));
            }
        }
        return rim < Number.POSITIVE_INFINITY ? rim : own;
    });
}

/* Of the nearest surface around a corner. */
function joined(...all: readonly [number, number, number, number]): number {
    const least = Math.max(...all) * (1 - EVEN);
    let sum = 0;
    let count = 0;
    for (const inverse of all) {
        if (inverse >= least) {
            sum += inverse;
            count++;
        }
    }
    return sum / count;
}

export function meshOf(depths: Depths, shot: Shot): Mesh {
    const { columns, rows, across, down } = depths;
    const inverses = withRims(depths);
    const [us, vs] = [placesOf(columns, across), placesOf(rows, down)];
    const [right, up] = spanOf(shot);
    const at = (i: number, most: number): number => Math.min(most - 1, Math.max(0, i));
    const mesh = new Float32Array(us.length * vs.length);
    const spots = new Float32Array(2 * mesh.length);
    let greatest = 0;
    vs.forEach((v, row) => {
        const [above, below] = [at(row - 2, rows) * columns, at(row - 1, rows) * columns];
        us.forEach((u, column) => {
            const i = row * us.length + column;
            const [left, next] = [at(column - 2, columns), at(column - 1, columns)];
            const inverse = joined(
                inverses[above + left] as number,
                inverses[above + next] as number,
                inverses[below + left] as number,
                inverses[below + next] as number,
            );
            const [x, y] = [Math.min(1, Math.max(0, u)), Math.min(1, Math.max(0, v))];
            mesh[i] = inverse * Math.hypot(right * (2 * x - 1), up * (2 * y - 1), 1);
            spots.set([u, v], 2 * i);
            greatest = Math.max(greatest, mesh[i] as number);
        });
    });
    return { columns: us.length, rows: vs.length, spots, inverses: mesh, greatest };
}

/* Where the corners are in another picture: x, y, z, w of each as WebGL has them. On a plane all four
 * change evenly with u and v, and so does what is between the corners. */
export function moveMesh(mesh: Mesh, from: Shot, to: Shot, out: Float32Array): void {
    const [a, b] = [axes(from.camera), axes(to.camera)];
    const [right, up] = spanOf(from);
    const [wide, high] = spanOf(to);
    const eye = subtract(from.camera.position, to.camera.position);
    const rows = [scale(b.right, 1 / wide), scale(b.up, 1 / high), b.forward] as const;
    const [toX, toY, toW] = rows.map(
        (row): Four => [
            dot(row, a.right) * right,
            dot(row, a.up) * up,
            dot(row, a.forward),
            dot(row, eye),
        ],
    ) as unknown as readonly [Four, Four, Four];
    const near = mesh.greatest > 0 ? 0.5 / mesh.greatest : 0;
    for (let i = 0; i < mesh.inverses.length; i++) {
        const x = 2 * (mesh.spots[2 * i] as number) - 1;
        const y = 1 - 2 * (mesh.spots[2 * i + 1] as number);
        const inverse = mesh.inverses[i] as number;
        const sum = (t: Four): number => t[0] * x + t[1] * y + t[2] + t[3] * inverse;
        const w = sum(toW);
        out[4 * i] = sum(toX);
        out[4 * i + 1] = sum(toY);
        out[4 * i + 2] = w - 2 * Math.min(w, near * inverse);
        out[4 * i + 3] = w;
    }
}

type Four = readonly [number, number, number, number];

/* Corners of the triangles, six for each square. */
export function trianglesOf({ columns, rows }: Mesh): Uint32Array {
    const triangles = new Uint32Array(6 * (columns - 1) * (rows - 1));
    let at = 0;
    for (let y = 0; y < rows - 1; y++) {
        for (let x = 0; x < columns - 1; x++) {
            const i = y * columns + x;
            triangles.set([i, i + 1, i + columns, i + columns, i + 1, i + columns + 1], at);
            at += 6;
        }
    }
    return triangles;
}

/* The camera on the way to `to` that a picture from `from` can still be shown from. */
export function nearCamera(from: Camera, to: Camera): Camera {
    const cosine = dot(axes(from).forward, axes(to).forward);
    const turned = Math.acos(Math.min(1, Math.max(-1, cosine)));
    const moved = length(subtract(to.position, from.position)) / Math.max(1e-9, distance(from));
    const part = FARTHEST_WARP / Math.max(turned, moved);
    if (part >= 1) {
        return to;
    }
    const between = (a: Vector, b: Vector): Vector => add(a, scale(subtract(b, a), part));
    return {
        position: between(from.position, to.position),
        target: between(from.target, to.target),
        up: normalize(between(from.up, to.up)),
        fov: from.fov + (to.fov - from.fov) * part,
        height: null,
    };
}
