/* SPDX-License-Identifier: MIT */
/* Camera moves as pure functions of the camera before: orbit, pan, dolly, frame, fixed views.
 * Right-handed, +Y up unless the camera's `up` says else; `fov` is vertical, in degrees. What else
 * a camera has, such as its lens, is the document's alone. */
import type { JsonObject } from "./json.ts";
import type { Values } from "./schema.ts";
import {
    add,
    cross,
    dot,
    length,
    normalize,
    scale,
    subtract,
    turnAbout,
    type Vector,
    vectorOf,
} from "./transform.ts";
import { numbersOf } from "./values.ts";

export interface Camera {
    readonly position: Vector;
    readonly target: Vector;
    readonly up: Vector;
    readonly fov: number;
    /* Of the whole picture, in scene units, where there is no perspective; else null. */
    readonly height: number | null;
}

export const DEFAULT_CAMERA: Camera = {
    position: [0, 1.5, 6],
    target: [0, 0, 0],
    up: [0, 1, 0],
    fov: 45,
    height: null,
};

/* The camera that a document (or its absence) describes; `defaults` come from the schema. */
export function cameraOf(values: Values, defaults: Values = {}): Camera {
    const read = (name: "position" | "target" | "up"): Vector => {
        const value = values[name] ?? defaults[name];
        return value === undefined ? DEFAULT_CAMERA[name] : vectorOf(numbersOf(value));
    };
    return {
        position: read("position"),
        target: read("target"),
        up: read("up"),
        fov: Number(values.fov ?? defaults.fov ?? DEFAULT_CAMERA.fov),
        height:
            values.type === "orthographic" ? Number(values.height ?? defaults.height ?? 1) : null,
    };
}

/* Digits that a document keeps of a number. */
const tidy = (x: number): number => Number(x.toPrecision(6));

/* As an edit or a view message says it. */
export function printCamera(camera: Camera): JsonObject {
    return {
        position: camera.position.map(tidy),
        target: camera.target.map(tidy),
        up: camera.up.map(tidy),
        ...(camera.height === null ? { fov: tidy(camera.fov) } : { height: tidy(camera.height) }),
    };
}

/* What printCamera printed. */
export function readCamera(printed: JsonObject): Camera {
    const type = printed.height === undefined ? "perspective" : "orthographic";
    return cameraOf({ ...printed, type } as Values);
}

/* Unit vectors: right and up in the picture, forward into it. */
export function axes(camera: Camera): { right: Vector; up: Vector; forward: Vector } {
    const forward = normalize(subtract(camera.target, camera.position), [0, 0, -1]);
    const side = cross(forward, camera.up);
    const right = normalize(length(side) > 1e-9 ? side : cross(forward, [0, 0, -1]), [1, 0, 0]);
    return { right, up: cross(right, forward), forward };
}

export function distance(camera: Camera): number {
    return length(subtract(camera.position, camera.target));
}

/* Nearest and farthest that a dolly goes; scene units. */
const NEAREST = 1e-3;
const FARTHEST = 1e5;
/* How near to the pole an orbit ends, radians. */
const POLE = 0.01;

/* Turns about the target: `azimuth` about `up`, positive moves the camera to the right;
 * `elevation` towards `up`. Radians. Ends short of the poles. */
export function orbit(camera: Camera, azimuth: number, elevation: number): Camera {
    const up = normalize(camera.up);
    const arm = subtract(camera.position, camera.target);
    const polar = Math.acos(Math.min(1, Math.max(-1, dot(normalize(arm), up))));
    const wanted = Math.min(Math.PI - POLE, Math.max(POLE, polar - elevation));
    const { right } = axes(camera);
    const lifted = turnAbout(arm, right, wanted - polar);
    return { ...camera, position: add(camera.target, turnAbout(lifted, up, azimuth)) };
}

/* World units per pixel at the target's distance. */
export function unitsPerPixel(camera: Camera, height: number): number {
    const seen = camera.height ?? 2 * distance(camera) * Math.tan((camera.fov * Math.PI) / 360);
    return seen / Math.max(1, height);
}

/* Moves position and target so that what is at the target's distance follows the pointer. */
export function pan(camera: Camera, dx: number, dy: number, height: number): Camera {
    const { right, up } = axes(camera);
    const units = unitsPerPixel(camera, height);
    const shift = add(scale(right, -dx * units), scale(up, dy * units));
    return {
        ...camera,
        position: add(camera.position, shift),
        target: add(camera.target, shift),
    };
}

/* Where in the view: x and y from the left top, and its size; any unit. */
export interface Pointer {
    readonly x: number;
    readonly y: number;
    readonly width: number;
    readonly height: number;
}

/* What lies under a point of the view at the target's distance. */
export function pointUnder(camera: Camera, { x, y, width, height }: Pointer): Vector {
    const { right, up } = axes(camera);
    const units = unitsPerPixel(camera, height);
    const aside = scale(right, (x - width / 2) * units);
    return add(camera.target, add(aside, scale(up, (height / 2 - y) * units)));
}

/* Changes the distance by `factor` (< 1 is nearer), keeping what lies under the pointer at the
 * target's distance in place. A camera that is beyond the limits, as F puts it before something huge,
 * comes back to them by the same steps. */
export function dolly(camera: Camera, factor: number, pointer?: Pointer): Camera {
    const before = distance(camera);
    const [least, most] = [Math.min(NEAREST, before), Math.max(FARTHEST, before)];
    const after = Math.min(most, Math.max(least, before * factor));
    const applied = before > 0 ? after / before : 1;
    const anchor = pointer ? pointUnder(camera, pointer) : camera.target;
    const shrink = (p: Vector): Vector => add(anchor, scale(subtract(p, anchor), applied));
    return {
        ...camera,
        position: shrink(camera.position),
        target: shrink(camera.target),
        height: camera.height === null ? null : camera.height * applied,
    };
}

export interface Ball {
    readonly center: Vector;
    readonly radius: number;
}

/* Around what fills the view. */
const ROOM = 1.15;

/* Looks at a ball from where the camera is, so that it fills the view. `aspect` = width/height. */
export function frame(camera: Camera, ball: Ball, aspect: number): Camera {
    const half = (camera.fov * Math.PI) / 360;
    const narrow = aspect < 1 ? Math.atan(Math.tan(half) * aspect) : half;
    const away = Math.max(NEAREST, (ROOM * ball.radius) / Math.sin(narrow));
    const { forward } = axes(camera);
    return {
        ...camera,
        target: ball.center,
        position: subtract(ball.center, scale(forward, away)),
        height: camera.height === null ? null : (2 * ROOM * ball.radius) / Math.min(1, aspect),
    };
}

/* Along the axes of the world. */
export interface Box {
    readonly low: Vector;
    readonly high: Vector;
}

/* The same of a box, whose corners come as near to the view's edges as there is room beside them. */
export function frameBox(camera: Camera, { low, high }: Box, aspect: number): Camera {
    const center = scale(add(low, high), 0.5);
    const { right, up, forward } = axes(camera);
    const half = Math.tan((camera.fov * Math.PI) / 360);
    let away = NEAREST;
    let height = NEAREST;
    for (let i = 0; i < 8; i++) {
        const corner: Vector = [
            (i & 1 ? high : low)[0],
            (i & 2 ? high : low)[1],
            (i & 4 ? high : low)[2],
        ];
        const from = subtract(corner, center);
        const tall = ROOM * Math.max(Math.abs(dot(from, up)), Math.abs(dot(from, right)) / aspect);
        away = Math.max(away, tall / half - dot(from, forward));
        height = Math.max(height, 2 * tall);
    }
    return {
        ...camera,
        target: center,
        position: subtract(center, scale(forward, away)),
        height: camera.height === null ? null : height,
    };
}

export type ViewName = "front" | "back" | "right" | "left" | "top" | "bottom";

const VIEWS: Record<ViewName, Vector> = {
    front: [0, 0, 1],
    back: [0, 0, -1],
    right: [1, 0, 0],
    left: [-1, 0, 0],
    /* A touch off the pole keeps the picture's up at -Z. */
    top: [0, Math.cos(POLE), Math.sin(POLE)],
    bottom: [0, -Math.cos(POLE), Math.sin(POLE)],
};

/* Looks at the same target from a fixed side. */
export function viewFrom(camera: Camera, name: ViewName): Camera {
    const position = add(camera.target, scale(VIEWS[name], distance(camera)));
    return { ...camera, position, up: [0, 1, 0] };
}

export function equalCamera(a: Camera, b: Camera): boolean {
    return (
        a.fov === b.fov &&
        a.height === b.height &&
        (["position", "target", "up"] as const).every((name) =>
            a[name].every((x, i) => x === b[name][i]),
        )
    );
}
