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

/* Do two contexts overlap: could one key press mean both? */
export function overlap(a: Context, b: Context): boolean {
    return a === b || a === "anywhere" || b === "anywhere";
}

/* A user's own key, which another command had. */
export interface Taken {
    readonly key: string;
    readonly by: Command;
    readonly from: Command;
}

/* What a command has by its row or the keymap, and what of it is another's own key. */
function givenKeys(command: Command, all: readonly Command[], { keymap, keys }: KeyChoices) {
    const given = (keymap === "unity" ? UNITY[command.id] : undefined) ?? command.keys;
    const taken = all.flatMap((by): Taken[] => {
        const key = keys[by.id] ?? "";
        const takes = by.id !== command.id && given.includes(key) && overlap(by.when, command.when);
        return takes ? [{ key, by, from: command }] : [];
    });
    return { given, taken };
}

/* Own keys come before those of any keymap, so that a press means one command whichever is chosen. */
export function keysOf(
    command: Command,
    all: readonly Command[],
    choices: KeyChoices,
): readonly string[] {
    const own = choices.keys[command.id];
    if (own !== undefined) {
        return own === "" ? [] : [own];
    }
    const { given, taken } = givenKeys(command, all, choices);
    return given.filter((key) => !taken.some((one) => one.key === key));
}

export function takenKeys(all: readonly Command[], choices: KeyChoices): readonly Taken[] {
    return all
        .filter(({ id }) => choices.keys[id] === undefined)
        .flatMap((command) => givenKeys(command, all, choices).taken);
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
                keysOf(other, all, choices).includes(key),
        ) ?? null
    );
}
