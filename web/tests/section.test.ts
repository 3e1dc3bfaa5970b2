/* SPDX-License-Identifier: MIT */
/* The handle of a section, without a browser: where it stands, and where a drag puts the plane. */
import { expect, test } from "vitest";
import { type Box, type Camera, DEFAULT_CAMERA } from "../src/model/camera.ts";
import { type Projection, projectionOf } from "../src/model/projection.ts";
import { SECTION_AXES, type Section, sectionNormal } from "../src/model/section.ts";
import {
    dragSection,
    type Room,
    SECTION_REACH,
    sectionArrow,
    sectionOutline,
    stepSection,
} from "../src/model/sectionHandle.ts";
import { add, scale, type Vector } from "../src/model/transform.ts";
import { random } from "./fixture.ts";

const SIZE = { width: 900, height: 600 };
const ROOM: Room = { left: 24, top: 60, right: 876, bottom: 476 };
/* Long along x. */
const BOX: Box = { low: [-2.7, -0.8, -1.1], high: [3.3, 1.2, 0.9] };
const next = random(5);
const within = (size: number): number => (next() - 0.5) * size;

function somewhere(): { section: Section; projection: Projection } {
    const camera: Camera = {
        ...DEFAULT_CAMERA,
        position: [within(14), within(14), within(14)],
        height: next() < 0.3 ? 5 : null,
    };
    const axis = SECTION_AXES[Math.floor(next() * 3)] ?? "x";
    const section = { axis, at: within(2), flipped: next() < 0.5 };
    return { section, projection: projectionOf(camera, SIZE) };
}

test("its foot is on the plane, its arrow along the normal and within the room", () => {
    let seen = 0;
    for (let i = 0; i < 500; i++) {
        const { section, projection } = somewhere();
        const arrow = sectionArrow(section, BOX, projection, ROOM, null);
        if (!arrow) {
            continue;
        }
        expect(arrow.at[SECTION_AXES.indexOf(section.axis)]).toBeCloseTo(section.at, 9);
        const tip = projection.spotOf(add(arrow.at, scale(sectionNormal(section), 1e-3)));
        if (!arrow.headOn && tip) {
            const [x, y] = [tip.x - arrow.foot.x, tip.y - arrow.foot.y];
            expect((x * arrow.way.x + y * arrow.way.y) / Math.hypot(x, y)).toBeCloseTo(1, 3);
        }
        const ends = [0, SECTION_REACH].map((far) => ({
            x: arrow.foot.x + far * arrow.way.x,
            y: arrow.foot.y + far * arrow.way.y,
        }));
        const isIn = ends.every(
            ({ x, y }) =>
                x > ROOM.left - 1 && x < ROOM.right + 1 && y > ROOM.top - 1 && y < ROOM.bottom + 1,
        );
        seen += isIn ? 1 : 0;
    }
    /* Seen from its edge, a plane may have no point that is in the room with its arrow. */
    expect(seen).toBeGreaterThan(400);
});

test("it keeps off the gizmo", () => {
    let kept = 0;
    for (let i = 0; i < 200; i++) {
        const { section, projection } = somewhere();
        const free = sectionArrow(section, BOX, projection, ROOM, null);
        if (!free || Math.hypot(free.foot.x - 450, free.foot.y - 300) > 60) {
            continue;
        }
        const arrow = sectionArrow(section, BOX, projection, ROOM, free.foot);
        const [x, y] = [(arrow?.foot.x ?? 0) - free.foot.x, (arrow?.foot.y ?? 0) - free.foot.y];
        expect(Math.hypot(x, y)).toBeGreaterThan(115);
        kept++;
    }
    expect(kept).toBeGreaterThan(50);
});

test("a drag puts the plane where the pointer's ray is nearest to the axis", () => {
    let dragged = 0;
    for (let i = 0; i < 500; i++) {
        const { section, projection } = somewhere();
        const arrow = sectionArrow(section, BOX, projection, ROOM, null);
        const axis = SECTION_AXES.indexOf(section.axis);
        const by = within(0.6);
        const along = [0, 1, 2].map((one) => (one === axis ? by : 0)) as unknown as Vector;
        const to = arrow && projection.spotOf(add(arrow.at, along));
        if (!arrow || !to || arrow.headOn) {
            continue;
        }
        const grip = { section, arrow, projection, from: arrow.foot, box: BOX };
        const low = Math.min(section.at, BOX.low[axis] ?? 0);
        const high = Math.max(section.at, BOX.high[axis] ?? 0);
        const wanted = Math.min(high, Math.max(low, section.at + by));
        expect(dragSection(grip, to, false)).toMatchObject({ ...section, at: expect.anything() });
        expect(dragSection(grip, to, false)?.at).toBeCloseTo(wanted, 6);
        expect((dragSection(grip, to, true)?.at ?? 0) * 10).toBeCloseTo(Math.round(wanted * 10), 6);
        dragged++;
    }
    expect(dragged).toBeGreaterThan(300);
});

test("a plane that faces the viewer is pulled nearer by a way down", () => {
    const projection = projectionOf({ ...DEFAULT_CAMERA, position: [0.3, 0.2, 6] }, SIZE);
    for (const flipped of [false, true]) {
        const section: Section = { axis: "z", at: 0, flipped };
        const arrow = sectionArrow(section, BOX, projection, ROOM, null);
        expect(arrow).toMatchObject({ headOn: true, way: { x: 0, y: flipped ? -1 : 1 } });
        if (arrow) {
            const grip = { section, arrow, projection, from: arrow.foot, box: BOX };
            const to = { x: arrow.foot.x + 7, y: arrow.foot.y + 50 };
            const wanted = 50 * projection.unitsAt(arrow.at);
            expect(dragSection(grip, to, false)?.at).toBeCloseTo(wanted, 9);
        }
    }
});

test("keys go in steps, and end where the scene ends", () => {
    const section: Section = { axis: "y", at: 0.1, flipped: false };
    expect(stepSection(section, 2, false, BOX).at).toBe(0.3);
    expect(stepSection(section, -1, true, BOX).at).toBe(0.09);
    expect(stepSection(section, Number.POSITIVE_INFINITY, false, BOX).at).toBe(1.2);
    expect(stepSection(section, Number.NEGATIVE_INFINITY, false, BOX).at).toBe(-0.8);
});

test("the outline is one closed line where all of it is before the camera", () => {
    const section: Section = { axis: "z", at: 0, flipped: false };
    const outline = (position: Vector): number => {
        const projection = projectionOf({ ...DEFAULT_CAMERA, position }, SIZE);
        const arrow = sectionArrow(section, BOX, projection, ROOM, null);
        const lines = arrow ? sectionOutline(section, arrow, BOX, projection) : [];
        expect(lines.every((spots) => spots.every(({ x }) => Number.isFinite(x)))).toBe(true);
        return lines.length;
    };
    expect(outline([3, 2, 6])).toBe(1);
    expect(outline([0.3, 5, 0.1])).toBe(1);
});
