/* SPDX-License-Identifier: MIT */
/* What pointing at the picture does to the stores: the camera, the selection, the menu. */

import { focusOn, moveCamera } from "../../model/actions.ts";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { parentOf, topmost } from "../../model/document.ts";
import { nameAll } from "../../model/edits.ts";
import { addNotice, type Stores, setPreferences } from "../../model/stores.ts";
import { vectorOf } from "../../model/transform.ts";
import { type SelectMode, select } from "../../model/view.ts";
import { holdBox } from "../../overlay/box.ts";
import type { Hands, HandsPage } from "../../overlay/hands.ts";
import type { Step } from "../../overlay/hold.ts";
import type { PointerActions } from "../../overlay/pointer.ts";
import { guideAt } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";
import { sceneKept } from "../opening.ts";
import type { Target } from "../scene/NodeMenu.tsx";
import { t } from "../texts.ts";
import type { MenuPlace } from "../widgets/Menu.tsx";
import { questions } from "./questions.ts";

/* The same place clicked again climbs to the parent. */
const SAME_PLACE = 4;

interface Click {
    x: number;
    y: number;
    node: string | null;
}

/* Opens the menu at a point of the window; what it answers is told what was found there. */
type OpenMenu = (at: MenuPlace) => (settle: () => Target) => void;

/* Shapes at a point of the window, the nearest first. */
export interface Under {
    readonly at: MenuPlace;
    readonly nodes: readonly string[];
}

export function pointerActions(
    editor: Editor,
    element: HTMLElement,
    hands: () => Hands | null,
    onMenu: OpenMenu,
    onUnder: (under: Under) => void,
): PointerActions {
    const { stores } = editor;
    const { ask, answered } = questions(editor, element);
    let last: Click | null = null;

    /* Undefined: there is no answer. */
    const nodeUnder = async (x: number, y: number): Promise<string | null | undefined> => {
        const known = guideAt(stores, element, { x, y });
        return known === undefined ? (await ask(x, y))?.node : answered().then(() => known);
    };

    const choose = (node: string | null, mode: SelectMode): void =>
        stores.view.setState(({ selection }) => ({
            selection: select(selection, node, mode),
            subject: { kind: "nodes" },
        }));
    const chooseAll = (nodes: readonly string[]): void =>
        stores.view.setState(({ selection }) => ({
            selection: [...selection.filter((id) => !nodes.includes(id)), ...nodes],
            subject: { kind: "nodes" },
        }));
    const aim = async (x: number, y: number): Promise<void> => {
        stores.view.setState({ aiming: false });
        const picked = await ask(x, y);
        if (picked?.position) {
            focusOn(editor, vectorOf(picked.position));
        }
    };
    /* The third click begins anew. */
    const measure = async (x: number, y: number): Promise<void> => {
        const position = (await ask(x, y))?.position;
        if (position) {
            stores.view.setState(({ measured }) => ({
                measured: measured && [
                    ...(measured.length < 2 ? measured : []),
                    vectorOf(position),
                ],
            }));
        }
    };
    const list = async (x: number, y: number): Promise<void> => {
        const nodes = (await ask(x, y, true))?.through;
        if (nodes) {
            const box = element.getBoundingClientRect();
            onUnder({ at: { x: box.left + x, y: box.top + y }, nodes });
        }
    };
    const click = async (x: number, y: number, mode: SelectMode): Promise<void> => {
        if (stores.view.getState().measured !== null) {
            await measure(x, y);
            return;
        }
        if (stores.view.getState().aiming) {
            await aim(x, y);
            return;
        }
        if (mode === "replace" && hands()?.click({ x, y })) {
            return;
        }
        const node = await nodeUnder(x, y);
        if (node === undefined) {
            return;
        }
        const { document } = stores.document.getState();
        const { selection } = stores.view.getState();
        const near = last !== null && Math.hypot(x - last.x, y - last.y) < SAME_PLACE;
        const again = near && last?.node === node && mode === "replace";
        const active = document?.nodes.get(selection.at(-1) ?? "");
        const parent = again && active && document ? parentOf(document, active) : undefined;
        last = { x, y, node };
        choose(parent ? parent.id : node, mode);
    };
    /* The menu is there at once; what it is about follows. */
    const menu = async (x: number, y: number): Promise<void> => {
        const box = element.getBoundingClientRect();
        const settle = onMenu({ x: box.left + x, y: box.top + y });
        const node = (await nodeUnder(x, y)) ?? null;
        settle(() => {
            if (node !== null && !stores.view.getState().selection.includes(node)) {
                choose(node, "replace");
            }
            return node === null ? "nothing" : "selection";
        });
    };
    return {
        grab: (press) => hands()?.grab(press) ?? holdBox(stores, element, press, chooseAll),
        camera: () => stores.camera.getState().camera,
        moveCamera: (camera) => moveCamera(editor, () => camera),
        click: (x, y, mode, all) => void (all ? list(x, y) : click(x, y, mode)),
        menu: (x, y) => void menu(x, y),
        frame: async (x, y) => {
            if (hands()?.double({ x, y })) {
                return;
            }
            const node = (await nodeUnder(x, y)) ?? null;
            const command = commandById("camera.frame");
            if (node !== null && command) {
                choose(node, "replace");
                runCommand(editor, command);
            }
        },
        pointing: () => stores.view.getState().preferences.pointing,
        seemsTrackpad: () => askTrackpad(stores),
        gesture: (kind) => {
            element.dataset.gesture = kind ?? "";
        },
    };
}

/* Once. */
function askTrackpad({ view, notices }: Stores): void {
    const { hintsDone } = view.getState().preferences;
    if (hintsDone.includes("trackpad")) {
        return;
    }
    setPreferences(view, { hintsDone: [...hintsDone, "trackpad"] });
    const run = (): void => setPreferences(view, { pointing: "trackpad" });
    addNotice(notices, {
        level: "info",
        code: "trackpad",
        message: t("pointing.ask"),
        acts: [{ kind: "orbit", run }],
    });
}

function nameOfHeld({ document: scene, view }: Stores): string {
    const { document } = scene.getState();
    const { selection, subject } = view.getState();
    if (subject.kind === "resource") {
        return subject.name;
    }
    if (subject.kind === "camera") {
        return t("hands.camera");
    }
    return document ? nameAll(document, topmost(document, selection)) : "";
}

/* An undo step of what is selected. It does nothing in another scene, whose nodes may have the same
 * names: the way back of a browser ends no drag. */
function beginStep({ stores, link }: Editor, what: string): Step {
    const isKept = sceneKept({ stores });
    const step = link.gesture(`${what} ${nameOfHeld(stores)}`);
    const letGo = (how: "end" | "cancel"): void => {
        stores.view.setState({ held: false });
        step[how]();
    };
    stores.view.setState({ held: true });
    return {
        edit: (ops) => isKept() && step.edit(ops),
        end: () => letGo("end"),
        cancel: () => letGo("cancel"),
    };
}

/* What hands ask of the page: an undo step, and words. */
export function handsPage(editor: Editor): HandsPage {
    const { stores } = editor;
    return {
        stores,
        begin: (what) => beginStep(editor, what),
        refuse: (limit) => {
            const message =
                "most" in limit
                    ? t("points.most", { count: limit.most })
                    : t("points.least", { count: limit.least });
            addNotice(stores.notices, { level: "info", code: "points", message });
        },
        edgeHint: t("points.edge"),
    };
}
