// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// Hands in the graph: from a press to letting go, however it comes to an end.
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { createStores } from "../src/model/stores.ts";
import type { Editor } from "../src/ui/editor.ts";
import { type Shown, watchHand } from "../src/ui/graph/hand.ts";
import { SCHEMA, scene } from "./fixture.ts";

let stop: () => void;
let panel: HTMLElement;
let shown: Shown | null;
let under: Element | null;
let edits: (readonly Operation[])[];
let stores: ReturnType<typeof createStores>;

function editorOf(): Editor {
    const edit = (ops: readonly Operation[]): boolean => {
        edits.push(ops);
        return true;
    };
    return { stores, edit, link: { edit } } as unknown as Editor;
}

function card(id: string): Element {
    const found = panel.querySelector(`[data-card="${id}"]`);
    if (found === null) {
        throw new Error(`no card ${id}`);
    }
    return found;
}

beforeEach(() => {
    stores = createStores(null);
    stores.document.setState({ document: scene(), schema: SCHEMA });
    [shown, under, edits] = [null, null, []];
    panel = document.body.appendChild(document.createElement("div"));
    panel.innerHTML = ["hat", "neck", "stick", "root"]
        .map((id) => `<div data-grab="card" data-card="${id}"></div>`)
        .join("");
    panel.setPointerCapture = () => undefined;
    document.elementFromPoint = () => under;
    vi.stubGlobal("CSS", { escape: (text: string) => text });
    stop = watchHand(editorOf(), panel, (now) => {
        shown = now;
    });
});

afterEach(() => {
    stop();
    panel.remove();
    Reflect.deleteProperty(document, "elementFromPoint");
    vi.unstubAllGlobals();
});

interface Told {
    readonly x?: number;
    readonly id?: number;
    readonly buttons?: number;
}

/* jsdom has no events of pointers. */
function point(type: string, at: Element, { x = 0, id = 1, buttons = 1 }: Told = {}): void {
    const event = new MouseEvent(type, { bubbles: true, button: 0, buttons, clientX: x });
    at.dispatchEvent(Object.assign(event, { pointerId: id, isPrimary: id === 1 }));
}

/* Carries the hat onto the neck. */
function carryHat(): void {
    point("pointerdown", card("hat"));
    under = card("neck");
    point("pointermove", panel, { x: 40 });
    expect(shown?.good).toBe(true);
}

test("a card that is let go on another becomes its input", () => {
    carryHat();
    point("pointerup", panel, { x: 40, buttons: 0 });
    expect(shown).toBeNull();
    expect(edits).toHaveLength(1);
});

test("a second finger changes nothing: the first one goes on", () => {
    carryHat();
    point("pointerdown", card("stick"), { id: 2 });
    point("pointerup", panel, { id: 2, buttons: 0 });
    expect(shown).not.toBeNull();
    point("pointerup", panel, { x: 40, buttons: 0 });
    expect(shown).toBeNull();
    point("pointerdown", card("stick"));
    point("pointerup", panel, { buttons: 0 });
    expect(edits).toHaveLength(1);
});

test("what was let go where nobody was told is not carried on", () => {
    point("pointerdown", card("hat"));
    under = card("neck");
    point("pointermove", panel, { x: 40, buttons: 0 });
    expect(shown).toBeNull();
    point("pointermove", panel, { x: 40 });
    point("pointerup", panel, { x: 40, buttons: 0 });
    expect(edits).toHaveLength(0);
});

test("what others have changed meanwhile counts when it is let go", () => {
    carryHat();
    const gone = apply(scene(), [{ op: "remove", at: "/nodes/neck" }], SCHEMA);
    stores.document.setState({ document: gone.ok ? gone.document : null });
    point("pointerup", panel, { x: 40, buttons: 0 });
    expect(edits).toHaveLength(0);
});
