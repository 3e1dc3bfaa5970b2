/* SPDX-License-Identifier: MIT */
/* The tree of nodes as the graph draws it: a card for each node that no folded one hides, a wire
 * from each card to its parent, and where they stand. Derived from the document, never stored. */
import {
    modelNamed,
    parentOf,
    preorder,
    type SceneDocument,
    type SceneNode,
    shownParams,
} from "./document.ts";
import { layoutTree, type Point } from "./layout.ts";
import { isContainer, takesAway } from "./placing.ts";
import { nodeType, type Param, type ParamType, type Schema } from "./schema.ts";

/* CSS pixels at zoom 1; graph.css takes them from here. */
export const CARD = {
    width: 272,
    head: 30,
    pad: 8,
    picture: 64,
    row: 30,
    /* From one input to the next. */
    input: 24,
};
const SPACING = { column: CARD.width + 72, gap: 16 };
/* Between the trees of models, and from them to the scene's. */
const APART = 48;

/* Parameters on a card, at most. */
const MOST = 2;
/* Types whose field is small enough to stand beside the picture, and those that go below it. */
const BESIDE: readonly ParamType[] = ["float", "int", "bool"];
const BELOW: readonly ParamType[] = ["vec2", "vec3", "color", "enum", "model", "function"];

export interface Card {
    readonly id: string;
    readonly parent: string | null;
    /* The root of the model that it is an instance of; null: of none. */
    readonly model: string | null;
    readonly beside: readonly Param[];
    readonly below: readonly Param[];
    /* The nodes that are wired to it, in their order; none where it is folded. */
    readonly inputs: readonly string[];
    /* It may take one more. */
    readonly open: boolean;
    /* How many nodes are behind a folded card. */
    readonly hidden: number;
    readonly height: number;
}

/* `dashed`: from a model to one of its instances. `input`: which one it goes to. */
export interface Wire {
    readonly from: string;
    readonly to: string;
    readonly input: number;
    readonly dashed: boolean;
}

export interface Graph {
    readonly cards: ReadonlyMap<string, Card>;
    readonly wires: readonly Wire[];
    /* The middle of each card's right side; that of the scene's root is (0, 0). */
    readonly spots: ReadonlyMap<string, Point>;
    /* The scene's result. */
    readonly root: string;
}

/* A graph and what it was derived from. */
export interface Derived {
    readonly graph: Graph;
    readonly document: SceneDocument;
    readonly schema: Schema;
}

/* The main parameters of a node, the first ones where none is. */
export function cardParams(schema: Schema, document: SceneDocument, node: SceneNode) {
    const all = shownParams(schema, document, node).filter(
        ({ type, when }) => when === null && (BESIDE.includes(type) || BELOW.includes(type)),
    );
    const main = all.filter((param) => param.main);
    return (main.length > 0 ? main : all).slice(0, MOST);
}

/* The shape of pictures of nodes. */
const ASPECT = 3 / 2;

/* How wide its picture can be where a card has no parameters and inputs make it high. */
export function roomForPicture({ beside, below, height }: Card): number | null {
    const room = height - CARD.head - 2 * CARD.pad;
    const full = beside.length + below.length > 0 || room < 2 * CARD.picture;
    return full ? null : Math.min(ASPECT * room, CARD.width - 2 * CARD.pad - 4);
}

/* The middle of an input, from the top of its card. */
export function inputY(index: number): number {
    return CARD.head + CARD.pad + (index + 0.5) * CARD.input;
}

function cardOf(schema: Schema, document: SceneDocument, node: SceneNode, folded: boolean): Card {
    const params = cardParams(schema, document, node);
    const beside = params.filter(({ type }) => BESIDE.includes(type));
    const below = params.filter(({ type }) => BELOW.includes(type));
    const row = nodeType(schema, node.type);
    const open = row !== null && isContainer(row) && !folded;
    const inputs = folded ? NONE : node.children;
    const body = CARD.picture + below.length * CARD.row;
    const ports = (inputs.length + (open ? 1 : 0)) * CARD.input;
    return {
        id: node.id,
        parent: node.parent,
        model: modelNamed(schema, document, node)?.root ?? null,
        beside,
        below,
        inputs,
        open,
        hidden: folded ? preorder(document, node.id).length - 1 : 0,
        height: CARD.head + 2 * CARD.pad + Math.max(body, ports),
    };
}

const NONE: readonly string[] = [];

/* The same card as before where nothing of it changed, so that it is not drawn anew. */
function kept(old: Card | undefined, now: Card): Card {
    const same = (a: readonly unknown[], b: readonly unknown[]): boolean =>
        a.length === b.length && a.every((one, i) => one === b[i]);
    return old &&
        old.parent === now.parent &&
        old.model === now.model &&
        old.hidden === now.hidden &&
        old.open === now.open &&
        same(old.inputs, now.inputs) &&
        same(old.beside, now.beside) &&
        same(old.below, now.below)
        ? old
        : now;
}

function wiresOf(cards: Graph["cards"]): Wire[] {
    const wires: Wire[] = [];
    for (const { id, inputs, model } of cards.values()) {
        for (const [input, from] of inputs.entries()) {
            wires.push({ from, to: id, input, dashed: false });
        }
        if (model !== null) {
            wires.push({ from: model, to: id, input: 0, dashed: true });
        }
    }
    return wires;
}

/* The scene's tree, and left of it those of the models, one below the other. */
function spotsOf(document: SceneDocument, cards: Graph["cards"]): Map<string, Point> {
    const heightOf = (id: string): number => cards.get(id)?.height ?? 0;
    const childrenOf = (id: string): readonly string[] => cards.get(id)?.inputs ?? NONE;
    const draw = (root: string) => layoutTree({ root, childrenOf, heightOf }, SPACING);
    const spots = draw(document.root);
    const left = Math.min(...[...spots.values()].map(({ x }) => x)) - SPACING.column - APART;
    const trees = document.models.map(({ root }) => {
        const own = [...draw(root)];
        const top = Math.min(...own.map(([id, { y }]) => y - heightOf(id) / 2));
        const bottom = Math.max(...own.map(([id, { y }]) => y + heightOf(id) / 2));
        return { own, top, height: bottom - top };
    });
    const all = trees.reduce((sum, { height }) => sum + height + APART, -APART);
    let y = -all / 2;
    for (const { own, top, height } of trees) {
        for (const [id, spot] of own) {
            spots.set(id, { x: spot.x + left, y: spot.y - top + y });
        }
        y += height + APART;
    }
    return spots;
}

type Source = Pick<Derived, "schema" | "document">;

/* Can a card of before be taken as it is? */
function untouched(before: Derived, { schema, document }: Source, node: SceneNode): boolean {
    return (
        before.schema === schema &&
        before.document.nodes.get(node.id) === node &&
        before.document.primitives === document.primitives
    );
}

function cardsOf(source: Source, collapsed: ReadonlySet<string>, before: Derived | null) {
    const { schema, document } = source;
    const cards = new Map<string, Card>();
    const stack = [document.root, ...document.models.map(({ root }) => root)].reverse();
    for (let id = stack.pop(); id !== undefined; id = stack.pop()) {
        const node = document.nodes.get(id);
        if (node) {
            const folded = collapsed.has(id) && node.children.length > 0;
            const old = before?.graph.cards.get(id);
            const unfolded = before !== null && !folded && old?.hidden === 0;
            const same = unfolded && untouched(before, source, node);
            const card = same ? old : kept(old, cardOf(schema, document, node, folded));
            cards.set(id, card);
            for (let i = card.inputs.length - 1; i >= 0; i--) {
                stack.push(card.inputs[i] ?? "");
            }
        }
    }
    return cards;
}

function equal(a: Graph["cards"], b: Graph["cards"]): boolean {
    if (a.size !== b.size) {
        return false;
    }
    for (const [id, card] of a) {
        if (b.get(id) !== card) {
            return false;
        }
    }
    return true;
}

/* `before`: what it was, of which all is kept that is still so: the graph is the same object while
 * only numbers change. */
export function deriveGraph(
    schema: Schema,
    document: SceneDocument,
    collapsed: ReadonlySet<string>,
    before: Derived | null = null,
): Derived {
    const cards = cardsOf({ schema, document }, collapsed, before);
    const { root } = document;
    const graph =
        before && before.graph.root === root && equal(before.graph.cards, cards)
            ? before.graph
            : { cards, wires: wiresOf(cards), spots: spotsOf(document, cards), root };
    return { graph, document, schema };
}

/* The card that an arrow leads to from another: inputs are left, the result is right. */
export function neighbour({ cards }: Graph, id: string, key: string): string | null {
    const card = cards.get(id);
    const siblings = cards.get(card?.parent ?? "")?.inputs ?? NONE;
    const index = siblings.indexOf(id);
    switch (key) {
        case "ArrowLeft":
            return card?.inputs[Math.floor((card.inputs.length - 1) / 2)] ?? null;
        case "ArrowRight":
            return card?.parent ?? null;
        case "ArrowUp":
            return siblings[index - 1] ?? null;
        case "ArrowDown":
            return siblings[index + 1] ?? null;
        default:
            return null;
    }
}

/* Whose picture a card has where cutters and modifiers show the result: that of the nearest one above
 * that is neither. */
export function resultOf(document: SceneDocument, schema: Schema, id: string): string {
    const node = document.nodes.get(id);
    const above = node && parentOf(document, node);
    if (!above) {
        return id;
    }
    const cuts = takesAway(above.type) && above.children.indexOf(id) > 0;
    const changes = nodeType(schema, node.type)?.group === "modifier";
    return cuts || changes ? resultOf(document, schema, above.id) : id;
}
