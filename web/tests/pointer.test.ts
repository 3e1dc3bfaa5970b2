/* SPDX-License-Identifier: MIT */
/* The input machine, without a browser. */
import { beforeEach, expect, test } from "vitest";
import { type Camera, DEFAULT_CAMERA, distance } from "../src/model/camera.ts";
import type { Pointing } from "../src/model/view.ts";
import {
    type Holding,
    type PointerActions,
    PointerMachine,
    type Press,
} from "../src/overlay/pointer.ts";

let camera: Camera;
let log: string[];
let pointing: Pointing;
let machine: PointerMachine;
let clock: number;
/* What is under the pointer. */
let held: Holding | "taken" | null;

beforeEach(() => {
    camera = DEFAULT_CAMERA;
    log = [];
    pointing = "mouse";
    clock = 0;
    held = null;
    const actions: PointerActions = {
        grab: () => held,
        camera: () => camera,
        moveCamera: (next) => {
            camera = next;
        },
        click: (x, y, mode, list) => void log.push(`click ${x} ${y} ${mode}${list ? " list" : ""}`),
        menu: (x, y) => void log.push(`menu ${x} ${y}`),
        frame: (x, y) => void log.push(`frame ${x} ${y}`),
        pointing: () => pointing,
        seemsTrackpad: () => void log.push("trackpad"),
        gesture: (kind) => void log.push(`${kind}`),
    };
    machine = new PointerMachine(actions);
    machine.resize(640, 360);
});

function at(x: number, y: number, part: Partial<Press> = {}): Press {
    clock += 1000;
    const rest = { shift: false, ctrl: false, alt: false, at: clock };
    return { id: 1, type: "mouse", button: 0, buttons: 1, x, y, ...rest, ...part };
}

const turned = () => camera.position.some((x, i) => x !== DEFAULT_CAMERA.position[i]);
const shifted = () => camera.target.some((x, i) => x !== DEFAULT_CAMERA.target[i]);

test("a press that stays selects, with its modifiers", () => {
    machine.down(at(10, 10));
    machine.move(at(12, 12));
    machine.up(at(12, 12));
    machine.down(at(100, 10, { shift: true }));
    machine.up(at(100, 10));
    machine.down(at(200, 10, { ctrl: true, alt: true }));
    machine.up(at(200, 10));
    expect(log).toEqual(["click 10 10 replace", "click 100 10 add", "click 200 10 toggle list"]);
    expect(turned()).toBe(false);
});

test("a picture that gets another size does not turn the camera; the drag goes on", () => {
    machine.down(at(100, 10));
    machine.move(at(200, 10));
    const before = camera;
    machine.resize(640, 180);
    machine.move(at(200, 10));
    expect(camera).toEqual(before);
    machine.move(at(201, 10));
    expect(camera).not.toEqual(before);
    machine.cancel();
    expect(camera).toBe(DEFAULT_CAMERA);
});

test("left drags orbit, right drags pan, a right click is the menu", () => {
    machine.down(at(10, 10));
    machine.move(at(60, 10));
    expect(turned()).toBe(true);
    expect(shifted()).toBe(false);
    machine.up(at(60, 10));
    machine.down(at(10, 10, { button: 2, buttons: 2 }));
    machine.move(at(60, 10, { buttons: 2 }));
    machine.up(at(60, 10, { buttons: 0 }));
    expect(shifted()).toBe(true);
    machine.down(at(30, 40, { button: 2, buttons: 2 }));
    machine.up(at(30, 40, { buttons: 0 }));
    expect(log).toEqual(["orbit", "null", "pan", "null", "menu 30 40"]);
});

test("Space and the middle button pan as in Blender", () => {
    machine.setSpace(true);
    machine.down(at(10, 10));
    machine.move(at(60, 10));
    machine.up(at(60, 10));
    machine.setSpace(false);
    for (const part of [{ shift: true }, { ctrl: true }, {}]) {
        machine.down(at(10, 10, { button: 1, buttons: 4, ...part }));
        machine.move(at(60, 50, { buttons: 4 }));
        machine.up(at(60, 50));
    }
    expect(log.filter((line) => line !== "null")).toEqual(["pan", "pan", "dolly", "orbit"]);
});

test("a drag depends on where it is, not on how it came there", () => {
    machine.down(at(10, 10));
    machine.move(at(60, 40));
    const direct = camera;
    machine.cancel();
    machine.down(at(10, 10));
    for (const [x, y] of [
        [300, 5],
        [0, 300],
        [60, 40],
    ] as const) {
        machine.move(at(x, y));
    }
    expect(camera).toEqual(direct);
});

test("Escape and a right click go back, blur stays", () => {
    machine.down(at(10, 10));
    machine.move(at(60, 10));
    expect(machine.cancel()).toBe(true);
    expect(camera).toBe(DEFAULT_CAMERA);
    expect(machine.cancel()).toBe(false);
    machine.down(at(10, 10));
    machine.move(at(60, 10));
    machine.move(at(60, 10, { buttons: 3 }));
    expect(camera).toBe(DEFAULT_CAMERA);
    machine.down(at(10, 10));
    machine.move(at(60, 10));
    machine.end();
    expect(turned()).toBe(true);
    machine.move(at(90, 10));
    expect(machine.dragging).toBe(false);
    expect(log.filter((line) => line.startsWith("click"))).toEqual([]);
});

test("the wheel goes to the pointer, on a trackpad it orbits, pans and pinches", () => {
    const wheel = { x: 100, y: 50, dx: 0, dy: 100, shift: false, ctrl: false };
    machine.wheel(wheel);
    expect(distance(camera)).toBeGreaterThan(distance(DEFAULT_CAMERA));
    expect(shifted()).toBe(true);
    machine.wheel({ ...wheel, dx: 100, dy: 0, shift: true });
    machine.wheel({ ...wheel, dx: 3, dy: 4, ctrl: true });
    expect(log).toEqual([]);
    machine.wheel({ ...wheel, dx: 3, dy: 4 });
    expect(log).toEqual(["trackpad"]);
    camera = DEFAULT_CAMERA;
    pointing = "trackpad";
    machine.wheel({ ...wheel, dx: 3, dy: 4 });
    expect(log).toEqual(["trackpad"]);
    camera = DEFAULT_CAMERA;
    machine.wheel({ ...wheel, dx: 20, dy: 0 });
    expect(shifted()).toBe(false);
    expect(distance(camera)).toBeCloseTo(distance(DEFAULT_CAMERA), 9);
    expect(turned()).toBe(true);
    machine.wheel({ ...wheel, dx: 20, dy: 0, shift: true });
    expect(shifted()).toBe(true);
    camera = DEFAULT_CAMERA;
    machine.wheel({ ...wheel, dy: -10, ctrl: true });
    expect(distance(camera)).toBeLessThan(distance(DEFAULT_CAMERA));
});

test("a wheel that turns in a drag zooms, and the drag goes on from there", () => {
    const near = { x: 320, y: 180, dx: 0, dy: -200, shift: false, ctrl: false };
    for (const button of [0, 1, 2]) {
        camera = DEFAULT_CAMERA;
        machine.down(at(100, 100, { button }));
        machine.move(at(160, 100));
        machine.wheel(near);
        const zoomed = camera;
        expect(distance(zoomed)).toBeLessThan(0.8 * distance(DEFAULT_CAMERA));
        machine.move(at(160, 100));
        expect(camera).toEqual(zoomed);
        machine.move(at(190, 100));
        expect(distance(camera)).toBeCloseTo(distance(zoomed), 9);
        expect(camera).not.toEqual(zoomed);
        machine.cancel();
        expect(camera).toBe(DEFAULT_CAMERA);
    }
});

const touch = (id: number, x: number, y: number, part: Partial<Press> = {}): Press =>
    at(x, y, { id, type: "touch", ...part });

test("one finger orbits, two pan and pinch, the one that stays goes on", () => {
    machine.down(touch(1, 100, 100));
    machine.move(touch(1, 140, 100));
    expect(turned()).toBe(true);
    expect(shifted()).toBe(false);
    machine.down(touch(2, 240, 100));
    const before = distance(camera);
    machine.move(touch(2, 340, 100));
    expect(distance(camera)).toBeCloseTo(before / 2, 6);
    machine.up(touch(2, 340, 100));
    const kept = camera.position;
    machine.move(touch(1, 140, 100));
    camera.position.forEach((x, i) => {
        expect(x).toBeCloseTo(kept[i] ?? Number.NaN, 9);
    });
    machine.up(touch(1, 140, 100));
    expect(log).toEqual(["orbit", "pan", "orbit", "null"]);
});

test("tap selects, double tap frames, a long press is the menu", () => {
    machine.down(touch(1, 50, 50));
    machine.up(touch(1, 50, 50));
    machine.down(touch(1, 50, 50, { at: 5000 }));
    machine.up(touch(1, 50, 50, { at: 5010 }));
    machine.down(touch(1, 52, 50, { at: 5100 }));
    machine.up(touch(1, 52, 50, { at: 5110 }));
    machine.down(touch(1, 70, 70));
    machine.held();
    machine.up(touch(1, 70, 70));
    expect(log).toEqual([
        "click 50 50 replace",
        "click 50 50 replace",
        "frame 52 50",
        "menu 70 70",
    ]);
});

test("the palm beside a pen does nothing", () => {
    machine.down(at(10, 10, { type: "pen", id: 9, at: 100 }));
    expect(machine.down(touch(2, 300, 300, { at: 150 }))).toBe(false);
    machine.move(at(80, 10, { type: "pen", id: 9, at: 160 }));
    machine.up(at(80, 10, { type: "pen", id: 9, at: 170 }));
    expect(log).toEqual(["orbit", "null"]);
    expect(machine.down(touch(2, 300, 300, { at: 2000 }))).toBe(true);
});

test("a finger that rests on what it can hold gets no menu, and holds it", () => {
    held = holding();
    machine.down(touch(1, 70, 70));
    machine.held();
    machine.up(touch(1, 70, 70));
    expect(log).toEqual([]);
    machine.down(touch(1, 70, 70));
    machine.held();
    machine.move(touch(1, 70, 100));
    machine.up(touch(1, 70, 100));
    expect(log).toEqual(["start", "hold 70 100", "end"]);
});

function holding(): Holding {
    return {
        start: () => void log.push("start"),
        move: ({ x, y }) => void log.push(`hold ${x} ${y}`),
        end: () => void log.push("end"),
        cancel: () => void log.push("cancel"),
    };
}

test("what a hand holds follows the drag, and the camera stays", () => {
    held = holding();
    machine.down(at(10, 10));
    machine.move(at(12, 10));
    machine.move(at(30, 40));
    machine.move(at(31, 41));
    machine.up(at(31, 41));
    expect(log).toEqual(["start", "hold 30 40", "hold 31 41", "end"]);
    expect(turned()).toBe(false);
});

test("a click on what can be held is a click", () => {
    held = holding();
    machine.down(at(10, 10));
    machine.up(at(11, 10));
    expect(log).toEqual(["click 10 10 replace"]);
});

test("Esc, and a right click, cancel what is held; a second finger changes nothing", () => {
    held = holding();
    machine.down(at(10, 10));
    machine.move(at(30, 10));
    expect(machine.cancel()).toBe(true);
    machine.down(at(10, 10));
    machine.move(at(30, 10));
    machine.move(at(31, 10, { buttons: 3 }));
    machine.down(at(10, 10, { type: "touch" }));
    machine.move(at(40, 10, { type: "touch" }));
    machine.down(at(90, 90, { type: "touch", id: 2 }));
    machine.move(at(95, 95, { type: "touch", id: 2 }));
    machine.up(at(40, 10, { type: "touch" }));
    machine.up(at(95, 95, { type: "touch", id: 2 }));
    expect(log).toEqual([
        "start",
        "hold 30 10",
        "cancel",
        "start",
        "hold 30 10",
        "cancel",
        "start",
        "hold 40 10",
        "end",
    ]);
    expect(turned()).toBe(false);
});

test("a press that was taken starts nothing", () => {
    held = "taken";
    expect(machine.down(at(10, 10))).toBe(false);
    machine.move(at(60, 10));
    machine.up(at(60, 10));
    expect(log).toEqual([]);
    expect(turned()).toBe(false);
});
