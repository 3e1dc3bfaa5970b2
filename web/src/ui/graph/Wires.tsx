/* SPDX-License-Identifier: MIT */
/* The wires of the graph, below the cards: from the right side of a card to an input of another. */
import { ViewportPortal } from "@xyflow/react";
import { memo } from "react";
import { isShown } from "../../model/document.ts";
import { CARD, type Graph, inputY, type Wire } from "../../model/graph.ts";
import type { Point } from "../../model/layout.ts";
import { useDocument, useView } from "../state.ts";

/* How far the knob of an output stands out. */
const KNOB = 6;

export function wirePath(from: Point, to: Point): string {
    const bend = Math.max(28, Math.abs(to.x - from.x) * 0.45);
    return `M${from.x} ${from.y}C${from.x + bend} ${from.y} ${to.x - bend} ${to.y} ${to.x} ${to.y}`;
}

export const Wires = memo(function Wires({ graph }: { graph: Graph }) {
    return (
        <ViewportPortal>
            <svg className="graph-wires" aria-hidden="true">
                {graph.wires.map((wire) => (
                    <OneWire
                        key={`${wire.from} ${wire.to}`}
                        wire={wire}
                        path={pathOf(graph, wire)}
                    />
                ))}
            </svg>
        </ViewportPortal>
    );
});

function pathOf({ cards, spots }: Graph, { from, to, input }: Wire): string {
    const start = spots.get(from) ?? { x: 0, y: 0 };
    const end = spots.get(to) ?? { x: 0, y: 0 };
    const top = end.y - (cards.get(to)?.height ?? 0) / 2;
    return wirePath(
        { x: start.x + KNOB, y: start.y },
        { x: end.x - CARD.width - KNOB, y: top + inputY(input) },
    );
}

/* The wide one is what a pointer meets; a wire from a model is no input and cannot be moved. */
const OneWire = memo(function OneWire({ wire, path }: { wire: Wire; path: string }) {
    const selected = useView((view) => view.selection.includes(wire.from));
    const hovered = useView((view) => view.hovered === wire.from);
    const shown = useDocument(({ document }) => document === null || isShown(document, wire.from));
    return (
        <g
            className="graph-wire"
            data-selected={selected || undefined}
            data-hovered={hovered || undefined}
            data-hidden={shown ? undefined : ""}
            data-dashed={wire.dashed || undefined}
        >
            <path d={path} />
            {!wire.dashed && <path className="graph-wire-reach" d={path} data-wire={wire.from} />}
        </g>
    );
});
