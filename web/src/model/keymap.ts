/* SPDX-License-Identifier: MIT */
/* Which keys a command has: those of its row, of another tool's habits, or those that a user chose. */
import type { Command, Context } from "./commands.ts";

export const KEYMAPS = ["fieldcast", "unity"] as const;
export type Keymap = (typeof KEYMAPS)[number];

export interface KeyChoices {
    readonly keymap: Keymap;
    /* By the command's id; "": none. */
    readonly keys: Readonly<Record<string, string>>;
    /* Keys without Ctrl or Alt (G, H, F …) act as commands; some assistive tools need that off. */
    readonly singleKeys: boolean;
}

/* Of the editor of three.js and of Unity: tools on W, E and R. */
const UNITY: Readonly<Record<string, readonly string[]>> = {
    "hands.tool.move": ["W", "1"],
    "hands.tool.turn": ["E", "2"],
    "hands.tool.scale": ["R", "3"],
    "hands.turn": ["T"],
    "node.wrap": ["Shift+W"],
};

export function keysOf({ id, keys }: Command, choices: KeyChoices): readonly string[] {
    const own = choices.keys[id];
    if (own !== undefined) {
        return own === "" ? [] : [own];
    }
    return (choices.keymap === "unity" ? UNITY[id] : undefined) ?? keys;
}

/* Do two contexts overlap: could one key press mean both? */
export function overlap(a: Context, b: Context): boolean {
    return a === b || a === "anywhere" || b === "anywhere";
}

/* Keys of the browser, of what has the focus and of what floats. */
const TAKEN =
    /^(Ctrl\+|Shift\+)*(Tab|Enter|Space|Esc|Up|Down|Left|Right|F5|F6|F11|F12)$|^Ctrl\+[NTWR]$/;

export const isTaken = (key: string): boolean => TAKEN.test(key);

/* The other command that a key would mean as well. */
export function rivalOf(
    key: string,
    command: Command,
    all: readonly Command[],
    choices: KeyChoices,
): Command | null {
    return (
        all.find(
            (other) =>
                other.id !== command.id &&
                overlap(other.when, command.when) &&
                keysOf(other, choices).includes(key),
        ) ?? null
    );
}
