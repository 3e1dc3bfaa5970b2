/* SPDX-License-Identifier: MIT */
/* The graph of nodes: a second view of the one tree. It is laid out by itself, the result on the
 * right. React Flow moves the view and draws the cards that are in sight; what a hand does with
 * cards and wires is in reach.ts. */
import { Background, ReactFlow, ReactFlowProvider, useReactFlow } from "@xyflow/react";
import { Maximize, Minus, Plus, SquaresSubtract, X } from "lucide-react";
import { memo, useMemo, useRef, useState } from "react";
import { CARD, type Derived, deriveGraph, type Graph } from "../../model/graph.ts";
import { setPreferences } from "../../model/stores.ts";
import { toggleDrawer } from "../../model/view.ts";
import { NodeMenu } from "../scene/NodeMenu.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { useLeftFocus } from "../widgets/leftFocus.ts";
import { type CardNode, GraphCard } from "./Card.tsx";
import { GraphContext, useShared } from "./context.ts";
import { Reach } from "./Reach.tsx";
import { FARTHEST, glide, NEAREST, useFraming, useStop, useWayBack, useZoom } from "./sight.ts";
import { Wires } from "./Wires.tsx";
import "@xyflow/react/dist/base.css";
import "./graph.css";

const TYPES = { card: GraphCard };

/* The same one while only numbers change. */
function useGraph(): Graph | null {
    const collapsed = useView((view) => view.collapsed);
    const before = useRef<Derived | null>(null);
    return useDocument(({ schema, document }) => {
        before.current = document && deriveGraph(schema, document, collapsed, before.current);
        return before.current?.graph ?? null;
    });
}

export default function GraphPanel() {
    const graph = useGraph();
    return (
        <section
            ref={useLeftFocus()}
            className="graph-panel"
            aria-label={t("graph.label")}
            data-testid="graph"
            data-region={t("graph.label")}
            data-context="tree"
            tabIndex={-1}
        >
            {graph && (
                <ReactFlowProvider>
                    <Head graph={graph} />
                    <Flow graph={graph} />
                </ReactFlowProvider>
            )}
        </section>
    );
}

/* One press of a button. */
const STEP = 1.3;

const Head = memo(function Head({ graph }: { graph: Graph }) {
    const { stores } = useEditor();
    const count = useDocument(({ document }) => document?.nodes.size ?? 0);
    const results = useView(({ preferences }) => preferences.results);
    const flow = useReactFlow();
    const zoom = useZoom(graph);
    return (
        <header className="graph-head">
            <h2>{t("graph.title")}</h2>
            <span className="section-count">{t("graph.count", { count })}</span>
            <span className="bar-space" />
            <IconButton
                title={t("graph.results")}
                data-size="s"
                aria-pressed={results}
                onClick={() => setPreferences(stores.view, { results: !results })}
            >
                <SquaresSubtract size={15} />
            </IconButton>
            <IconButton title={t("graph.farther")} data-size="s" onClick={() => zoom(1 / STEP)}>
                <Minus size={15} />
            </IconButton>
            <IconButton title={t("graph.nearer")} data-size="s" onClick={() => zoom(STEP)}>
                <Plus size={15} />
            </IconButton>
            <IconButton
                title={t("graph.fit")}
                data-size="s"
                onClick={() => void flow.fitView({ duration: glide(), padding: 0.08, maxZoom: 1 })}
            >
                <Maximize size={15} />
            </IconButton>
            <IconButton
                title={t("close")}
                data-size="s"
                onClick={() => stores.view.setState(toggleDrawer("graph"))}
            >
                <X size={15} />
            </IconButton>
        </header>
    );
});

/* React Flow lets pointers through what it does not handle itself. */
const REACHED = { pointerEvents: "all" } as const;

/* What React Flow gets of a card: where it is and how large, so that it measures nothing. */
function useNodes({ cards, spots }: Graph): CardNode[] {
    return useMemo(
        () =>
            [...cards.values()].map((card) => {
                const { x, y } = spots.get(card.id) ?? { x: 0, y: 0 };
                const size = { width: CARD.width, height: card.height };
                return {
                    id: card.id,
                    type: "card" as const,
                    position: { x: x - CARD.width, y: y - card.height / 2 },
                    data: { card },
                    ...size,
                    measured: size,
                    handles: [],
                    style: REACHED,
                };
            }),
        [cards, spots],
    );
}

const Flow = memo(function Flow({ graph }: { graph: Graph }) {
    const { view } = useEditor().stores;
    const [menu, setMenu] = useState<{ x: number; y: number } | null>(null);
    const nodes = useNodes(graph);
    const frame = useFraming(graph);
    const trackpad = useView(({ preferences }) => preferences.pointing === "trackpad");
    const next = useRef<string | null>(null);
    const shared = useMemo(() => ({ graph, openMenu: setMenu, next }), [graph]);
    return (
        <GraphContext value={shared}>
            <p className="unseen" id="graph-help">
                {t("graph.help")}
            </p>
            <WayBack />
            <Reach>
                <ReactFlow<CardNode>
                    nodes={nodes}
                    nodeTypes={TYPES}
                    minZoom={FARTHEST}
                    maxZoom={NEAREST}
                    onlyRenderVisibleElements
                    nodesDraggable={false}
                    nodesConnectable={false}
                    nodesFocusable={false}
                    elementsSelectable={false}
                    zoomOnDoubleClick={false}
                    panOnScroll={trackpad}
                    deleteKeyCode={null}
                    selectionKeyCode={null}
                    multiSelectionKeyCode={null}
                    panActivationKeyCode={null}
                    disableKeyboardA11y
                    onInit={frame}
                    onPaneClick={() => view.setState({ selection: [] })}
                >
                    <Background gap={24} size={1.5} color="var(--line-2)" bgColor="transparent" />
                    <Wires graph={graph} />
                </ReactFlow>
            </Reach>
            <NodeMenu at={menu} onClose={() => setMenu(null)} />
        </GraphContext>
    );
});

/* Stands for the card that Tab reaches while that is out of sight. */
function WayBack() {
    const { graph, next } = useShared();
    const stop = useStop(graph);
    const bring = useWayBack(graph);
    return (
        bring && (
            <button
                type="button"
                className="unseen"
                tabIndex={0}
                onFocus={({ currentTarget }) => {
                    next.current = stop;
                    currentTarget
                        .closest<HTMLElement>(".graph-panel")
                        ?.focus({ preventScroll: true });
                    bring();
                }}
            >
                {t("graph.back")}
            </button>
        )
    );
}
