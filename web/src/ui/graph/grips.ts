/* SPDX-License-Identifier: MIT */
/* What a pointer takes hold of in the graph and what it is over, told by the attributes of cards,
 * ports and wires; and what is done when it lets go. */
import { perform } from "../../model/actions.ts";
import type { SceneDocument } from "../../model/document.ts";
import type { Held, Outcome, Over } from "../../model/wiring.ts";
import type { Editor } from "../editor.ts";
import { type TextKey, t } from "../texts.ts";

const cardOf = (element: Element): string =>
    element.closest<HTMLElement>("[data-card]")?.dataset.card ?? "";

const indexOf = (element: HTMLElement): number => Number(element.dataset.index);

/* Several cards are held by one of them if all are selected. */
function together(id: string, selection: readonly string[]): readonly string[] {
    return selection.includes(id) ? selection : [id];
}

/* Null: nothing that can be held; a press there is for the view or for a field. */
export function heldAt(
    target: Element,
    document: SceneDocument,
    selection: readonly string[],
): Held | null {
    const grip = target.closest<HTMLElement>("[data-grab], [data-wire]");
    if (grip === null || target.closest("button, .graph-values")) {
        return null;
    }
    const wired = grip.dataset.wire;
    if (wired !== undefined) {
        return { kind: "loose", ids: [wired] };
    }
    const id = cardOf(grip);
    const node = document.nodes.get(id);
    switch (grip.dataset.grab) {
        case "free":
            return { kind: "free", into: id };
        case "loose":
            return { kind: "loose", ids: [node?.children[indexOf(grip)] ?? ""] };
        case "output":
            return { kind: "output", ids: together(id, selection) };
        default:
            return node?.parent == null ? null : { kind: "cards", ids: together(id, selection) };
    }
}

/* Where a port has an input, that is meant; elsewhere on a card the card. */
export function overAt(element: Element | null): { over: Over; mark: Element | null } {
    const port = element?.closest<HTMLElement>("[data-index]");
    if (port) {
        return { over: { kind: "input", into: cardOf(port), index: indexOf(port) }, mark: port };
    }
    const card = element?.closest<HTMLElement>("[data-card]");
    if (card) {
        return { over: { kind: "card", id: cardOf(card) }, mark: card };
    }
    const wire = element?.closest<SVGElement>("[data-wire]");
    const child = wire?.dataset.wire;
    return wire && child !== undefined
        ? { over: { kind: "wire", child }, mark: wire.parentElement }
        : { over: { kind: "nothing" }, mark: null };
}

const SAYS: Readonly<Record<Outcome["kind"], TextKey>> = {
    into: "graph.dropInto",
    input: "graph.dropHere",
    between: "graph.dropBetween",
    shelf: "graph.dropShelf",
    wrap: "graph.dropWrap",
    add: "graph.dropAdd",
    back: "graph.dropBack",
    not: "graph.dropNot",
};

/* What letting go here would do. */
export function say({ kind, name }: Outcome, over: Over): string {
    const number = over.kind === "input" ? over.index + 1 : 0;
    return t(SAYS[kind], { name, number });
}

export function letGo(editor: Editor, outcome: Outcome): void {
    const { view } = editor.stores;
    switch (outcome.kind) {
        case "wrap":
            view.setState({ selection: outcome.ids, subject: { kind: "nodes" }, popup: "wrap" });
            break;
        case "add":
            view.setState({ popup: "input", into: outcome.into });
            break;
        case "back":
        case "not":
            break;
        default:
            perform(editor, outcome.edit);
    }
}
