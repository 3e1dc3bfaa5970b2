/* SPDX-License-Identifier: MIT */
/* A hand in the graph: from a press on a card, a port or a wire until it lets go. The wire that it
 * draws, and the words for what would happen, are here, so that no card is drawn anew. */
import { type ReactNode, useEffect, useRef, useState } from "react";
import type { Graph } from "../../model/graph.ts";
import type { Point } from "../../model/layout.ts";
import { type Held, type Outcome, outcomeOf } from "../../model/wiring.ts";
import type { Editor } from "../editor.ts";
import { useEditor } from "../state.ts";
import { heldAt, letGo, overAt, say } from "./reach.ts";
import { useFar } from "./sight.ts";
import { wirePath } from "./Wires.tsx";

/* CSS pixels that a press may move and still be a click. */
const SLOP = 4;

/* What is drawn while something is held, in CSS pixels of the panel. */
interface Shown {
    readonly held: Held;
    readonly from: Point;
    readonly to: Point;
    readonly words: string;
    readonly good: boolean;
}

export function Reach({ graph, children }: { graph: Graph; children: ReactNode }) {
    const editor = useEditor();
    const root = useRef<HTMLDivElement>(null);
    const [shown, setShown] = useState<Shown | null>(null);
    const far = useFar();
    const latest = useRef(graph);
    latest.current = graph;
    useEffect(() => {
        const element = root.current;
        return element ? watch(editor, element, () => latest.current, setShown) : undefined;
    }, [editor]);
    return (
        <div
            className="graph-flow"
            ref={root}
            data-holding={shown?.held.kind}
            data-far={far || undefined}
        >
            {children}
            {shown && <Wire {...shown} />}
        </div>
    );
}

function Wire({ held, from, to, words, good }: Shown) {
    /* A wire from a free input runs the other way. */
    const path = held.kind === "free" ? wirePath(to, from) : wirePath(from, to);
    return (
        <>
            {held.kind !== "cards" && (
                <svg className="graph-held" aria-hidden="true">
                    <path d={path} />
                </svg>
            )}
            <div
                className="graph-say"
                role="status"
                data-bad={good ? undefined : ""}
                style={{ translate: `${to.x + 14}px ${to.y + 14}px` }}
            >
                {words}
            </div>
        </>
    );
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

function watch(
    editor: Editor,
    element: HTMLElement,
    graphNow: () => Graph,
    show: (shown: Shown | null) => void,
): () => void {
    const listening = new AbortController();
    const options = { signal: listening.signal };
    let held: Held | null = null;
    let press = { x: 0, y: 0, id: -1 };
    let moved = false;
    let outcome: Outcome | null = null;
    let mark: Element | null = null;
    const markAs = (next: Element | null): void => {
        mark?.removeAttribute("data-over");
        mark = next;
        mark?.setAttribute("data-over", outcome?.kind === "not" ? "not" : "");
    };
    const end = (): void => {
        held = null;
        outcome = null;
        markAs(null);
        show(null);
    };
    const move = (event: PointerEvent): void => {
        if (held === null || event.pointerId !== press.id) {
            return;
        }
        moved ||= Math.hypot(event.clientX - press.x, event.clientY - press.y) > SLOP;
        if (!moved) {
            return;
        }
        event.preventDefault();
        element.setPointerCapture(event.pointerId);
        const { schema, document } = graphNow();
        const { over, mark: next } = overAt(
            window.document.elementFromPoint(event.clientX, event.clientY),
        );
        outcome = outcomeOf({ schema, document }, held, over);
        markAs(next);
        const box = element.getBoundingClientRect();
        const local = ({ x, y }: Point): Point => ({ x: x - box.left, y: y - box.top });
        show({
            held,
            from: local(startOf(element, held, press)),
            to: local({ x: event.clientX, y: event.clientY }),
            words: say(outcome, over),
            good: outcome.kind !== "not",
        });
    };
    const down = (event: PointerEvent): void => {
        const { document } = graphNow();
        if (event.button !== 0 || !event.isPrimary || !(event.target instanceof Element)) {
            return;
        }
        held = heldAt(event.target, document, editor.stores.view.getState().selection);
        press = { x: event.clientX, y: event.clientY, id: event.pointerId };
        moved = false;
    };
    /* What is held does not move the view. */
    const keep = (event: Event): void => {
        if (held !== null) {
            event.stopPropagation();
        }
    };
    const up = (event: PointerEvent): void => {
        if (held === null || event.pointerId !== press.id) {
            return;
        }
        const done = outcome;
        end();
        if (done !== null) {
            letGo(editor, done);
            swallowClick(element);
        }
    };
    const key = (event: KeyboardEvent): void => {
        if (event.key === "Escape" && outcome !== null) {
            event.preventDefault();
            event.stopPropagation();
            end();
        }
    };
    element.addEventListener("pointerdown", down, { ...options, capture: true });
    element.addEventListener("mousedown", keep, { ...options, capture: true });
    element.addEventListener("touchstart", keep, { ...options, capture: true });
    element.addEventListener("pointermove", move, options);
    element.addEventListener("pointerup", up, options);
    element.addEventListener("pointercancel", end, options);
    window.addEventListener("blur", end, options);
    window.addEventListener("keydown", key, { ...options, capture: true });
    return () => {
        listening.abort();
        end();
    };
}

/* What was dragged was not clicked. */
function swallowClick(element: HTMLElement): void {
    const stop = (event: Event): void => event.stopPropagation();
    element.addEventListener("click", stop, { capture: true, once: true });
    setTimeout(() => element.removeEventListener("click", stop, { capture: true }));
}
