/* SPDX-License-Identifier: MIT */
/* The handle of a section in the picture: where its arrow stands, what shows the plane, and where a
 * drag puts the plane. Pure functions of the start and the pointer, so a lost event costs nothing. */
import { ballWithin } from "./bounds.ts";
import type { Box } from "./camera.ts";
import { type Axis, axisOf, deltaTo, SNAP } from "./grip.ts";
import { IDENTITY } from "./movables.ts";
import { alongLine, onPlane, type Projection, type Size, type Spot } from "./projection.ts";
import { SECTION_AXES, type Section, sectionNormal, sectionRange } from "./section.ts";
import { add, cross, dot, length, normalize, scale, subtract, type Vector } from "./transform.ts";
import { snap } from "./units.ts";

/* The arrow from the plane to where the picture is cut away. */
export interface SectionArrow {
    /* A point of the plane, in the world and in the picture. */
    readonly at: Vector;
    readonly foot: Spot;
    /* The point of the plane that is nearest to the middle of the scene. */
    readonly middle: Vector;
    /* A unit vector of the picture: a pointer that goes this way moves the plane along its normal. */
    readonly way: Spot;
    /* The normal is along the view: there is no way in the picture that follows it. */
    readonly headOn: boolean;
}

/* Where the arrow may stand: a part of the picture, in pixels. */
export interface Room {
    readonly left: number;
    readonly top: number;
    readonly right: number;
    readonly bottom: number;
}

/* Pixels. */
export const SECTION_REACH = 66;
/* From the middle of the gizmo: outside of its rings. */
const CLEAR = 140;

/* The cosine from which the normal counts as along the view. */
const HEAD_ON = 0.985;
/* How far from the middle of the box the arrow may stand, by half of its longest side. */
const FARTHEST = 2;
/* Half a side of the outline, at most, by the shorter side of the picture. */
const SEEN = 0.36;
/* Points of each side of the outline: a side may end behind the camera. */
const SIDE_STEPS = 24;

const axisIndex = ({ axis }: Section): Axis => SECTION_AXES.indexOf(axis) as Axis;

/* The point with the plane's place along its axis. */
export function onSection(section: Section, [x, y, z]: Vector): Vector {
    const { axis, at } = section;
    return [axis === "x" ? at : x, axis === "y" ? at : y, axis === "z" ? at : z];
}

/* --- the arrow --- */

function unitOf(from: Spot, to: Spot): Spot {
    const far = Math.hypot(to.x - from.x, to.y - from.y);
    return { x: (to.x - from.x) / far, y: (to.y - from.y) / far };
}

/* From a point of the plane; null where it is behind the camera. A plane that faces the viewer is
 * pulled nearer by a way down, as what lies on a table is. */
export function arrowFrom(
    at: Vector,
    section: Section,
    box: Box,
    projection: Projection,
): SectionArrow | null {
    const normal = sectionNormal(section);
    const foot = projection.spotOf(at);
    const tip = projection.spotOf(add(at, scale(normal, projection.unitsAt(at))));
    if (foot === null || tip === null) {
        return null;
    }
    const facing = -dot(normal, projection.towards(at));
    const headOn = Math.abs(facing) > HEAD_ON;
    const way = headOn ? { x: 0, y: facing > 0 ? 1 : -1 } : unitOf(foot, tip);
    return { at, foot, middle: onSection(section, ballWithin(box).center), way, headOn };
}

/* In the plane, and across the arrow in the picture; to the left where it can be. */
function sideOf(
    { at, headOn }: Pick<SectionArrow, "at" | "headOn">,
    section: Section,
    projection: Projection,
): Vector {
    const across = headOn ? projection.up : projection.towards(at);
    const side = normalize(cross(sectionNormal(section), across));
    return dot(side, projection.right) > 0 ? scale(side, -1) : side;
}

/* Moved to the side as far as leaves room for the gizmo, whose middle is at `gizmo`. */
function besideGizmo(
    { at, foot }: SectionArrow,
    side: Vector,
    { unitsAt, spotOf }: Projection,
    gizmo: Spot,
): Vector {
    const unit = unitsAt(at);
    const next = spotOf(add(at, scale(side, unit)));
    const apart = { x: foot.x - gizmo.x, y: foot.y - gizmo.y };
    if (next === null || Math.hypot(apart.x, apart.y) >= CLEAR) {
        return at;
    }
    const way = unitOf(foot, next);
    const beside = apart.x * way.x + apart.y * way.y;
    const across = apart.x * way.y - apart.y * way.x;
    const wanted = Math.sqrt(CLEAR * CLEAR - across * across) * (beside < -1 ? -1 : 1);
    return add(at, scale(side, (wanted - beside) * unit));
}

const between = (low: number, x: number, high: number): number =>
    low > high ? (low + high) / 2 : Math.min(high, Math.max(low, x));

/* The foot nearest to that of the arrow from which all of the arrow is in the room. */
function footWithin({ foot, way }: SectionArrow, { left, top, right, bottom }: Room): Spot {
    const [x, y] = [way.x * SECTION_REACH, way.y * SECTION_REACH];
    return {
        x: between(left - Math.min(0, x), foot.x, right - Math.max(0, x)),
        y: between(top - Math.min(0, y), foot.y, bottom - Math.max(0, y)),
    };
}

/* At the middle of what is seen of the plane, with room for the gizmo, if there is one, and for what
 * lies over the picture. Null where nothing of the plane is before the camera. */
export function sectionArrow(
    section: Section,
    box: Box,
    projection: Projection,
    room: Room,
    gizmo: Spot | null,
): SectionArrow | null {
    const { center, radius } = ballWithin(box);
    const middle = onSection(section, center);
    const first = arrowFrom(middle, section, box, projection);
    const side = sideOf(first ?? { at: middle, headOn: false }, section, projection);
    const at = first && gizmo ? besideGizmo(first, side, projection, gizmo) : middle;
    const wanted = arrowFrom(at, section, box, projection);
    const foot = wanted ? footWithin(wanted, room) : middleOf(room);
    if (wanted && foot.x === wanted.foot.x && foot.y === wanted.foot.y) {
        return wanted;
    }
    const ray = projection.rayAt(foot);
    /* Of a plane that is seen from its edge, a line alone is in the picture. */
    const along = alongLine(ray, middle, side);
    const points = [
        onPlane(ray, middle, sectionNormal(section)),
        along === null ? null : add(middle, scale(side, along)),
        middle,
    ];
    const arrows = points.map((point) =>
        point && length(subtract(point, middle)) <= FARTHEST * radius
            ? arrowFrom(point, section, box, projection)
            : null,
    );
    return arrows.find((arrow) => arrow !== null) ?? null;
}

const middleOf = ({ left, top, right, bottom }: Room): Spot => ({
    x: (left + right) / 2,
    y: (top + bottom) / 2,
});

/* --- the plane --- */

/* A square on the plane, as lines in the picture: around the box, and no larger than is seen. */
export function sectionOutline(
    section: Section,
    { at, middle }: SectionArrow,
    box: Box,
    { size, spotOf, unitsAt }: Projection,
): readonly (readonly Spot[])[] {
    const { center, radius } = ballWithin(box);
    const whole = isIn(spotOf(middle), size);
    const around = whole ? middle : at;
    /* It does not shrink as the plane comes nearer. */
    const seen = SEEN * Math.min(size.width, size.height) * unitsAt(whole ? center : at);
    const half = Math.min(radius, seen);
    const [u, v] = [1, 2].map((by) =>
        scale(axisOf(IDENTITY, ((axisIndex(section) + by) % 3) as Axis), half),
    ) as [Vector, Vector];
    const corner = (a: number, b: number): Vector => add(around, add(scale(u, a), scale(v, b)));
    const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
    const lines: Spot[][] = [[]];
    for (const [i, from] of corners.entries()) {
        const way = subtract(corners[(i + 1) % corners.length] ?? from, from);
        for (let step = i === 0 ? 0 : 1; step <= SIDE_STEPS; step++) {
            const spot = spotOf(add(from, scale(way, step / SIDE_STEPS)));
            if (spot === null) {
                lines.push([]);
            } else {
                lines.at(-1)?.push(spot);
            }
        }
    }
    return lines.filter((spots) => spots.length > 1);
}

const isIn = (spot: Spot | null, { width, height }: Size): boolean =>
    spot !== null && spot.x > 0 && spot.y > 0 && spot.x < width && spot.y < height;

/* --- a drag --- */

export interface SectionGrip {
    /* At the start, as the arrow, the picture and the pointer were. */
    readonly section: Section;
    readonly arrow: SectionArrow;
    readonly projection: Projection;
    readonly from: Spot;
    readonly box: Box;
}

/* How far along its axis the pointer's way moves the plane; null: the pointer is beyond the end of it. */
function movedBy({ section, arrow, projection, from }: SectionGrip, to: Spot): number | null {
    const axis = axisIndex(section);
    const { at, way, headOn } = arrow;
    if (headOn) {
        const pixels = (to.x - from.x) * way.x + (to.y - from.y) * way.y;
        return pixels * projection.unitsAt(at) * sectionNormal(section)[axis];
    }
    const constraint = { motion: "move", axis, plane: false } as const;
    const delta = deltaTo({ constraint, pivot: at, frame: IDENTITY, projection, from }, to);
    return delta?.motion === "move" ? delta.by[axis] : null;
}

/* Not beyond the box, or where it was. `snaps`: in steps of the place. Null: it stays. */
export function dragSection(grip: SectionGrip, to: Spot, snaps: boolean): Section | null {
    const { section, box } = grip;
    const by = movedBy(grip, to);
    return by === null ? null : placed(section, section.at + by, box, snaps ? SNAP.move : 0);
}

/* The same by so many steps; a tenth of them where `fine`. */
export function stepSection(section: Section, steps: number, fine: boolean, box: Box): Section {
    const step = SNAP.move * (fine ? 0.1 : 1);
    return placed(section, snap(section.at + steps * step, step / 10), box, 0);
}

function placed(section: Section, at: number, box: Box, step: number): Section {
    const { low, high } = sectionRange(section.axis, box);
    const [least, most] = [Math.min(low, section.at), Math.max(high, section.at)];
    return { ...section, at: snap(between(least, at, most), step) };
}
