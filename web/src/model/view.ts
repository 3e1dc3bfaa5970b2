/* SPDX-License-Identifier: MIT */
/* What one user's page looks like: selection, panels, theme, hints. Pure state and its changes;
 * never part of a document, never sent to others. */

import type { Box } from "./camera.ts";
import type { SceneDocument } from "./document.ts";
import { MOTIONS, type Motion } from "./grip.ts";
import { PIVOTS, type Pivot, SPACES, type Space } from "./hands.ts";
import { KEYMAPS, type KeyChoices } from "./keymap.ts";
import type { Operation } from "./operation.ts";
import type { ListName, RecordName } from "./places.ts";
import { WAY_NAMES, type Way } from "./placing.ts";
import type { Section } from "./section.ts";
import type { Vector } from "./transform.ts";

export type Theme = "auto" | "light" | "dark";
export type Quality = "auto" | "smooth" | "sharp";
export type Pointing = "mouse" | "trackpad";
/* What covers the page; one at a time, Esc closes it. `wrap`: what can go around the selection;
 * `input`: what can become the last input of `into`. */
export type Popup =
    | "commands"
    | "add"
    | "wrap"
    | "input"
    | "scenes"
    | "help"
    | "reference"
    | "statistics"
    | "picture"
    | "library"
    | "groebner"
    | "primitive"
    | null;

/* What can be shown below the picture. */
export const DRAWERS = ["graph", "text", "code"] as const;
export type Drawer = (typeof DRAWERS)[number];

/* The output that is the picture itself. */
export const COLOR = "color";
export const QUALITIES: readonly Quality[] = ["auto", "smooth", "sharp"];

/* What stays from visit to visit. */
export interface Preferences extends KeyChoices {
    readonly theme: Theme;
    readonly pointing: Pointing;
    readonly quality: Quality;
    readonly panels: {
        readonly scene: boolean;
        readonly inspector: boolean;
        readonly graph: boolean;
        readonly text: boolean;
    };
    /* Names of hints that were followed or closed. */
    readonly hintsDone: readonly string[];
    /* Rows of the tree have pictures of their nodes. */
    readonly thumbnails: boolean;
    /* Cards of cutters and modifiers show what these are a part of. */
    readonly results: boolean;
    /* Node types last added, newest first. */
    readonly recent: readonly string[];
    /* How what is added combines with what is selected: as it was last. */
    readonly way: Way;
    readonly hands: HandSettings;
    /* Lights, volumes and the camera have icons in the picture. */
    readonly marks: boolean;
    /* What is selected, and what is under the pointer, is outlined. */
    readonly outlines: boolean;
    /* The ground has lines. */
    readonly grid: boolean;
    /* What the pixel under the pointer shows is told. */
    readonly probe: boolean;
}

/* How hands in the picture act. */
export interface HandSettings {
    /* What the gizmo does; null: there is none. */
    readonly tool: Motion | null;
    readonly space: Space;
    readonly pivot: Pivot;
    /* Moves go in steps; Ctrl turns that off for a while. */
    readonly snap: boolean;
}

const HANDS: HandSettings = { tool: "move", space: "world", pivot: "center", snap: false };

export const PREFERENCES: Preferences = {
    theme: "auto",
    pointing: "mouse",
    quality: "auto",
    panels: { scene: true, inspector: true, graph: false, text: false },
    hintsDone: [],
    singleKeys: true,
    keymap: "fieldcast",
    keys: {},
    thumbnails: true,
    results: false,
    recent: [],
    way: "union",
    hands: HANDS,
    marks: true,
    outlines: true,
    grid: true,
    probe: false,
};

/* What the inspector shows when no node is selected or a resource is. */
export type Subject =
    | { readonly kind: "nodes" }
    | { readonly kind: "resource"; readonly list: ListName; readonly name: string }
    | { readonly kind: RecordName };

/* An edit that is looked at and not made; what it is about, and what is said meanwhile. */
export interface Trial {
    readonly ops: readonly Operation[];
    readonly name: string;
    readonly words: string;
}

export interface View {
    /* Selected node ids, the active one last. */
    readonly selection: readonly string[];
    readonly subject: Subject;
    readonly hovered: string | null;
    readonly collapsed: ReadonlySet<string>;
    /* Ids of nodes that this page shows alone; empty: it shows all. */
    readonly isolated: readonly string[];
    /* What cuts this page's pictures; null: nothing. */
    readonly section: Section | null;
    /* Around what may be cut, as it was asked for last. */
    readonly extent: Box;
    /* What this page shows as if it were so: no edit. */
    readonly trial: Trial | null;
    /* The node whose name is being typed. */
    readonly renaming: string | null;
    readonly popup: Popup;
    /* The node that the next addition goes into, while the popup is `input`. */
    readonly into: string | null;
    /* The model whose parameters are chosen, while the popup is `primitive`; null: what is
     * selected. */
    readonly model: string | null;
    /* The place of the code that is being edited; null: the editor of code is closed. */
    readonly code: string | null;
    /* What is in front below the picture, where several are open. */
    readonly drawer: Drawer;
    /* Scene files of which nobody has said yet what they are for. */
    readonly offered: readonly { readonly path: string; readonly text: string }[];
    /* The type at which the reference opens. */
    readonly topic: string | null;
    /* Ctrl+\ hides all but the picture. */
    readonly chromeHidden: boolean;
    /* The output shown: a name of the schema's. */
    readonly aov: string;
    /* The next click says what the camera focuses on. */
    readonly aiming: boolean;
    /* Ends of the distance that clicks measure, at most two; null: clicks select. */
    readonly measured: readonly Vector[] | null;
    /* What the pointer does to the selection, with no button held; null: nothing. */
    readonly motion: Motion | null;
    /* A hand in the picture holds something, by the pointer or by keys. */
    readonly held: boolean;
    readonly preferences: Preferences;
}

export const INITIAL_VIEW: View = {
    selection: [],
    subject: { kind: "nodes" },
    hovered: null,
    collapsed: new Set(),
    isolated: [],
    section: null,
    extent: { low: [-1, -1, -1], high: [1, 1, 1] },
    trial: null,
    renaming: null,
    popup: null,
    into: null,
    model: null,
    code: null,
    drawer: "graph",
    offered: [],
    topic: null,
    chromeHidden: false,
    aov: COLOR,
    aiming: false,
    measured: null,
    motion: null,
    held: false,
    preferences: PREFERENCES,
};

export type SelectMode = "replace" | "toggle" | "add";

/* The selection after a click on `id` (null: on nothing). */
export function select(
    selection: readonly string[],
    id: string | null,
    mode: SelectMode,
): readonly string[] {
    if (id === null) {
        return mode === "replace" ? [] : selection;
    }
    const others = selection.filter((other) => other !== id);
    if (mode === "replace") {
        return [id];
    }
    const toggledOff = mode === "toggle" && others.length < selection.length;
    return toggledOff ? others : [...others, id];
}

/* The selection after an undo or redo: what it has brought back; where all that was selected is gone,
 * what was selected before the step. */
export function selectAfter(
    document: SceneDocument,
    selection: readonly string[],
    back: readonly string[],
    before: readonly string[],
): readonly string[] {
    const isThere = (id: string): boolean => document.nodes.has(id);
    if (back.length > 0) {
        return back;
    }
    return selection.length === 0 || selection.some(isThere) ? selection : before.filter(isThere);
}

/* Unfolds all that hides a node. */
export function unfoldTo({ collapsed }: View, above: readonly string[]): Partial<View> {
    const open = new Set(above);
    return { collapsed: new Set([...collapsed].filter((one) => !open.has(one))) };
}

/* What is open below the picture, in the order of tabs. */
export function drawersOf({ code, preferences: { panels } }: View): readonly Drawer[] {
    return DRAWERS.filter((one) => (one === "code" ? code !== null : panels[one]));
}

/* What is shown of it; null: nothing is open. */
export function drawerOf(view: View): Drawer | null {
    const open = drawersOf(view);
    return open.includes(view.drawer) ? view.drawer : (open[0] ?? null);
}

/* Brings one to the front, or closes it where it is there. */
export const toggleDrawer =
    (drawer: "graph" | "text") =>
    (view: View): Partial<View> => {
        const open = drawerOf(view) !== drawer;
        const panels = { ...view.preferences.panels, [drawer]: open };
        return { drawer, preferences: { ...view.preferences, panels } };
    };

/* Esc: closes the topmost thing only. Null when there was nothing to close. */
export function peel(view: View): Partial<View> | null {
    if (view.renaming !== null) {
        return { renaming: null };
    }
    if (view.popup !== null) {
        return { popup: null };
    }
    if (view.motion !== null) {
        return { motion: null };
    }
    if (view.aiming) {
        return { aiming: false };
    }
    if (view.measured !== null) {
        return { measured: null };
    }
    if (view.chromeHidden) {
        return { chromeHidden: false };
    }
    if (view.subject.kind !== "nodes") {
        return { subject: { kind: "nodes" } };
    }
    if (view.section !== null) {
        return { section: null };
    }
    if (view.isolated.length > 0) {
        return { isolated: [] };
    }
    return view.selection.length > 0 ? { selection: [] } : null;
}

/* Reads what was stored; unknown or broken members fall back one by one. */
export function readPreferences(text: string | null): Preferences {
    let stored: Partial<Preferences> = {};
    try {
        const json: unknown = JSON.parse(text ?? "{}");
        stored = typeof json === "object" && json !== null ? json : {};
    } catch {
        /* An old or damaged entry is worth no more than none. */
    }
    const one = <T>(value: unknown, allowed: readonly T[], fallback: T): T =>
        allowed.includes(value as T) ? (value as T) : fallback;
    const texts = (value: unknown): readonly string[] =>
        Array.isArray(value) ? value.filter((item) => typeof item === "string") : [];
    return {
        theme: one(stored.theme, ["auto", "light", "dark"], PREFERENCES.theme),
        pointing: one(stored.pointing, ["mouse", "trackpad"], PREFERENCES.pointing),
        quality: one(stored.quality, QUALITIES, PREFERENCES.quality),
        panels: {
            scene: stored.panels?.scene !== false,
            inspector: stored.panels?.inspector !== false,
            graph: stored.panels?.graph === true,
            text: stored.panels?.text === true,
        },
        hintsDone: texts(stored.hintsDone),
        singleKeys: stored.singleKeys !== false,
        keymap: one(stored.keymap, KEYMAPS, PREFERENCES.keymap),
        keys: Object.fromEntries(
            Object.entries(stored.keys ?? {}).filter(([, key]) => typeof key === "string"),
        ),
        thumbnails: stored.thumbnails !== false,
        results: stored.results === true,
        recent: texts(stored.recent).slice(0, 12),
        way: one(stored.way, WAY_NAMES, PREFERENCES.way),
        hands: {
            tool: one(stored.hands?.tool, [...MOTIONS, null], HANDS.tool),
            space: one(stored.hands?.space, SPACES, HANDS.space),
            pivot: one(stored.hands?.pivot, PIVOTS, HANDS.pivot),
            snap: stored.hands?.snap === true,
        },
        marks: stored.marks !== false,
        outlines: stored.outlines !== false,
        grid: stored.grid !== false,
        probe: stored.probe === true,
    };
}
