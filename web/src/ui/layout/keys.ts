/* SPDX-License-Identifier: MIT */
/* Keys of the page: finds the command for a press where the focus is, and F6 between regions. */
import { useEffect } from "react";
import { commandById, commandForKey, runCommand, type Typing } from "../../model/commandLookup.ts";
import { COMMANDS, type Context } from "../../model/commands.ts";
import { keysOf } from "../../model/keymap.ts";
import { addNotice } from "../../model/stores.ts";
import { text } from "../../model/texts.ts";
import type { Editor } from "../editor.ts";
import { forgetKept, keepForPalette } from "../palettes/ahead.ts";
import { useView } from "../state.ts";

function contextOf(element: Element | null): Context {
    const context = element?.closest<HTMLElement>("[data-context]")?.dataset.context;
    return context === "view" || context === "tree" ? context : "anywhere";
}

/* Fields of the document say in `data-field` whether their text differs from it. */
function typingIn(element: Element | null): Typing {
    if (!element?.matches("input, textarea, [contenteditable='true']")) {
        return "no";
    }
    return element.matches("[data-field='unchanged']") ? "unchanged" : "text";
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

/* Over the inspector Backspace is for values, which its rows take; it never deletes. */
function isResetOnly(event: KeyboardEvent): boolean {
    return event.key === "Backspace" && document.querySelector(".values-region:hover") !== null;
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
            /* What floats keeps its own keys, but for what acts in an unchanged field of a popover. */
            const floats = focus?.closest("[role='dialog'], [role='menu'], [role='listbox']");
            const typing = typingIn(focus);
            if (floats && !(floats.matches(".popover") && typing === "unchanged")) {
                return;
            }
            const { preferences } = editor.stores.view.getState();
            const command = commandForKey(event, contextOf(focus), typing, preferences);
            if (command === null || (floats && command.inFields !== "unchanged")) {
                return;
            }
            event.preventDefault();
            const reason = isResetOnly(event)
                ? text("why.pointerBackspace")
                : runCommand(editor, command);
            if (reason !== null && command.id !== "escape") {
                addNotice(editor.stores.notices, { level: "info", code: "why", message: reason });
            }
        };
        const early = (event: KeyboardEvent): void => {
            const { popup } = editor.stores.view.getState();
            const inside = document.activeElement?.closest("[role='dialog']");
            if (popup !== null && !inside && keepForPalette(event, popup)) {
                event.preventDefault();
                event.stopPropagation();
            }
        };
        const stop = editor.stores.view.subscribe(({ popup }) => popup === null && forgetKept());
        window.addEventListener("keydown", early, true);
        window.addEventListener("keydown", down);
        return () => {
            stop();
            window.removeEventListener("keydown", early, true);
            window.removeEventListener("keydown", down);
        };
    }, [editor]);
}

const mac = /Mac|iPhone|iPad/.test(navigator.platform);

/* The first key of a command, by its id. */
export function useKeyText(id: string): string | undefined {
    const command = commandById(id);
    return useView(({ preferences }) =>
        command ? keyText(keysOf(command, COMMANDS, preferences)[0]) : undefined,
    );
}

/* Keys as this machine's people write them. */
export function keyText(keys: string | undefined): string | undefined {
    return mac && keys !== undefined
        ? keys.replace("Ctrl+", "⌘").replace("Shift+", "⇧").replace("Alt+", "⌥")
        : keys;
}
