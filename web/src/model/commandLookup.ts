/* SPDX-License-Identifier: MIT */
/* Finding commands: by id, by a key press, by words; and running one. */
import type { App } from "./actions.ts";
import { ABSENT, type Absent, COMMANDS, type Command, type Context } from "./commands.ts";
import { type KeyChoices, keysOf } from "./keymap.ts";
import { isSingleKey, type KeyPress, nameOfPress } from "./keys.ts";
import { search } from "./search.ts";
import { text } from "./texts.ts";

const BY_ID = new Map(COMMANDS.map((command) => [command.id, command]));

export function commandById(id: string): Command | null {
    return BY_ID.get(id) ?? null;
}

/* What has the focus: nothing that takes text, a field as the document has it, or a text that is
 * being typed. */
export type Typing = "no" | "unchanged" | "text";

function allows({ inFields }: Command, typing: Typing): boolean {
    return typing === "no" || inFields === true || (inFields === typing && typing === "unchanged");
}

/* The command for a key press with the focus in `where`; null: none. */
export function commandForKey(
    press: KeyPress,
    where: Context,
    typing: Typing,
    choices: KeyChoices,
): Command | null {
    const name = nameOfPress(press);
    const command = COMMANDS.find(
        (one) =>
            (one.when === "anywhere" || one.when === where) &&
            keysOf(one, COMMANDS, choices).includes(name),
    );
    if (!command || !allows(command, typing)) {
        return null;
    }
    return isSingleKey(name) && !choices.singleKeys ? null : command;
}

/* Neither the scene nor the camera changes under a hand. */
function whyHeld({ stores }: App, { group, takesOver }: Command): string | null {
    const { held, motion } = stores.view.getState();
    const waits = (group === "edit" || group === "camera") && !(takesOver && motion !== null);
    return held && waits ? text("why.held") : null;
}

/* What speaks against a command now; null: nothing. */
export function whyNotNow(app: App, command: Command): string | null {
    return whyHeld(app, command) ?? command.whyNot(app);
}

/* Runs a command unless something speaks against it; answers the reason or null. */
export function runCommand(app: App, command: Command): string | null {
    const reason = whyNotNow(app, command);
    if (reason === null) {
        command.run(app);
    }
    return reason;
}

/* Answers for what there is not; none while nothing is asked for. */
export function searchAbsent(query: string): readonly Absent[] {
    return query.trim() === ""
        ? []
        : search(ABSENT, query, ({ title, words }) => ({ name: title, words }));
}

/* Commands for the palette, best match first. */
export function searchCommands(query: string): readonly Command[] {
    const offered = COMMANDS.filter(({ keyOnly }) => !keyOnly);
    return search(offered, query, ({ title, group, id, words }) => ({
        name: title,
        words: `${id.replaceAll(".", " ")} ${words}`,
        kind: group,
    }));
}
