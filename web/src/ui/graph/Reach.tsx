/* SPDX-License-Identifier: MIT */
/* What a hand holds in the graph: the wire that it draws, and the words for what would happen. They
 * are here, so that no card is drawn anew. */
import { type ReactNode, useEffect, useRef, useState } from "react";
import { useEditor } from "../state.ts";
import { type Shown, watchHand } from "./hand.ts";
import { useFar } from "./sight.ts";
import { wirePath } from "./Wires.tsx";

export function Reach({ children }: { children: ReactNode }) {
    const editor = useEditor();
    const root = useRef<HTMLDivElement>(null);
    const [shown, setShown] = useState<Shown | null>(null);
    const far = useFar();
    useEffect(
        () => (root.current ? watchHand(editor, root.current, setShown) : undefined),
        [editor],
    );
    return (
        <div
            className="graph-flow"
            ref={root}
            data-holding={shown?.held.kind}
            data-far={far || undefined}
        >
            {children}
            {shown && <HeldWire {...shown} />}
        </div>
    );
}

function HeldWire({ held, from, to, words, good, left }: Shown) {
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
                data-left={left || undefined}
                style={{ insetInlineStart: to.x, insetBlockStart: to.y }}
            >
                {words}
            </div>
        </>
    );
}
