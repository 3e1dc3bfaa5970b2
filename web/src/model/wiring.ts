/* SPDX-License-Identifier: MIT */
/* What a hand does in the graph: what it holds, what it is over, and what comes of that when it is
 * let go. Pure; the edits are those of moves.ts. */
import { nodeLabel, type SceneDocument } from "./document.ts";
import type { Edit } from "./edits.ts";
import { connect, fits, insertBetween, park, parkable } from "./moves.ts";
import type { Schema } from "./schema.ts";

/* `cards`: by their heads. `output`: a new end of their wires, drawn from a card's result. `loose`:
 * their wires, pulled off an input. `free`: a wire drawn from the free input of `into`. */
export type Held =
    | { readonly kind: "cards" | "output" | "loose"; readonly ids: readonly string[] }
    | { readonly kind: "free"; readonly into: string };

/* `input`: one of a card, its number from 0. `wire`: the one from `child` to its parent. */
export type Over =
    | { readonly kind: "input"; readonly into: string; readonly index: number }
    | { readonly kind: "card"; readonly id: string }
    | { readonly kind: "wire"; readonly child: string }
    | { readonly kind: "nothing" };

/* `name`: the node that it is about, as people read it. */
export type Outcome = { readonly name: string } & (
    | { readonly kind: "into" | "input" | "between" | "shelf"; readonly edit: Edit }
    /* Asked first: what goes around `ids`, what becomes an input of `into`. */
    | { readonly kind: "wrap"; readonly ids: readonly string[] }
    | { readonly kind: "add"; readonly into: string }
    | { readonly kind: "back" | "not" }
);

interface Scene {
    readonly schema: Schema;
    readonly document: SceneDocument;
}

const labelOf = (document: SceneDocument, id: string): string => {
    const node = document.nodes.get(id);
    return node ? nodeLabel(node) : id;
};

function toInput(scene: Scene, ids: readonly string[], into: string, index: number): Outcome {
    const { schema, document } = scene;
    const name = labelOf(document, into);
    if (ids.includes(into)) {
        return { kind: "back", name };
    }
    if (!fits(schema, document, ids, into)) {
        return { kind: "not", name };
    }
    const edit = connect(document, ids, into, index);
    return edit ? { kind: "input", edit, name } : { kind: "back", name };
}

/* As the last input of a card. */
function toCard(scene: Scene, ids: readonly string[], into: string): Outcome {
    const count = scene.document.nodes.get(into)?.children.length ?? 0;
    const outcome = toInput(scene, ids, into, count);
    return outcome.kind === "input" ? { ...outcome, kind: "into" } : outcome;
}

/* What can hold others comes between the ends of a wire; anything else does not fit there. */
function toWire({ schema, document }: Scene, ids: readonly string[], child: string): Outcome {
    const name = labelOf(document, child);
    const [id, ...others] = ids;
    if (ids.includes(child)) {
        return { kind: "back", name };
    }
    const alone = id !== undefined && others.length === 0;
    const edit = alone ? insertBetween(schema, document, id, child) : null;
    return edit ? { kind: "between", edit, name } : { kind: "not", name };
}

function toNothing(
    { document }: Scene,
    kind: "cards" | "output" | "loose",
    ids: readonly string[],
) {
    const name = labelOf(document, ids[0] ?? "");
    const edit =
        kind === "loose" && parkable(document, ids).length > 0 ? park(document, ids) : null;
    if (edit) {
        return { kind: "shelf", edit, name } as const;
    }
    return kind === "output"
        ? ({ kind: "wrap", ids, name } as const)
        : ({ kind: "back", name } as const);
}

/* What the end of a wire from a free input is over: the card, or the one that a wire comes from. */
function sourceOf(over: Over): string | null {
    switch (over.kind) {
        case "card":
            return over.id;
        case "wire":
            return over.child;
        case "input":
            return over.into;
        default:
            return null;
    }
}

export function outcomeOf(scene: Scene, held: Held, over: Over): Outcome {
    if (held.kind === "free") {
        const source = sourceOf(over);
        return source === null
            ? { kind: "add", into: held.into, name: labelOf(scene.document, held.into) }
            : toCard(scene, [source], held.into);
    }
    switch (over.kind) {
        case "input":
            return toInput(scene, held.ids, over.into, over.index);
        case "card":
            return toCard(scene, held.ids, over.id);
        case "wire":
            return toWire(scene, held.ids, over.child);
        default:
            return toNothing(scene, held.kind, held.ids);
    }
}
