/* SPDX-License-Identifier: MIT */
/* What of the graph is in sight: at first all of it if that can be read, else its result; then
 * whatever is selected elsewhere. */
import { type Rect, useReactFlow, useStore, type Viewport } from "@xyflow/react";
import { useCallback, useEffect, useRef } from "react";
import { pathTo } from "../../model/document.ts";
import { CARD, type Graph } from "../../model/graph.ts";
import { unfoldTo } from "../../model/view.ts";
import { useEditor, useView } from "../state.ts";

/* Zooms: the least and the most. */
export const FARTHEST = 0.03;
export const NEAREST = 1.25;
/* The least at which a row of 26 px is large enough for a finger, 24 px; below it cards show their
 * picture and name alone. The least at which that can be read. */
const NEAR = 24 / 26;
const READABLE = 0.55;
const MARGIN = 24;
const GLIDE_MS = 150;

/* How far away the cards are: 0 with their values, 1, 2. */
export const useFar = (): number =>
    useStore(({ transform: [, , zoom] }) => (zoom < READABLE ? 2 : zoom < NEAR ? 1 : 0));

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
            void flow.setViewport({ x: width - 2 * MARGIN, y: height / 2, zoom: 1 });
        }
    };
}

/* How far the view has to move so that all of a card, else its start, is in sight. */
function wayTo(card: Rect, { x, y, zoom }: Viewport, room: Size): { dx: number; dy: number } {
    const by = (start: number, size: number, space: number): number => {
        const over = start + size + MARGIN - space;
        return start < MARGIN || size > space ? MARGIN - start : Math.max(0, over) * -1;
    };
    return {
        dx: by(card.x * zoom + x, card.width * zoom, room.width),
        dy: by(card.y * zoom + y, card.height * zoom, room.height),
    };
}

interface Size {
    readonly width: number;
    readonly height: number;
}

function rectOf(graph: Graph, id: string | null): Rect | null {
    const card = graph.cards.get(id ?? "");
    const spot = graph.spots.get(id ?? "");
    return card && spot
        ? {
              x: spot.x - CARD.width,
              y: spot.y - card.height / 2,
              width: CARD.width,
              height: card.height,
          }
        : null;
}

/* The card that Tab reaches: the active one, the result where none is. */
export const useStop = (graph: Graph): string =>
    useView((view) => view.selection.at(-1) ?? graph.root);

/* Brings a card in sight, by the least way. */
function useReveal(graph: Graph, width: number, height: number): (id: string) => void {
    const flow = useReactFlow();
    return useCallback(
        (id) => {
            const card = rectOf(graph, id);
            const old = flow.getViewport();
            const { dx, dy } = card ? wayTo(card, old, { width, height }) : { dx: 0, dy: 0 };
            if (dx !== 0 || dy !== 0) {
                const next = { ...old, x: old.x + dx, y: old.y + dy };
                void flow.setViewport(next, { duration: glide() });
            }
        },
        [graph, width, height, flow],
    );
}

/* What brings the card that Tab reaches in sight; null: it is there. React Flow draws no other. */
export function useWayBack(graph: Graph): (() => void) | null {
    const stop = useStop(graph);
    const width = useStore((state) => state.width);
    const height = useStore((state) => state.height);
    const reveal = useReveal(graph, width, height);
    const away = useStore(({ transform: [x, y, zoom] }) => {
        const card = rectOf(graph, stop);
        const isIn = (start: number, size: number, room: number): boolean =>
            start + size > 0 && start < room;
        return (
            card !== null &&
            !(
                isIn(card.x * zoom + x, card.width * zoom, width) &&
                isIn(card.y * zoom + y, card.height * zoom, height)
            )
        );
    });
    return away ? () => reveal(stop) : null;
}

/* Brings the card of a node that was selected elsewhere in sight. */
function useRevealed(graph: Graph, width: number, height: number): void {
    const { view, document: scene } = useEditor().stores;
    const reveal = useReveal(graph, width, height);
    const active = useView((state) => state.selection.at(-1) ?? null);
    const shown = useRef<string | null>(null);
    useEffect(() => {
        if (active === null || active === shown.current || width === 0) {
            return;
        }
        const { document } = scene.getState();
        if (document !== null && !graph.cards.has(active)) {
            const above = pathTo(document, active).map(({ id }) => id);
            view.setState((state) => unfoldTo(state, above.slice(0, -1)));
            return;
        }
        shown.current = active;
        reveal(active);
    }, [active, graph, width, reveal, view, scene]);
}

export const glide = (): number =>
    matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : GLIDE_MS;

/* Answers what enlarges the graph: around the active card, else around the middle of the view. */
export function useZoom(graph: Graph): (factor: number) => void {
    const flow = useReactFlow();
    const width = useStore((state) => state.width);
    const height = useStore((state) => state.height);
    const { view } = useEditor().stores;
    return (factor) => {
        const old = flow.getViewport();
        const card = rectOf(graph, view.getState().selection.at(-1) ?? null);
        const zoom = Math.min(NEAREST, Math.max(FARTHEST, old.zoom * factor));
        const [cx, cy] = card
            ? [card.x + card.width / 2, card.y + card.height / 2]
            : [(width / 2 - old.x) / old.zoom, (height / 2 - old.y) / old.zoom];
        const next = {
            x: old.x + cx * (old.zoom - zoom),
            y: old.y + cy * (old.zoom - zoom),
            zoom,
        };
        const { dx, dy } = card ? wayTo(card, next, { width, height }) : { dx: 0, dy: 0 };
        void flow.setViewport({ ...next, x: next.x + dx, y: next.y + dy }, { duration: glide() });
    };
}
