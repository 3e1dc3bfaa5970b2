/* SPDX-License-Identifier: MIT */
/* The drag that changes a number: begins after three pixels, is endless where the browser lends
 * its pointer (pointer lock), ends with a value or with Escape. Knows pixels, not numbers. */
import { useCallback, useEffect, useRef } from "react";

const SLOP = 3;

export interface ScrubKeys {
    fine: boolean;
    snap: boolean;
}

interface Handlers {
    onStart: () => void;
    onMove: (pixels: number, keys: ScrubKeys) => void;
    onEnd: () => void;
    onCancel: () => void;
    onClick: () => void;
}

interface Drag {
    id: number;
    element: HTMLElement;
    travelled: number;
    scrubbing: boolean;
    locked: boolean;
    done: boolean;
    lastX: number;
    frame: number;
    keys: ScrubKeys;
}

/* Returns the onPointerDown of the element that is dragged. */
export function useScrub(handlers: Handlers): (event: React.PointerEvent<HTMLElement>) => void {
    const latest = useRef(handlers);
    latest.current = handlers;
    const stop = useRef<((how: "end" | "cancel") => void) | null>(null);
    useEffect(() => () => stop.current?.("end"), []);

    return useCallback((event: React.PointerEvent<HTMLElement>) => {
        const element = event.currentTarget;
        if (event.button !== 0 || stop.current || document.activeElement === element) {
            return;
        }
        event.preventDefault();
        const drag: Drag = {
            id: event.pointerId,
            element,
            travelled: 0,
            scrubbing: false,
            locked: false,
            done: false,
            lastX: event.clientX,
            frame: 0,
            keys: { fine: event.shiftKey, snap: event.ctrlKey || event.metaKey },
        };
        stop.current = follow(drag, event.pointerType === "mouse", latest, () => {
            stop.current = null;
        });
    }, []);
}

function follow(
    drag: Drag,
    mayLock: boolean,
    handlers: { current: Handlers },
    onGone: () => void,
): (how: "end" | "cancel") => void {
    const listening = new AbortController();
    const report = (): void => {
        drag.frame = 0;
        handlers.current.onMove(drag.travelled, drag.keys);
    };
    const finish = (how: "end" | "cancel"): void => {
        listening.abort();
        drag.done = true;
        if (drag.frame !== 0) {
            cancelAnimationFrame(drag.frame);
            if (how === "end") {
                report();
            }
        }
        if (document.pointerLockElement === drag.element) {
            document.exitPointerLock();
        }
        document.documentElement.removeAttribute("data-scrubbing");
        onGone();
        if (!drag.scrubbing) {
            if (how === "end") {
                handlers.current.onClick();
            }
        } else if (how === "end") {
            handlers.current.onEnd();
        } else {
            handlers.current.onCancel();
        }
    };
    const start = (): void => {
        drag.scrubbing = true;
        document.documentElement.setAttribute("data-scrubbing", "");
        handlers.current.onStart();
        if (mayLock) {
            lock(drag);
        } else {
            drag.element.setPointerCapture(drag.id);
        }
    };
    const move = (event: PointerEvent): void => {
        if (event.pointerId !== drag.id) {
            return;
        }
        drag.travelled += drag.locked ? event.movementX : event.clientX - drag.lastX;
        drag.lastX = event.clientX;
        drag.keys = { fine: event.shiftKey, snap: event.ctrlKey || event.metaKey };
        if (!drag.scrubbing && Math.abs(drag.travelled) >= SLOP) {
            drag.travelled = 0;
            start();
        }
        if (drag.scrubbing && drag.frame === 0) {
            drag.frame = requestAnimationFrame(report);
        }
    };
    const options = { signal: listening.signal, capture: true };
    window.addEventListener("pointermove", move, options);
    window.addEventListener("pointerup", () => finish("end"), options);
    window.addEventListener("pointercancel", () => finish("end"), options);
    window.addEventListener("blur", () => finish("end"), options);
    window.addEventListener(
        "keydown",
        (event) => {
            if (event.key === "Escape") {
                event.preventDefault();
                event.stopPropagation();
                finish("cancel");
            }
        },
        options,
    );
    window.addEventListener(
        "contextmenu",
        (event) => {
            event.preventDefault();
            finish("cancel");
        },
        options,
    );
    document.addEventListener(
        "pointerlockchange",
        () => {
            const locked = document.pointerLockElement === drag.element;
            if (drag.locked && !locked) {
                finish("cancel");
            }
            drag.locked = locked;
        },
        options,
    );
    return finish;
}

/* Refused by some browsers and for some inputs; the drag then ends at the edge of the screen. */
function lock(drag: Drag): void {
    const asked: unknown = drag.element.requestPointerLock?.();
    if (asked instanceof Promise) {
        asked.then(
            () => drag.done && document.exitPointerLock(),
            () => undefined,
        );
    }
}
