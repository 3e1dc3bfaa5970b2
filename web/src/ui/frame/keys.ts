/* SPDX-License-Identifier: MIT */
/* Keys of the page: finds the command for a press where the focus is, and F6 between regions. */
import { useEffect } from "react";
import { commandForKey, runCommand } from "../../model/commandLookup.ts";
import type { Context } from "../../model/commands.ts";
import { addNotice } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";

function contextOf(element: Element | null): Context {
    const context = element?.closest<HTMLElement>("[data-context]")?.dataset.context;
    return context === "view" || context === "tree" ? context : "anywhere";
}

function isTyping(element: Element | null): boolean {
    return element?.matches("input, textarea, [contenteditable='true']") ?? false;
}

/* Moves the focus to the next region that is on screen. */
function cycleRegions(backwards: boolean): void {
    const regions = [...document.querySelectorAll<HTMLElement>("[data-region]")].filter(
        (region) => region.offsetParent !== null || region.getClientRects().length > 0,
    );
    const now = regions.findIndex((region) => region.contains(document.activeElement));
    const step = backwards ? -1 : 1;
    const next = regions[(now + step + regions.length) % regions.length];
    const inner = next?.querySelector<HTMLElement>("[data-region-focus], [tabindex='0']");
    (inner ?? next)?.focus();
}

export function useKeys(editor: Editor): void {
    useEffect(() => {
        const down = (event: KeyboardEvent): void => {
            if (event.defaultPrevented || event.isComposing) {
                return;
            }
            if (event.key === "F6") {
                event.preventDefault();
                cycleRegions(event.shiftKey);
                return;
            }
            const focus = document.activeElement;
            /* What floats keeps its own keys; only its Escape reaches it. */
            if (focus?.closest("[role='dialog'], [role='menu'], [role='listbox']")) {
                return;
            }
            const { preferences } = editor.stores.view.getState();
            const command = commandForKey(
                event,
                contextOf(focus),
                isTyping(focus),
                preferences.singleKeys,
            );
            if (command === null) {
                return;
            }
            event.preventDefault();
            const reason = runCommand(editor, command);
            if (reason !== null && command.id !== "escape") {
                addNotice(editor.stores.notices, { level: "info", code: "why", message: reason });
            }
        };
        window.addEventListener("keydown", down);
        return () => window.removeEventListener("keydown", down);
    }, [editor]);
}

const mac = /Mac|iPhone|iPad/.test(navigator.platform);

/* Keys as this machine's people write them. */
export function keyText(keys: string | undefined): string | undefined {
    return mac && keys !== undefined
        ? keys.replace("Ctrl+", "⌘").replace("Shift+", "⇧").replace("Alt+", "⌥")
        : keys;
}
