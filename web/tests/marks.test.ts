/* SPDX-License-Identifier: MIT */
/* What the page draws over the picture besides hands: the ends of the axes, and marks of what cannot
 * be seen. */
import { expect, test } from "vitest";
import { axisEnds } from "../src/model/axesBall.ts";
import { cameraOf, DEFAULT_CAMERA, viewFrom } from "../src/model/camera.ts";
import { marksOf } from "../src/model/marks.ts";
import { random, SCHEMA, scene } from "./fixture.ts";

test("from the front, X points right and Y up, and Z hides the back", () => {
    const ends = axisEnds(viewFrom(DEFAULT_CAMERA, "front"), 0.5);
    const end = (view: string) => ends.find((one) => one.view === view);
    expect(end("right")).toMatchObject({ positive: true, covered: false });
    expect(end("right")?.x).toBeCloseTo(1, 9);
    expect(end("top")?.y).toBeCloseTo(-1, 9);
    expect(end("front")?.near).toBeCloseTo(1, 9);
    expect(end("back")).toMatchObject({ positive: false, covered: true });
});

test("looking from an end brings that end to the middle, nearest", () => {
    for (const { view } of axisEnds(DEFAULT_CAMERA, 0)) {
        const ends = axisEnds(viewFrom(DEFAULT_CAMERA, view), 0.5);
        const nearest = [...ends].sort((a, b) => b.near - a.near)[0];
        expect(nearest?.view).toBe(view);
        expect(Math.hypot(nearest?.x ?? 1, nearest?.y ?? 1)).toBeLessThan(0.02);
    }
});

test("ends that are shown never lie over each other, and the nearest one is shown", () => {
    const next = random(5);
    for (let round = 0; round < 500; round++) {
        const position = [next() * 8 - 4, next() * 8 - 4, next() * 8 - 4];
        const ends = axisEnds(cameraOf({ position, target: [0, 0, 0] }), 0.75);
        const shown = ends.filter(({ covered }) => !covered);
        expect(shown.length).toBeGreaterThanOrEqual(3);
        for (const [i, a] of shown.entries()) {
            for (const b of shown.slice(i + 1)) {
                expect(Math.hypot(a.x - b.x, a.y - b.y)).toBeGreaterThanOrEqual(0.75);
            }
        }
        const nearest = [...ends].sort((a, b) => b.near - a.near)[0];
        expect(nearest?.covered).toBe(false);
    }
});

test("lights and volumes with a place have marks, and the camera where it is not the page's", () => {
    const document = scene();
    const keys = (at: typeof DEFAULT_CAMERA) => marksOf(SCHEMA, document, at).map(({ key }) => key);
    const own = cameraOf(document.camera);
    expect(keys(own)).toEqual(["lights/lamp"]);
    expect(keys({ ...own, position: [9, 9, 9] })).toEqual(["lights/lamp", "camera"]);
});
