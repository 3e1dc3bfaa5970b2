/* SPDX-License-Identifier: MIT */
/* A plane across an axis that cuts this page's pictures: no edit, and nobody else sees it. */
import { ballWithin } from "./bounds.ts";
import type { Box } from "./camera.ts";
import type { JsonObject } from "./json.ts";
import type { Vector } from "./transform.ts";

export const SECTION_AXES = ["x", "y", "z"] as const;
export type SectionAxis = (typeof SECTION_AXES)[number];

export interface Section {
    readonly axis: SectionAxis;
    /* Where the plane is along the axis. */
    readonly at: number;
    /* What has less than `at` is left out; else what has more. */
    readonly flipped: boolean;
}

/* A unit vector, to where the picture is cut away. */
export function sectionNormal({ axis, flipped }: Section): Vector {
    const along = (one: SectionAxis): number => (one === axis ? (flipped ? -1 : 1) : 0);
    return [along("x"), along("y"), along("z")];
}

/* As requests have it. */
export function printSection(section: Section): JsonObject {
    return {
        normal: [...sectionNormal(section)],
        offset: section.flipped ? -section.at : section.at,
    };
}

/* The member of a request; none where nothing is cut. */
export const sectionMember = (section: Section | null): { section?: JsonObject } =>
    section === null ? {} : { section: printSection(section) };

/* Through the middle of a box, across the axis along which it is looked at most, so that the eye
 * looks at the cut. */
export function sectionSeenFrom(eye: Vector, box: Box): Section {
    const { center } = ballWithin(box);
    const apart = SECTION_AXES.map((_, i) => (eye[i] ?? 0) - (center[i] ?? 0));
    const most = Math.max(...apart.map(Math.abs));
    const i = Math.max(
        0,
        apart.findIndex((x) => Math.abs(x) === most),
    );
    return across(SECTION_AXES[i] ?? "x", (apart[i] ?? 0) < 0, center);
}

const across = (axis: SectionAxis, flipped: boolean, center: Vector): Section => ({
    axis,
    at: center[SECTION_AXES.indexOf(axis)] ?? 0,
    flipped,
});

/* The same across another axis, through the middle again. */
export function sectionAcross(section: Section, axis: SectionAxis, box: Box): Section {
    const { center } = ballWithin(box);
    return section.axis === axis ? section : across(axis, section.flipped, center);
}

/* Where planes across an axis cut the box. */
export function sectionRange(axis: SectionAxis, { low, high }: Box) {
    const i = SECTION_AXES.indexOf(axis);
    return { low: low[i] ?? 0, high: high[i] ?? 0 };
}
