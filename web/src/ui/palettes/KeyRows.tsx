/* SPDX-License-Identifier: MIT */
/* Commands with their keys; and each with a button that takes another key. */
import { type KeyboardEvent, useState } from "react";
import { COMMANDS, type Command } from "../../model/commands.ts";
import { isTaken, keysOf, rivalOf } from "../../model/keymap.ts";
import { nameOfPress } from "../../model/keys.ts";
import { type Stores, setPreferences } from "../../model/stores.ts";
import { keyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { KEY_TEXTS } from "./keyTexts.ts";

const MODIFIERS = ["Control", "Shift", "Alt", "Meta", "AltGraph"];

function setKey({ view }: Stores, { id }: Command, key: string): void {
    const { keys } = view.getState().preferences;
    setPreferences(view, { keys: { ...keys, [id]: key } });
}

/* Why a command cannot have a key; null: it can. */
function whyNotKey({ view }: Stores, command: Command, key: string): string | null {
    if (isTaken(key)) {
        return KEY_TEXTS.taken;
    }
    const rival = rivalOf(key, command, COMMANDS, view.getState().preferences);
    return rival && `${KEY_TEXTS.rival} “${rival.title}”`;
}

export function KeyGroup({ group, changes }: { group: Command["group"]; changes: boolean }) {
    const choices = useView(({ preferences }) => preferences);
    const rows = COMMANDS.filter(
        (command) =>
            command.group === group && (changes || keysOf(command, COMMANDS, choices).length > 0),
    );
    return (
        rows.length > 0 && (
            <section>
                <h3>{KEY_TEXTS[group]}</h3>
                <dl>
                    {rows.map((command) => (
                        <div key={command.id}>
                            <dt>{command.title}</dt>
                            <dd>
                                {changes ? (
                                    <KeyButton command={command} />
                                ) : (
                                    <KeyCaps keys={keysOf(command, COMMANDS, choices)} />
                                )}
                            </dd>
                        </div>
                    ))}
                </dl>
            </section>
        )
    );
}

const KeyCaps = ({ keys }: { keys: readonly string[] }) =>
    keys.slice(0, 2).map((key) => <kbd key={key}>{keyText(key)}</kbd>);

/* Esc leaves it as it is, Backspace takes the key away. */
function KeyButton({ command }: { command: Command }) {
    const { stores } = useEditor();
    const keys = keysOf(
        command,
        COMMANDS,
        useView(({ preferences }) => preferences),
    );
    const [waits, setWaits] = useState(false);
    const [fault, setFault] = useState<string | null>(null);
    const stop = (): void => {
        setWaits(false);
        setFault(null);
    };
    const take = (event: KeyboardEvent): void => {
        if (!waits || MODIFIERS.includes(event.key)) {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
        const key = nameOfPress(event.nativeEvent);
        const reason = ["Esc", "Backspace"].includes(key) ? null : whyNotKey(stores, command, key);
        if (reason !== null) {
            setFault(`${keyText(key)} ${reason}`);
            return;
        }
        if (key !== "Esc") {
            setKey(stores, command, key === "Backspace" ? "" : key);
        }
        stop();
    };
    return (
        <button
            type="button"
            className="key-button"
            data-waits={waits || undefined}
            aria-label={`${command.title}: ${keys[0] ?? KEY_TEXTS.none}`}
            onClick={() => setWaits(true)}
            onKeyDown={take}
            onBlur={stop}
        >
            {waits && <span role="status">{fault ?? KEY_TEXTS.press}</span>}
            {!waits && <KeyCaps keys={keys} />}
            {!waits && keys.length === 0 && KEY_TEXTS.none}
        </button>
    );
}
