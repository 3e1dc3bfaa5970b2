/* SPDX-License-Identifier: MIT */
/* A rectangle drawn by a hand: the nodes that are seen in it. */
import { nodesIn } from "../model/guide.ts";
import type { Spot } from "../model/projection.ts";
import type { Stores } from "../model/stores.ts";
import type { Holding, Press } from "./pointer.ts";
import { whenGuide } from "./shown.ts";

interface Rectangle {
    readonly left: number;
    readonly top: number;
    readonly width: number;
    readonly height: number;
}

function rectangleOf(a: Spot, b: Spot): Rectangle {
    return {
        left: Math.min(a.x, b.x),
        top: Math.min(a.y, b.y),
        width: Math.abs(a.x - b.x),
        height: Math.abs(a.y - b.y),
    };
}

function place(frame: HTMLElement, rectangle: Rectangle): void {
    for (const [name, value] of Object.entries(rectangle)) {
        frame.style.setProperty(name, `${value}px`);
    }
}

/* Shift with the left button; null: it is for something else. `take` gets the ids once the guide of
 * the picture is there, unless the camera moves first. */
export function holdBox(
    stores: Stores,
    element: HTMLElement,
    press: Press,
    take: (ids: readonly string[]) => void,
): Holding | null {
    if (press.button !== 0 || !press.shift) {
        return null;
    }
    const frame = document.createElement("div");
    frame.className = "view-box";
    let rectangle = rectangleOf(press, press);
    return {
        start: () => {
            stores.view.setState({ hovered: null });
            element.append(frame);
        },
        move: (to) => {
            rectangle = rectangleOf(press, to);
            place(frame, rectangle);
        },
        end: () => {
            frame.remove();
            const [width, height] = [element.clientWidth, element.clientHeight];
            const { left, top } = rectangle;
            const [right, bottom] = [left + rectangle.width, top + rectangle.height];
            whenGuide(stores, (guide) =>
                take(nodesIn(guide, left / width, top / height, right / width, bottom / height)),
            );
        },
        cancel: () => frame.remove(),
    };
}
