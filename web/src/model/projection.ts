/* SPDX-License-Identifier: MIT */
/* From the world to a point of the picture and back, as a camera sees it. Points of the picture are
 * CSS pixels from its left top. */
import { axes, type Camera } from "./camera.ts";
import { add, dot, normalize, scale, subtract, type Vector } from "./transform.ts";

export interface Spot {
    readonly x: number;
    readonly y: number;
}

export interface Size {
    readonly width: number;
    readonly height: number;
}

/* `along` is a unit vector. */
export interface Ray {
    readonly from: Vector;
    readonly along: Vector;
}

export interface Projection {
    readonly size: Size;
    /* Unit vectors in the world. */
    readonly right: Vector;
    readonly up: Vector;
    readonly forward: Vector;
    /* Null where the point is not in front of the camera. */
    spotOf(point: Vector): Spot | null;
    rayAt(spot: Spot): Ray;
    /* Unit vector from the camera to a point. */
    towards(point: Vector): Vector;
    /* Scene units that a pixel covers at the depth of a point. */
    unitsAt(point: Vector): number;
}

/* Nearer than this to the plane of the camera, relative to its distance, is not seen. */
const NEAR = 1e-4;

/* The picture's height spans `fov`, or `height` units where there is no perspective. */
export function projectionOf(camera: Camera, size: Size): Projection {
    const { right, up, forward } = axes(camera);
    const { position, height } = camera;
    const near = NEAR * Math.max(1e-6, dot(subtract(camera.target, position), forward));
    const span = 2 * Math.tan((camera.fov * Math.PI) / 360);
    const depthOf = (point: Vector): number => dot(subtract(point, position), forward);
    const unitsAt = (point: Vector): number =>
        (height ?? span * Math.max(near, depthOf(point))) / size.height;
    return {
        size,
        right,
        up,
        forward,
        unitsAt,
        spotOf(point) {
            const apart = subtract(point, position);
            if (height === null && depthOf(point) < near) {
                return null;
            }
            const units = unitsAt(point);
            return {
                x: size.width / 2 + dot(apart, right) / units,
                y: size.height / 2 - dot(apart, up) / units,
            };
        },
        rayAt({ x, y }) {
            const units = (height ?? span) / size.height;
            const aside = add(
                scale(right, (x - size.width / 2) * units),
                scale(up, (size.height / 2 - y) * units),
            );
            return height === null
                ? { from: position, along: normalize(add(forward, aside)) }
                : { from: add(position, aside), along: forward };
        },
        towards: (point) =>
            height === null ? normalize(subtract(point, position), forward) : forward,
    };
}

/* --- rays against lines and planes --- */

/* Two directions whose angle is smaller (in radians) are parallel. */
const PARALLEL = 1e-6;

/* How far along the line from `point` in the unit direction `along` the nearest point to a ray is;
 * null where they are parallel. */
export function alongLine(ray: Ray, point: Vector, along: Vector): number | null {
    const slant = dot(ray.along, along);
    const apart = subtract(ray.from, point);
    const sine = 1 - slant * slant;
    if (sine < PARALLEL * PARALLEL) {
        return null;
    }
    return (dot(apart, along) - slant * dot(apart, ray.along)) / sine;
}

/* Where a ray meets the plane through `point` with the unit normal; null where it does not. */
export function onPlane(ray: Ray, point: Vector, normal: Vector): Vector | null {
    const slant = dot(ray.along, normal);
    if (Math.abs(slant) < PARALLEL) {
        return null;
    }
    const far = dot(subtract(point, ray.from), normal) / slant;
    return add(ray.from, scale(ray.along, far));
}
