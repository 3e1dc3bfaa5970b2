/* SPDX-License-Identifier: MIT */
/* Vectors, rotations R = Rz·Ry·Rx and back, and the step between a node's space and the world's. */
import { pathTo, type SceneDocument, type SceneNode } from "./document.ts";
import { numbersOf } from "./values.ts";

export type Vector = readonly [number, number, number];
/* Rows of a 3 × 3 matrix. */
export type Matrix = readonly [Vector, Vector, Vector];

export const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vector, s: number): Vector => [a[0] * s, a[1] * s, a[2] * s];
export const multiply = (a: Vector, b: Vector): Vector => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
export const divide = (a: Vector, b: Vector): Vector => [a[0] / b[0], a[1] / b[1], a[2] / b[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);

/* `fallback` where the length is 0. */
export function normalize(a: Vector, fallback: Vector = [0, 1, 0]): Vector {
    const size = length(a);
    return size > 0 ? scale(a, 1 / size) : fallback;
}

export function vectorOf(value: readonly number[]): Vector {
    return [value[0] ?? 0, value[1] ?? 0, value[2] ?? 0];
}

export const apply = (m: Matrix, v: Vector): Vector => [dot(m[0], v), dot(m[1], v), dot(m[2], v)];

export function transpose(m: Matrix): Matrix {
    return [
        [m[0][0], m[1][0], m[2][0]],
        [m[0][1], m[1][1], m[2][1]],
        [m[0][2], m[1][2], m[2][2]],
    ];
}

export function product(a: Matrix, b: Matrix): Matrix {
    const columns = transpose(b);
    const row = (r: Vector): Vector => [dot(r, columns[0]), dot(r, columns[1]), dot(r, columns[2])];
    return [row(a[0]), row(a[1]), row(a[2])];
}

/* `v` turned about a unit vector, radians, right-handed: Rodrigues' formula. */
export function turnAbout(v: Vector, axis: Vector, angle: number): Vector {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const along = scale(axis, dot(axis, v) * (1 - c));
    return add(add(scale(v, c), scale(cross(axis, v), s)), along);
}

/* R = Rz·Ry·Rx from angles about x, y, z in radians. */
export function rotation(angles: Vector): Matrix {
    const [cx, cy, cz] = angles.map(Math.cos) as unknown as Vector;
    const [sx, sy, sz] = angles.map(Math.sin) as unknown as Vector;
    return [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ];
}

/* Entries of two matrices that are the same rotation differ by less. */
const SAME = 1e-12;

function isSame(a: Matrix, b: Matrix): boolean {
    return a.every((row, i) => row.every((x, k) => Math.abs(x - (b[i]?.[k] ?? 0)) < SAME));
}

const TURN = 2 * Math.PI;
const nearestTurn = (angle: number, near: number): number =>
    angle + TURN * Math.round((near - angle) / TURN);

/* Angles whose rotation is `m`. Of the two triples and their full turns the one nearest to `near`
 * is taken, so that fields do not jump while something turns. */
export function anglesOf(m: Matrix, near: Vector = [0, 0, 0]): Vector {
    const sy = Math.min(1, Math.max(-1, -m[2][0]));
    const y = Math.asin(sy);
    if (Math.abs(sy) > 1 - 1e-12) {
        /* Gimbal lock: only x ∓ z is known; z keeps its value. */
        const z = near[2];
        const sum = Math.atan2(-m[1][2], m[1][1]);
        const x = sy > 0 ? sum + z : sum - z;
        return [nearestTurn(x, near[0]), nearestTurn(y, near[1]), z];
    }
    const first: Vector = [Math.atan2(m[2][1], m[2][2]), y, Math.atan2(m[1][0], m[0][0])];
    const second: Vector = [first[0] + Math.PI, Math.PI - y, first[2] + Math.PI];
    const toNear = (a: Vector): Vector => [
        nearestTurn(a[0], near[0]),
        nearestTurn(a[1], near[1]),
        nearestTurn(a[2], near[2]),
    ];
    const [a, b] = [toNear(first), toNear(second)];
    return length(subtract(a, near)) <= length(subtract(b, near)) ? a : b;
}

/* --- nodes --- */

export interface Transform {
    readonly translation: Vector;
    readonly rotation: Vector;
    readonly scale: Vector;
}

export function transformOf(node: SceneNode): Transform {
    const read = (name: string, fallback: number): Vector =>
        vectorOf(numbersOf(node.transform[name] ?? fallback));
    return {
        translation: read("translation", 0),
        rotation: read("rotation", 0),
        scale: read("scale", 1),
    };
}

/* p_parent = R·S·p + translation. */
export function toParent(transform: Transform, point: Vector): Vector {
    const turned = apply(rotation(transform.rotation), multiply(point, transform.scale));
    return add(turned, transform.translation);
}

export function fromParent(transform: Transform, point: Vector): Vector {
    const inverse = transpose(rotation(transform.rotation));
    return divide(apply(inverse, subtract(point, transform.translation)), transform.scale);
}

/* The modifier that turns what is below it, moved out along X first. */
const TURNING = "revolve";
const NOWHERE: Vector = [0, 0, 0];

/* From where the children of a node have their places to where these are in its own space. */
function shiftOf({ type, params }: SceneNode): Vector {
    return type === TURNING ? [Number(params.offset ?? 0), 0, 0] : NOWHERE;
}

/* From the space of the last node of a path to what is around the first. */
export function outOf(path: readonly SceneNode[], point: Vector): Vector {
    return path.reduceRight(
        (p, node, i) =>
            toParent(transformOf(node), i === path.length - 1 ? p : add(p, shiftOf(node))),
        point,
    );
}

/* The way back. */
export function into(path: readonly SceneNode[], point: Vector): Vector {
    return path.reduce((p, node, i) => {
        const own = fromParent(transformOf(node), p);
        return i === path.length - 1 ? own : subtract(own, shiftOf(node));
    }, point);
}

/* From a node's own space to the world's. */
export const toWorld = (document: SceneDocument, id: string, point: Vector): Vector =>
    outOf(pathTo(document, id), point);

/* From the world to a node's own space. */
export const fromWorld = (document: SceneDocument, id: string, point: Vector): Vector =>
    into(pathTo(document, id), point);

/* From the world to where a node's children have their places. */
export function fromWorldInto(document: SceneDocument, parent: string, point: Vector): Vector {
    const node = document.nodes.get(parent);
    const own = fromWorld(document, parent, point);
    return node ? subtract(own, shiftOf(node)) : own;
}

const uniform = (s: Vector): boolean => s[0] === s[1] && s[1] === s[2];

/* Combined transform from a node's space to the world; null where a scale on the way is not
 * uniform, which no single transform could express. */
function worldOf(document: SceneDocument, id: string): Transform | null {
    let turned: Matrix = rotation([0, 0, 0]);
    let translation: Vector = [0, 0, 0];
    let size = 1;
    for (const node of pathTo(document, id)) {
        const own = transformOf(node);
        if (!uniform(own.scale)) {
            return null;
        }
        translation = add(translation, scale(apply(turned, own.translation), size));
        turned = product(turned, rotation(own.rotation));
        size *= own.scale[0];
    }
    return { translation, rotation: anglesOf(turned), scale: [size, size, size] };
}

/* The transform that keeps a node where it is in the world when `parent` becomes its parent; null
 * where none does. */
export function transformUnder(
    document: SceneDocument,
    id: string,
    parent: string,
): Transform | null {
    const node = document.nodes.get(id);
    const from = node?.parent == null ? null : worldOf(document, node.parent);
    const to = worldOf(document, parent);
    if (!node || !from || !to) {
        return null;
    }
    const own = transformOf(node);
    const ratio = from.scale[0] / to.scale[0];
    const [before, after] = [rotation(from.rotation), rotation(to.rotation)];
    const turned = product(transpose(after), product(before, rotation(own.rotation)));
    return {
        translation: fromParent(to, toParent(from, own.translation)),
        /* Angles that nothing turned stay as they were written. */
        rotation: isSame(before, after) ? own.rotation : anglesOf(turned, own.rotation),
        scale: scale(own.scale, ratio),
    };
}

/* Less than this, in radians, is upright. */
const UPRIGHT = 1e-3;

/* The least turn that takes the y axis to a unit vector. */
function turnTo(up: Vector): Matrix {
    const y: Vector = [0, 1, 0];
    const angle = Math.acos(Math.min(1, Math.max(-1, up[1])));
    const axis = normalize(cross(y, up), [1, 0, 0]);
    return angle < UPRIGHT
        ? rotation([0, 0, 0])
        : transpose([
              turnAbout([1, 0, 0], axis, angle),
              turnAbout(y, axis, angle),
              turnAbout([0, 0, 1], axis, angle),
          ]);
}

/* The place of something below `parent`, already turned by `own`, that comes to stand at a point of
 * the world with its y axis along a unit vector. Where a scale on the way is not uniform, it is not
 * turned further. */
export function standingUnder(
    document: SceneDocument,
    parent: string,
    at: Vector,
    up: Vector,
    own: Vector,
): Omit<Transform, "scale"> {
    const world = worldOf(document, parent);
    const turn = world ? product(transpose(rotation(world.rotation)), turnTo(up)) : null;
    const still = turn === null || isSame(turn, rotation([0, 0, 0]));
    return {
        translation: fromWorldInto(document, parent, at),
        rotation: still ? own : anglesOf(product(turn, rotation(own)), own),
    };
}
