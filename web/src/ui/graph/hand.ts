/* SPDX-License-Identifier: MIT */
/* A hand in the graph: from a press on a card, a port or a wire until it lets go. */
import type { Point } from "../../model/layout.ts";
import { type Held, type Outcome, outcomeOf } from "../../model/wiring.ts";
import type { Editor } from "../editor.ts";
import { heldAt, letGo, overAt, say } from "./grips.ts";

/* CSS pixels that a press may move and still be a click. */
const SLOP = 4;

/* What is drawn while something is held, in CSS pixels of the panel. */
export interface Shown {
    readonly held: Held;
    readonly from: Point;
    readonly to: Point;
    /* What letting go here would do. */
    readonly words: string;
    readonly good: boolean;
    /* The words stand left of the pointer, where there is more room. */
    readonly left: boolean;
}

/* Sets an attribute of one element at a time. */
function marker(name: string): (element: Element | null, value?: string) => void {
    let marked: Element | null = null;
    return (element, value = "") => {
        marked?.removeAttribute(name);
        marked = element;
        marked?.setAttribute(name, value);
    };
}

/* Where the wire that is held begins: at the result of its card, or at the free input. */
function startOf(element: HTMLElement, held: Held, press: Point): Point {
    const id = held.kind === "free" ? null : (held.ids[0] ?? null);
    const knob =
        id === null
            ? null
            : element.querySelector(`[data-card="${CSS.escape(id)}"] [data-grab="output"]`);
    const box = knob?.getBoundingClientRect();
    return box ? { x: box.left + box.width / 2, y: box.top + box.height / 2 } : press;
}

/* The wire that is pulled off its input; it stays, faintly. */
function looseWire(element: HTMLElement, held: Held): Element | null {
    const id = held.kind === "loose" ? (held.ids[0] ?? "") : null;
    const path = id === null ? null : element.querySelector(`[data-wire="${CSS.escape(id)}"]`);
    return path?.parentElement ?? null;
}

/* What was dragged was not clicked. */
function swallowClick(element: HTMLElement): void {
    const stop = (event: Event): void => event.stopPropagation();
    element.addEventListener("click", stop, { capture: true, once: true });
    setTimeout(() => element.removeEventListener("click", stop, { capture: true }));
}

interface Press extends Point {
    readonly held: Held;
    readonly pointer: number;
}

/* What is held, and what would come of it here; null before it has moved. */
function handOf(editor: Editor, element: HTMLElement, show: (shown: Shown | null) => void) {
    const markOver = marker("data-over");
    const markLoose = marker("data-loose");
    let press: Press | null = null;
    let outcome: Outcome | null = null;
    const end = (): void => {
        press = null;
        outcome = null;
        markOver(null);
        markLoose(null);
        show(null);
    };
    const carry = (held: Held, { clientX: x, clientY: y }: PointerEvent, start: Point): void => {
        const { schema, document } = editor.stores.document.getState();
        if (document === null) {
            return;
        }
        const { over, mark } = overAt(window.document.elementFromPoint(x, y));
        outcome = outcomeOf({ schema, document }, held, over);
        const good = outcome.kind !== "not";
        markOver(mark, good ? "" : "not");
        markLoose(looseWire(element, held));
        const box = element.getBoundingClientRect();
        const local = (at: Point): Point => ({ x: at.x - box.left, y: at.y - box.top });
        const from = local(startOf(element, held, start));
        const left = x > box.left + box.width / 2;
        show({ held, from, to: local({ x, y }), words: say(outcome, over), good, left });
    };
    return {
        end,
        holds: (): boolean => press !== null,
        carries: (): boolean => outcome !== null,
        down: ({ target, button, isPrimary, pointerId, clientX: x, clientY: y }: PointerEvent) => {
            if (!isPrimary) {
                return /* a second finger: the first one goes on */;
            }
            end();
            const { document } = editor.stores.document.getState();
            const { selection } = editor.stores.view.getState();
            const able = button === 0 && target instanceof Element;
            const held = able && document ? heldAt(target, document, selection) : null;
            press = held && { held, x, y, pointer: pointerId };
        },
        move: (event: PointerEvent): void => {
            if (press === null || event.pointerId !== press.pointer) {
                return;
            }
            if (event.buttons === 0) {
                end() /* it was let go where nobody was told, outside of the panel */;
                return;
            }
            const way = Math.hypot(event.clientX - press.x, event.clientY - press.y);
            if (outcome !== null || way > SLOP) {
                event.preventDefault();
                element.setPointerCapture(event.pointerId);
                carry(press.held, event, press);
            }
        },
        up: (event: PointerEvent): void => {
            if (press !== null && event.pointerId === press.pointer) {
                if (outcome !== null) {
                    carry(press.held, event, press) /* others may have changed the scene */;
                }
                const done = outcome;
                end();
                if (done !== null) {
                    letGo(editor, done);
                    swallowClick(element);
                }
            }
        },
    };
}

/* Answers what ends it. */
export function watchHand(
    editor: Editor,
    element: HTMLElement,
    show: (shown: Shown | null) => void,
): () => void {
    const hand = handOf(editor, element, show);
    const listening = new AbortController();
    const options = { signal: listening.signal };
    const early = { ...options, capture: true };
    /* What is held does not move the view. */
    const keep = (event: Event): void => {
        if (hand.holds()) {
            event.stopPropagation();
        }
    };
    const key = (event: KeyboardEvent): void => {
        if (event.key === "Escape" && hand.carries()) {
            event.preventDefault();
            event.stopPropagation();
            hand.end();
        }
    };
    element.addEventListener("pointerdown", hand.down, early);
    element.addEventListener("mousedown", keep, early);
    element.addEventListener("touchstart", keep, early);
    element.addEventListener("pointermove", hand.move, options);
    element.addEventListener("pointerup", hand.up, options);
    element.addEventListener("pointercancel", hand.end, options);
    window.addEventListener("blur", hand.end, options);
    window.addEventListener("keydown", key, early);
    return () => {
        listening.abort();
        hand.end();
    };
}
