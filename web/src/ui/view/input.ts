/* SPDX-License-Identifier: MIT */
/* What pointing at the picture does to the stores: the camera, the selection, the menu. */

import { focusOn, moveCamera } from "../../model/actions.ts";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { parentOf } from "../../model/document.ts";
import { vectorOf } from "../../model/transform.ts";
import { type SelectMode, select } from "../../model/view.ts";
import type { InputActions } from "../../overlay/input.ts";
import type { Editor } from "../editor.ts";

/* The same place clicked again climbs to the parent. */
const SAME_PLACE = 4;

interface Click {
    x: number;
    y: number;
    node: string | null;
}

export function inputActions(
    editor: Editor,
    element: HTMLElement,
    onMenu: (at: { x: number; y: number }) => void,
): InputActions {
    const { stores, link } = editor;
    let last: Click | null = null;

    const pick = async (x: number, y: number): Promise<string | null> => {
        try {
            return (await link.pick(x, y)).node;
        } catch {
            return null; /* offline: the picture stays, there is nobody to ask */
        }
    };
    const choose = (node: string | null, mode: SelectMode): void =>
        stores.view.setState(({ selection }) => ({
            selection: select(selection, node, mode),
            subject: { kind: "nodes" },
        }));
    const aim = async (x: number, y: number): Promise<void> => {
        stores.view.setState({ aiming: false });
        const picked = await link.pick(x, y).catch(() => null);
        if (picked?.position) {
            focusOn(editor, vectorOf(picked.position));
        }
    };
    const click = async (x: number, y: number, mode: SelectMode): Promise<void> => {
        if (stores.view.getState().aiming) {
            await aim(x, y);
            return;
        }
        const node = await pick(x, y);
        const { document } = stores.document.getState();
        const { selection } = stores.view.getState();
        const near = last !== null && Math.hypot(x - last.x, y - last.y) < SAME_PLACE;
        const again = near && last?.node === node && mode === "replace";
        const active = document?.nodes.get(selection.at(-1) ?? "");
        const parent = again && active && document ? parentOf(document, active) : undefined;
        last = { x, y, node };
        choose(parent ? parent.id : node, mode);
    };
    return {
        camera: () => stores.camera.getState().camera,
        moveCamera: (camera) => moveCamera(editor, () => camera),
        click: (x, y, mode) => void click(x, y, mode),
        menu: async (x, y) => {
            const node = await pick(x, y);
            const { selection } = stores.view.getState();
            if (node !== null && !selection.includes(node)) {
                choose(node, "replace");
            }
            const box = element.getBoundingClientRect();
            onMenu({ x: box.left + x, y: box.top + y });
        },
        frame: async (x, y) => {
            const node = await pick(x, y);
            const command = commandById("camera.frame");
            if (node !== null && command) {
                choose(node, "replace");
                runCommand(editor, command);
            }
        },
        pointing: () => stores.view.getState().preferences.pointing,
        gesture: (kind) => {
            element.dataset.gesture = kind ?? "";
        },
    };
}
