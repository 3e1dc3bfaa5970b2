/* SPDX-License-Identifier: MIT */
/* What of the graph is in sight: at first all of it if that can be read, else its result; then
 * whatever is selected elsewhere. */
import { type Rect, useReactFlow, useStore } from "@xyflow/react";
import { useEffect, useRef } from "react";
import { pathTo } from "../../model/document.ts";
import { CARD, type Graph } from "../../model/graph.ts";
import { unfoldTo } from "../../model/view.ts";
import { useEditor, useView } from "../state.ts";

/* Zooms: the least and the most, the least at which cards show their values, and at which they can
 * still be read. */
export const FARTHEST = 0.08;
export const NEAREST = 1.25;
export const NEAR = 0.5;
const READABLE = 0.62;
const MARGIN = 24;
const GLIDE_MS = 150;

export const useFar = (): boolean => useStore(({ transform }) => transform[2] < NEAR);

function boundsOf({ cards, spots }: Graph): Rect {
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { id, height } of cards.values()) {
        const { x, y } = spots.get(id) ?? { x: 0, y: 0 };
        left = Math.min(left, x - CARD.width);
        right = Math.max(right, x);
        top = Math.min(top, y - height / 2);
        bottom = Math.max(bottom, y + height / 2);
    }
    return { x: left, y: top, width: right - left, height: bottom - top };
}

/* Answers what frames the graph when it is first shown. */
export function useFraming(graph: Graph): () => void {
    const flow = useReactFlow();
    const width = useStore((state) => state.width);
    const height = useStore((state) => state.height);
    useRevealed(graph, width, height);
    return () => {
        const all = boundsOf(graph);
        const fit = Math.min((width - 2 * MARGIN) / all.width, (height - 2 * MARGIN) / all.height);
        if (fit >= READABLE) {
            const zoom = Math.min(fit, 1);
            const x = width / 2 - (all.x + all.width / 2) * zoom;
            void flow.setViewport({ x, y: height / 2 - (all.y + all.height / 2) * zoom, zoom });
        } else {
            /* The result stands at (0, 0). */
            void flow.setViewport({ x: width - 2 * MARGIN, y: height / 2, zoom: READABLE });
        }
    };
}

/* Brings the card of a node that was selected elsewhere in sight, by the least way. */
function useRevealed(graph: Graph, width: number, height: number): void {
    const { view } = useEditor().stores;
    const flow = useReactFlow();
    const active = useView((state) => state.selection.at(-1) ?? null);
    const shown = useRef<string | null>(null);
    useEffect(() => {
        if (active === null || active === shown.current || width === 0) {
            return;
        }
        if (!graph.cards.has(active)) {
            const above = pathTo(graph.document, active).map(({ id }) => id);
            view.setState((state) => unfoldTo(state, above.slice(0, -1)));
            return;
        }
        shown.current = active;
        const card = graph.cards.get(active);
        const spot = graph.spots.get(active);
        if (!card || !spot) {
            return;
        }
        const { x, y, zoom } = flow.getViewport();
        const by = (start: number, size: number, room: number): number => {
            const end = start + size;
            const over = end + MARGIN - room;
            return start < MARGIN || size > room ? MARGIN - start : over > 0 ? -over : 0;
        };
        const dx = by((spot.x - CARD.width) * zoom + x, CARD.width * zoom, width);
        const dy = by((spot.y - card.height / 2) * zoom + y, card.height * zoom, height);
        if (dx !== 0 || dy !== 0) {
            const duration = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : GLIDE_MS;
            void flow.setViewport({ x: x + dx, y: y + dy, zoom }, { duration });
        }
    }, [active, graph, width, height, flow, view]);
}
