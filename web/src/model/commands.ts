/* SPDX-License-Identifier: MIT */
/* THE TABLE of commands: palette, menus, tooltips, key sheet and key handling are made from it. */
import type { Operation } from "./operations.ts";
import type { Stores } from "./stores.ts";

/* What commands need from the page around the model. */
export interface App {
    readonly stores: Stores;
    edit(ops: readonly Operation[], options?: { group?: string; label?: string }): boolean;
    undo(): void;
    redo(): void;
    /* Width over height of the picture. */
    aspect(): number;
    writeClipboard(text: string): void;
    readClipboard(): Promise<string>;
    /* Saves the document as a file; opens the chooser for one. */
    download(): void;
    upload(): void;
}

/* Where a key works: `anywhere` outside of text fields, or only with the focus in that region. */
export type Context = "anywhere" | "view" | "tree";

export interface Command {
    readonly id: string;
    readonly title: string;
    readonly group: "scene" | "edit" | "select" | "camera" | "view" | "help";
    /* "Ctrl+Shift+Z"; the first is shown. Ctrl is Cmd on a Mac. */
    readonly keys: readonly string[];
    readonly when: Context;
    /* Also acts while a text field has the focus. */
    readonly inFields?: boolean;
    /* Left out of the palette: only a key. */
    readonly keyOnly?: boolean;
    /* Why it cannot run now, for the tooltip; null: it can. */
    whyNot(app: App): string | null;
    run(app: App): void;
}

/* What a keyboard event says; the DOM's KeyboardEvent fits. */
export interface KeyPress {
    readonly key: string;
    readonly code: string;
    readonly ctrlKey: boolean;
    readonly metaKey: boolean;
    readonly shiftKey: boolean;
    readonly altKey: boolean;
}

export const COMMANDS: readonly Command[] = [];

export function commandById(id: string): Command | null {
    return COMMANDS.find((command) => command.id === id) ?? null;
}

/* The command for a key press with the focus in `where`; null: none. `typing`: the focus is in
 * something that takes text. `singleKeys` false: keys without Ctrl or Alt do nothing. */
export declare function commandForKey(
    press: KeyPress,
    where: Context,
    typing: boolean,
    singleKeys: boolean,
): Command | null;

/* Runs a command unless something speaks against it; answers the reason or null. */
export function runCommand(app: App, command: Command): string | null {
    const reason = command.whyNot(app);
    if (reason === null) {
        command.run(app);
    }
    return reason;
}

/* Commands for the palette, best match first. */
export declare function searchCommands(query: string): Command[];
