/* SPDX-License-Identifier: MIT */
/* The graph: where its cards stand, what is kept while values change, and what hands make of it. */
import { expect, test } from "vitest";
import { everyNode, type SceneDocument } from "../src/model/document.ts";
import { readDocument } from "../src/model/documentJson.ts";
import {
    CARD,
    type Derived,
    deriveGraph,
    neighbour,
    resultOf,
    roomForPicture,
} from "../src/model/graph.ts";
import { layoutTree } from "../src/model/layout.ts";
import { connect, insertBetween } from "../src/model/moves.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";

import { toWorld, type Vector } from "../src/model/transform.ts";
import { type Held, type Over, outcomeOf } from "../src/model/wiring.ts";
import { choose, random, randomOperation, SCHEMA, scene } from "./fixture.ts";

/* --- layout --- */

interface Drawn {
    readonly childrenOf: (id: string) => readonly string[];
    readonly heightOf: (id: string) => number;
    readonly ids: readonly string[];
}

/* A tree of `count` nodes with random parents among those before. */
function randomTree(count: number, next: () => number): Drawn {
    const children = new Map<string, string[]>();
    const heights = new Map<string, number>();
    const ids = Array.from({ length: count }, (_, i) => `n${i}`);
    for (const [i, id] of ids.entries()) {
        heights.set(id, 40 + Math.floor(next() * 300));
        const parent = ids[Math.floor(next() * i)];
        if (i > 0 && parent !== undefined) {
            children.set(parent, [...(children.get(parent) ?? []), id]);
        }
    }
    return {
        ids,
        childrenOf: (id) => children.get(id) ?? [],
        heightOf: (id) => heights.get(id) ?? 0,
    };
}

const SPACING = { column: 300, gap: 16 };

test("cards of one column never come closer than the gap, and inputs stand in their order", () => {
    const next = random(7);
    for (let round = 0; round < 200; round++) {
        const tree = randomTree(2 + Math.floor(next() * 60), next);
        const spots = layoutTree({ root: "n0", ...tree }, SPACING);
        const columns = new Map<number, { top: number; bottom: number }[]>();
        for (const [id, { x, y }] of spots) {
            const half = tree.heightOf(id) / 2;
            columns.set(x, [...(columns.get(x) ?? []), { top: y - half, bottom: y + half }]);
        }
        for (const column of columns.values()) {
            column.sort((a, b) => a.top - b.top);
            for (const [i, { bottom }] of column.entries()) {
                const below = column[i + 1]?.top ?? Number.POSITIVE_INFINITY;
                expect(below - bottom).toBeGreaterThanOrEqual(SPACING.gap - 1e-6);
            }
        }
        for (const id of tree.ids) {
            const ys = tree.childrenOf(id).map((child) => spots.get(child)?.y ?? Number.NaN);
            expect(ys).toEqual([...ys].sort((a, b) => a - b));
            if (ys.length > 0) {
                const middle = ((ys[0] ?? 0) + (ys.at(-1) ?? 0)) / 2;
                expect(spots.get(id)?.y).toBeCloseTo(middle, 6);
            }
        }
        expect(spots.size).toBe(tree.ids.length);
        expect(spots.get("n0")).toEqual({ x: 0, y: 0 });
    }
});

test("a column stands left of the one that it leads to", () => {
    const childrenOf = (id: string): string[] =>
        id === "a" ? ["b", "c"] : id === "c" ? ["d"] : [];
    const spots = layoutTree({ root: "a", childrenOf, heightOf: () => 100 }, SPACING);
    expect([...spots].map(([id, { x }]) => [id, x])).toEqual([
        ["a", 0],
        ["b", -300],
        ["c", -300],
        ["d", -600],
    ]);
    expect((spots.get("c")?.y ?? 0) - (spots.get("b")?.y ?? 0)).toBe(116);
});

/* --- cards --- */

const NONE: ReadonlySet<string> = new Set();

function edited(document: SceneDocument, ...ops: Operation[]): SceneDocument {
    const applied = apply(document, ops, SCHEMA);
    if (!applied.ok) {
        throw new Error(applied.problem.message);
    }
    return applied.document;
}

const set = (at: string, value: unknown): Operation => ({ op: "set", at, value }) as Operation;

test("the graph is the same object while only numbers change", () => {
    const before = deriveGraph(SCHEMA, scene(), NONE);
    const moved = edited(before.document, set("/nodes/head/params/radius", 0.7));
    const after = deriveGraph(SCHEMA, moved, NONE, before);
    expect(after.graph).toBe(before.graph);
    expect(after.document).toBe(moved);
});

test("what changes a card changes that one alone", () => {
    const before = deriveGraph(SCHEMA, scene(), NONE);
    const typed = edited(before.document, set("/nodes/head/type", "torus"));
    const after = deriveGraph(SCHEMA, typed, NONE, before);
    const old = before.graph.cards;
    const other = [...after.graph.cards].filter(([id, card]) => old.get(id) !== card);
    expect(other.map(([id]) => id)).toEqual(["head"]);
    expect(after.graph.cards.get("head")?.beside.map(({ name }) => name)).toEqual([
        "radius",
        "tube",
    ]);
});

test("a graph that was derived step by step is the one that is derived at once", () => {
    const next = random(23);
    let made = 0;
    let document = scene();
    let derived: Derived | null = null;
    for (let step = 0; step < 3000; step++) {
        if (step % 25 === 0) {
            document = scene();
            derived = null;
        }
        const operation = randomOperation(document, next, () => `new-${made++}`);
        const applied = apply(document, [operation], SCHEMA);
        document = applied.ok ? applied.document : document;
        const collapsed = new Set(next() < 0.2 ? [choose([...everyNode(document)], next)] : []);
        derived = deriveGraph(SCHEMA, document, collapsed, derived);
        expect(derived.graph).toEqual(deriveGraph(SCHEMA, document, collapsed).graph);
    }
});

test("a card with many inputs and no parameters has room for a large picture", () => {
    const { graph } = deriveGraph(SCHEMA, scene(), NONE);
    const card = graph.cards.get("root");
    const high = (height: number) => card && roomForPicture({ ...card, height });
    expect(high(CARD.head + 2 * CARD.pad + 2 * CARD.picture)).toBe(192);
    expect(high(1000)).toBe(252);
    expect(high(CARD.head + 2 * CARD.pad + CARD.picture)).toBeNull();
    const head = graph.cards.get("head");
    expect(head && roomForPicture({ ...head, height: 1000 })).toBeNull();
});

test("a folded card hides what is below it, and says how much", () => {
    const { graph } = deriveGraph(SCHEMA, scene(), new Set(["neck"]));
    expect(graph.cards.has("head")).toBe(false);
    expect(graph.cards.get("neck")).toMatchObject({ hidden: 2, inputs: [], open: false });
    expect(graph.wires.some(({ from }) => from === "body")).toBe(false);
});

test("trees of models stand apart, and an instance is wired to its model", () => {
    const { graph } = deriveGraph(SCHEMA, scene(), NONE);
    expect(graph.wires.filter(({ dashed }) => dashed)).toEqual([
        { from: "pawn-root", to: "rook-pawn", input: 0, dashed: true },
    ]);
    const lefts = ["neck", "body", "head", "hat", "stick"].map((id) => graph.spots.get(id)?.x ?? 0);
    const right = Math.max(...["pawn-root", "rook-root"].map((id) => graph.spots.get(id)?.x ?? 0));
    expect(right).toBeLessThan(Math.min(...lefts) - CARD.width);
});

test("arrows go to inputs, siblings and the result", () => {
    const { graph } = deriveGraph(SCHEMA, scene(), NONE);
    expect(neighbour(graph, "root", "ArrowLeft")).toBe("hat");
    expect(neighbour(graph, "neck", "ArrowDown")).toBe("hat");
    expect(neighbour(graph, "hat", "ArrowUp")).toBe("neck");
    expect(neighbour(graph, "head", "ArrowRight")).toBe("neck");
    expect(neighbour(graph, "root", "ArrowRight")).toBe(null);
    expect(neighbour(graph, "neck", "ArrowUp")).toBe(null);
});

/* --- hands --- */

const input = (into: string, index: number): Over => ({ kind: "input", into, index });
const children = (document: SceneDocument, id: string): readonly string[] =>
    document.nodes.get(id)?.children ?? [];

/* What a document is after something was let go; the kind of it where that is no edit. */
function dropped(document: SceneDocument, held: Held, over: Over): SceneDocument | string {
    const outcome = outcomeOf({ schema: SCHEMA, document }, held, over);
    return "edit" in outcome ? edited(document, ...outcome.edit.ops) : outcome.kind;
}

const loose = (...ids: string[]): Held => ({ kind: "loose", ids });
const cards = (...ids: string[]): Held => ({ kind: "cards", ids });
const NOTHING: Over = { kind: "nothing" };

function after(held: Held, over: Over, of: string): readonly string[] | string {
    const result = dropped(scene(), held, over);
    return typeof result === "string" ? result : children(result, of);
}

test("a wire goes to the input that it is dropped on; others make room", () => {
    expect(after(loose("stick"), input("root", 0), "root")).toEqual(["stick", "neck", "hat"]);
    expect(after(loose("neck"), input("root", 2), "root")).toEqual(["hat", "stick", "neck"]);
    expect(after(loose("hat"), input("neck", 1), "neck")).toEqual(["body", "hat", "head"]);
    expect(after(loose("hat"), input("neck", 2), "neck")).toEqual(["body", "head", "hat"]);
    expect(after(loose("neck"), input("root", 0), "root")).toBe("back");
});

test("a card takes what is dropped on it as its last input, if it holds others", () => {
    expect(after(cards("hat"), { kind: "card", id: "neck" }, "neck")).toEqual([
        "body",
        "head",
        "hat",
    ]);
    expect(after(cards("hat"), { kind: "card", id: "stick" }, "root")).toBe("not");
    expect(after(cards("neck"), { kind: "card", id: "head" }, "root")).toBe("not");
    expect(after(cards("hat"), { kind: "card", id: "hat" }, "root")).toBe("back");
    expect(after(cards("hat", "stick"), input("neck", 0), "neck")).toEqual([
        "hat",
        "stick",
        "body",
        "head",
    ]);
});

test("a card that holds others comes between the ends of a wire", () => {
    const wire = (child: string): Over => ({ kind: "wire", child });
    expect(after(cards("neck"), wire("hat"), "neck")).toEqual(["body", "head", "hat"]);
    expect(after(cards("neck"), wire("hat"), "root")).toEqual(["neck", "stick"]);
    expect(after(cards("neck"), wire("head"), "root")).toBe("not");
    expect(after(cards("stick"), wire("head"), "root")).toBe("not");
    expect(after(cards("neck", "stick"), wire("hat"), "root")).toBe("not");
    /* A model would come to hold itself. */
    const piece = { id: "piece", type: "model", params: { model: "pawn" } };
    const value = { id: "set", type: "group", children: [piece] };
    const held = edited(scene(), { op: "insert", into: "/nodes/root", before: null, value });
    expect(dropped(held, cards("set"), wire("foot"))).toBe("not");
    expect(dropped(held, cards("set"), wire("hat"))).not.toBe("not");
});

test("what is dropped on nothing: a wire off its input is parked, others ask or go back", () => {
    const parked = dropped(scene(), loose("head"), NOTHING) as SceneDocument;
    expect(children(parked, "neck")).toEqual(["body"]);
    expect(parked.nodes.get("head")?.parent).toBe("shelf-1");
    expect(dropped(parked, loose("head"), NOTHING)).toBe("back");
    expect(dropped(scene(), cards("head"), NOTHING)).toBe("back");
    const scenery = { schema: SCHEMA, document: scene() };
    expect(outcomeOf(scenery, { kind: "output", ids: ["body", "head"] }, NOTHING)).toMatchObject({
        kind: "wrap",
        ids: ["body", "head"],
    });
    expect(outcomeOf(scenery, { kind: "free", into: "neck" }, NOTHING)).toMatchObject({
        kind: "add",
        into: "neck",
    });
});

test("a free input takes the card, or the source of the wire, that its wire is dropped on", () => {
    const free: Held = { kind: "free", into: "neck" };
    const all = ["body", "head", "hat"];
    expect(after(free, { kind: "card", id: "hat" }, "neck")).toEqual(all);
    expect(after(free, { kind: "wire", child: "hat" }, "neck")).toEqual(all);
    expect(after(free, { kind: "card", id: "root" }, "neck")).toBe("not");
});

test("no drop moves anything in the world, or loses a node", () => {
    const next = random(91);
    const origin = (document: SceneDocument, id: string): Vector =>
        toWorld(document, id, [0, 0, 0]);
    for (let round = 0; round < 400; round++) {
        const turned = ["neck", "head", "hat", "stick"].flatMap((id) => [
            set(`/nodes/${id}/transform/translation`, [next(), next(), next()]),
            set(`/nodes/${id}/transform/rotation`, [next(), next(), next()]),
        ]);
        const before = edited(scene(), ...turned);
        const ids = [...everyNode(before)];
        const held = choose<Held>(
            [loose(choose(ids, next)), cards(choose(ids, next)), cards("hat", "head")],
            next,
        );
        const over = choose<Over>(
            [
                input(choose(["root", "neck"], next), Math.floor(next() * 4)),
                { kind: "card", id: choose(ids, next) },
                { kind: "wire", child: choose(ids, next) },
                NOTHING,
            ],
            next,
        );
        const now = dropped(before, held, over);
        if (typeof now !== "string") {
            expect([...everyNode(now)].filter((id) => !id.startsWith("shelf")).sort()).toEqual(
                [...ids].sort(),
            );
            for (const id of ids) {
                const [a, b] = [origin(before, id), origin(now, id)];
                expect(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])).toBeLessThan(1e-4);
            }
        }
    }
});

test("the edits of drops are one move each, and say so", () => {
    const document = scene();
    expect(connect(document, ["stick"], "root", 0)).toEqual({
        ops: [{ op: "move", at: "/nodes/stick", into: "/nodes/root", before: "neck" }],
        label: "move stick",
        select: ["stick"],
    });
    expect(connect(document, ["stick"], "root", 2)).toBe(null);
    expect(insertBetween(SCHEMA, document, "neck", "hat")?.label).toBe("insert neck");
});

/* --- pictures --- */

test("cutters and modifiers are shown by what they are a part of", () => {
    const document = readDocument({
        format: "fieldcast/1",
        root: {
            id: "root",
            type: "union",
            children: [
                {
                    id: "bowl",
                    type: "difference",
                    children: [
                        { id: "body", type: "sphere" },
                        {
                            id: "slot",
                            type: "extrude",
                            children: [{ id: "disc", type: "circle" }],
                        },
                        { id: "tool", type: "union", children: [{ id: "peg", type: "box" }] },
                    ],
                },
                { id: "tower", type: "extrude", children: [{ id: "base", type: "circle" }] },
            ],
        },
    });
    const shown = (id: string) => resultOf(document, SCHEMA, id);
    expect(["slot", "tool"].map(shown)).toEqual(["bowl", "bowl"]);
    expect(shown("tower")).toBe("root");
    expect(["root", "bowl", "body", "disc", "peg", "base"].map(shown)).toEqual([
        "root",
        "bowl",
        "body",
        "disc",
        "peg",
        "base",
    ]);
});
