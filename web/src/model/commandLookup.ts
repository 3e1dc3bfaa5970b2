/* SPDX-License-Identifier: MIT */
/* Finding commands: by id, by a key press, by words; and running one. */
import type { App } from "./actions.ts";
import { COMMANDS, type Command, type Context } from "./commands.ts";
import { isSingleKey, type KeyPress, nameOfPress } from "./keys.ts";
import { search } from "./search.ts";

const BY_ID = new Map(COMMANDS.map((command) => [command.id, command]));

export function commandById(id: string): Command | null {
    return BY_ID.get(id) ?? null;
}

/* Do two contexts overlap: could one key press mean both? */
export function overlap(a: Context, b: Context): boolean {
    return a === b || a === "anywhere" || b === "anywhere";
}

/* The command for a key press with the focus in `where`; null: none. `typing`: the focus is in
 * something that takes text. `singleKeys` false: keys without Ctrl or Alt do nothing. */
export function commandForKey(
    press: KeyPress,
    where: Context,
    typing: boolean,
    singleKeys: boolean,
): Command | null {
    const name = nameOfPress(press);
    const command = COMMANDS.find(
        ({ keys, when }) => keys.includes(name) && (when === "anywhere" || when === where),
    );
    if (!command || (typing && !command.inFields)) {
        return null;
    }
    return isSingleKey(name) && !singleKeys ? null : command;
}

/* Runs a command unless something speaks against it; answers the reason or null. */
export function runCommand(app: App, command: Command): string | null {
    const reason = command.whyNot(app);
    if (reason === null) {
        command.run(app);
    }
    return reason;
}

/* Commands for the palette, best match first. */
export function searchCommands(query: string): readonly Command[] {
    const offered = COMMANDS.filter(({ keyOnly }) => !keyOnly);
    return search(offered, query, ({ title, group, id }) => ({
        name: title,
        words: id.replaceAll(".", " "),
        kind: group,
    }));
}
