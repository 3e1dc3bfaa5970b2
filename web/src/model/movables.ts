/* SPDX-License-Identifier: MIT */
/* What a hand can move in the picture: nodes, and the lights, volumes and camera that stand in the
 * scene. Each knows where it is, and the operations that a move, turn or scaling of it takes. */
import { ballOf } from "./bounds.ts";
import { axes, cameraOf } from "./camera.ts";
import { findResource, pathTo, resourceParams, type SceneDocument, topmost } from "./document.ts";
import type { Delta } from "./grip.ts";
import type { Pivot, Space } from "./hands.ts";
import type { Operation } from "./operation.ts";
import { type ListName, valuesPlace } from "./places.ts";
import { findParam, type Schema, valueIn } from "./schema.ts";
import {
    add,
    anglesOf,
    apply,
    fromWorldInto,
    length,
    type Matrix,
    multiply,
    product,
    rotation,
    scale,
    subtract,
    toWorld,
    transformOf,
    transpose,
    turnAbout,
    type Vector,
    vectorOf,
} from "./transform.ts";
import { tidy, tidyAngle } from "./units.ts";
import { numbersOf } from "./values.ts";
import type { Subject } from "./view.ts";

export interface Movable {
    /* In the world. */
    readonly origin: Vector;
    readonly center: Vector;
    /* Columns are unit vectors of the world: its own axes, and those of its parent. They are
     * left-handed below a mirror. */
    readonly own: Matrix;
    readonly parent: Matrix;
    readonly motions: readonly Delta["motion"][];
    /* `frame`: the axes along which the places of things are scaled. */
    readonly ops: (delta: Delta, pivot: Vector, frame: Matrix) => readonly Operation[];
}

export const IDENTITY: Matrix = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
];

/* The matrix of a turn about a unit vector. */
export function turnMatrix(axis: Vector, angle: number): Matrix {
    const turned = (v: Vector): Vector => turnAbout(v, axis, angle);
    return transpose([turned([1, 0, 0]), turned([0, 1, 0]), turned([0, 0, 1])]);
}

/* Where a point goes. A scaling acts along axes of `frame`. */
export function moved(point: Vector, delta: Delta, pivot: Vector, frame: Matrix): Vector {
    const arm = subtract(point, pivot);
    switch (delta.motion) {
        case "move":
            return add(point, delta.by);
        case "turn":
            return add(pivot, turnAbout(arm, delta.axis, delta.angle));
        case "scale": {
            const along = multiply(apply(transpose(frame), arm), delta.factors);
            return add(pivot, apply(frame, along));
        }
    }
}

/* With the axes turned about along which a scale is negative. */
const mirrored = (m: Matrix, [x, y, z]: Vector): Matrix => {
    const signs: Vector = [Math.sign(x), Math.sign(y), Math.sign(z)];
    return [multiply(m[0], signs), multiply(m[1], signs), multiply(m[2], signs)];
};

/* The rotations and mirrors on the way to a node, its own included; how large a scale is leaves them
 * as they are. */
function turnTo(document: SceneDocument, id: string): Matrix {
    return pathTo(document, id).reduce((turned, node) => {
        const own = transformOf(node);
        return mirrored(product(turned, rotation(own.rotation)), own.scale);
    }, IDENTITY);
}

const set = (at: string, value: readonly number[]): Operation => ({ op: "set", at, value });

/* Noise of arithmetic. */
const NOISE = 1e-12;

const tidyVector = (value: Vector): readonly number[] =>
    value.map((v) => (Math.abs(v) < NOISE ? 0 : tidy(v)));

function nodeMovable(document: SceneDocument, schema: Schema, id: string): Movable | null {
    const node = document.nodes.get(id);
    if (!node) {
        return null;
    }
    const own = transformOf(node);
    const parent = node.parent === null ? IDENTITY : turnTo(document, node.parent);
    const origin = toWorld(document, id, [0, 0, 0]);
    const turned = product(parent, rotation(own.rotation));
    const at = `/nodes/${id}/transform`;
    const place = (point: Vector): Operation => {
        const inside = node.parent === null ? point : fromWorldInto(document, node.parent, point);
        return set(`${at}/translation`, tidyVector(inside));
    };
    return {
        origin,
        center: ballOf(document, schema, [id]).center,
        own: turned,
        parent,
        motions: ["move", "turn", "scale"],
        ops: (delta, pivot, frame) => {
            const to = moved(origin, delta, pivot, frame);
            const ops = delta.motion !== "move" && isSamePoint(to, origin) ? [] : [place(to)];
            if (delta.motion === "turn") {
                const turn = turnMatrix(delta.axis, delta.angle);
                const inside = product(transpose(parent), product(turn, turned));
                ops.push(set(`${at}/rotation`, anglesOf(inside, own.rotation).map(tidyAngle)));
            } else if (delta.motion === "scale") {
                ops.push(set(`${at}/scale`, tidyVector(multiply(own.scale, delta.factors))));
            }
            return ops;
        },
    };
}

function isSamePoint(a: Vector, b: Vector): boolean {
    return a.every((x, i) => Math.abs(x - (b[i] ?? 0)) <= 1e-9 * Math.max(1, Math.abs(x)));
}

/* Lights and volumes: a place, and for some a direction. */
function resourceMovable(
    document: SceneDocument,
    schema: Schema,
    list: ListName,
    name: string,
): Movable | null {
    const resource = findResource(document, list, name);
    const params = resource ? resourceParams(schema, document, list, resource.type) : [];
    const read = (member: string): Vector | null => {
        const param = findParam(params, member);
        return resource && param ? vectorOf(numbersOf(valueIn(resource.values, param))) : null;
    };
    const [position, direction] = [read("position"), read("direction")];
    if (position === null) {
        return null;
    }
    const at = (member: string): string => `${valuesPlace(list, name)}/${member}`;
    return {
        origin: position,
        center: position,
        own: IDENTITY,
        parent: IDENTITY,
        motions: direction === null ? ["move"] : ["move", "turn"],
        ops: (delta, pivot, frame) => {
            const to = moved(position, delta, pivot, frame);
            const ops = isSamePoint(to, position) ? [] : [set(at("position"), tidyVector(to))];
            if (delta.motion === "turn" && direction !== null) {
                const turned = turnAbout(direction, delta.axis, delta.angle);
                ops.push(set(at("direction"), tidyVector(turned)));
            }
            return ops;
        },
    };
}

/* Directions closer than this are the same. */
const SAME_WAY = 1e-6;

/* The document's camera, as a body: its target goes along. `up` stays as it is, unless the camera
 * rolls. */
function cameraMovable(document: SceneDocument): Movable {
    const camera = cameraOf(document.camera);
    const { right, up, forward } = axes(camera);
    const { position } = camera;
    return {
        origin: position,
        center: position,
        own: transpose([right, up, scale(forward, -1)]),
        parent: IDENTITY,
        motions: ["move", "turn"],
        ops: (delta, pivot, frame) => {
            const [at, target] = [position, camera.target].map((point) =>
                moved(point, delta, pivot, frame),
            ) as [Vector, Vector];
            const ops = [
                set("/camera/position", tidyVector(at)),
                set("/camera/target", tidyVector(target)),
            ];
            if (delta.motion === "turn") {
                const above = turnAbout(up, delta.axis, delta.angle);
                const now = axes({ ...camera, position: at, target }).up;
                if (length(subtract(now, above)) > SAME_WAY) {
                    ops.push(set("/camera/up", tidyVector(above)));
                }
            }
            return ops;
        },
    };
}

/* What the selection or the inspector's subject lets a hand hold; the active one last. */
export function movablesOf(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    subject: Subject,
): readonly Movable[] {
    if (subject.kind === "resource") {
        const one = resourceMovable(document, schema, subject.list, subject.name);
        return one === null ? [] : [one];
    }
    if (subject.kind === "camera") {
        return [cameraMovable(document)];
    }
    if (subject.kind !== "nodes") {
        return [];
    }
    const active = selection.at(-1);
    const ids = topmost(document, selection);
    return [...ids.filter((id) => id !== active), ...ids.filter((id) => id === active)].flatMap(
        (id) => {
            const inTree = pathTo(document, id)[0]?.id === document.root;
            return (inTree && nodeMovable(document, schema, id)) || [];
        },
    );
}

export function middleOf(points: readonly Vector[]): Vector {
    const sum = points.reduce<Vector>((a, b) => add(a, b), [0, 0, 0]);
    return scale(sum, 1 / Math.max(1, points.length));
}

/* Where the gizmo stands. */
export function pivotOf(movables: readonly Movable[], pivot: Pivot): Vector {
    if (pivot === "center") {
        return middleOf(movables.map((movable) => movable.center));
    }
    return pivot === "each"
        ? middleOf(movables.map((movable) => movable.origin))
        : (movables.at(-1)?.origin ?? [0, 0, 0]);
}

/* The axes of the gizmo; a scaling is always along a node's own. */
export function frameOf(
    movables: readonly Movable[],
    space: Space,
    motion: Delta["motion"],
): Matrix {
    const active = movables.at(-1);
    if (!active) {
        return IDENTITY;
    }
    if (motion === "scale" || space === "local") {
        return active.own;
    }
    return space === "parent" ? active.parent : IDENTITY;
}

/* The operations of one motion of all. */
export function motionOps(
    movables: readonly Movable[],
    delta: Delta,
    pivot: Vector,
    frame: Matrix,
    mode: Pivot,
): readonly Operation[] {
    return movables.flatMap((one) =>
        one.motions.includes(delta.motion)
            ? one.ops(delta, mode === "each" ? one.origin : pivot, frame)
            : [],
    );
}
