// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// What the page tells the input machine: keys and what is let go out of its sight.
import { afterEach, beforeEach, expect, test } from "vitest";
import { type Camera, DEFAULT_CAMERA } from "../src/model/camera.ts";
import { attachPointer, type Gesture } from "../src/overlay/pointer.ts";

let element: HTMLElement;
let stop: () => void;
let camera: Camera;
let gestures: (Gesture | null)[];

beforeEach(() => {
    camera = DEFAULT_CAMERA;
    gestures = [];
    element = document.body.appendChild(document.createElement("div"));
    element.setPointerCapture = () => undefined;
    stop = attachPointer(element, {
        grab: () => null,
        camera: () => camera,
        moveCamera: (next) => {
            camera = next;
        },
        click: () => undefined,
        menu: () => undefined,
        frame: () => undefined,
        pointing: () => "mouse",
        seemsTrackpad: () => undefined,
        gesture: (kind) => void gestures.push(kind),
    });
});

afterEach(() => {
    stop();
    document.body.replaceChildren();
});

/* jsdom has no events of pointers. */
function point(type: string, clientX: number): void {
    const event = new MouseEvent(type, { bubbles: true, button: 0, buttons: 1, clientX });
    element.dispatchEvent(Object.assign(event, { pointerId: 1, pointerType: "mouse" }));
}

/* What dragging does now. */
function gesture(): Gesture | null | undefined {
    point("pointerdown", 10);
    point("pointermove", 60);
    const kind = gestures.at(-1);
    point("pointerup", 60);
    return kind;
}

function space(type: "keydown" | "keyup", target: EventTarget = document.body): void {
    target.dispatchEvent(new KeyboardEvent(type, { code: "Space", key: " ", bubbles: true }));
}

test("Space pans while it is down", () => {
    space("keydown");
    expect(gesture()).toBe("pan");
    space("keyup");
    expect(gesture()).toBe("orbit");
});

test("Space that is let go in another window is not down", () => {
    space("keydown");
    window.dispatchEvent(new Event("blur"));
    expect(gesture()).toBe("orbit");
});

test("Space that is let go in a field is not down, and one that is typed there is none", () => {
    const field = document.body.appendChild(document.createElement("input"));
    space("keydown");
    space("keyup", field);
    expect(gesture()).toBe("orbit");
    space("keydown", field);
    expect(gesture()).toBe("orbit");
});
