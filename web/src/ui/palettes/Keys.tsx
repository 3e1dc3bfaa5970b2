/* SPDX-License-Identifier: MIT */
/* The sheet of keys, made from the table of commands, with the gestures beside them. */
import { useRef, useState } from "react";
import { COMMANDS } from "../../model/commands.ts";
import { type Keymap, takenKeys } from "../../model/keymap.ts";
import { setPreferences } from "../../model/stores.ts";
import { FlagField } from "../fields/Flag.tsx";
import { keyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Select } from "../widgets/Select.tsx";
import { KeyGroup } from "./KeyRows.tsx";
import { KEY_TEXTS, type KeyText } from "./keyTexts.ts";
import "./palettes.css";

const gestures: readonly { title: KeyText; rows: readonly (readonly [KeyText, string])[] }[] = [
    {
        title: "picture",
        rows: [
            ["select", "Click"],
            ["selectMore", "Shift+Click"],
            ["under", "Alt+Click"],
            ["box", "Shift+Drag"],
            ["orbit", "Drag"],
            ["pan", "Right drag"],
            ["dolly", "Wheel"],
            ["touch", "1 / 2 fingers"],
            ["regions", "F6"],
            ["section", "Drag / ↑ ↓"],
        ],
    },
    {
        title: "fields",
        rows: [
            ["scrub", "Drag"],
            ["fine", "Shift+Drag"],
            ["snap", "Ctrl+Drag"],
            ["type", "Click"],
            ["step", "↑ ↓"],
            ["restore", "Esc"],
            ["default", "Backspace"],
        ],
    },
    {
        title: "tree",
        rows: [
            ["treeMove", "↑ ↓ ← →"],
            ["treeDrag", "Ctrl+Shift+D"],
            ["treeMenu", "Right click"],
        ],
    },
    {
        title: "graph",
        rows: [
            ["graphMove", "↑ ↓ ← →"],
            ["graphFold", "Space"],
            ["graphWire", "Drag"],
            ["graphAdd", "Drag"],
            ["graphPark", "Drag"],
            ["graphInsert", "Drag"],
        ],
    },
];

export function Keys() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "help");
    const list = useRef<HTMLElement>(null);
    const [changes, setChanges] = useState(false);
    const groups = [...new Set(COMMANDS.map((command) => command.group))];
    return (
        <Dialog
            open={open}
            title={KEY_TEXTS.title}
            wide
            first={list}
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            {/* biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, so keys must reach it */}
            <section ref={list} className="keys" tabIndex={0} aria-label={KEY_TEXTS.title}>
                {gestures.map(({ title, rows }) => (
                    <section key={title}>
                        <h3>{KEY_TEXTS[title]}</h3>
                        <dl>
                            {rows.map(([what, how]) => (
                                <div key={what}>
                                    <dt>{KEY_TEXTS[what]}</dt>
                                    <dd>
                                        <kbd>{keyText(how)}</kbd>
                                    </dd>
                                </div>
                            ))}
                        </dl>
                    </section>
                ))}
                <Choices changes={changes} onChanges={setChanges} />
                {groups.map((group) => (
                    <KeyGroup key={group} group={group} changes={changes} />
                ))}
            </section>
        </Dialog>
    );
}

const KEYMAP_OPTIONS: readonly { value: Keymap; label: string }[] = [
    { value: "fieldcast", label: KEY_TEXTS.fieldcast },
    { value: "unity", label: KEY_TEXTS.unity },
];

interface ChoicesProps {
    changes: boolean;
    onChanges: (on: boolean) => void;
}

function Choices({ changes, onChanges }: ChoicesProps) {
    const { view } = useEditor().stores;
    const choices = useView(({ preferences }) => preferences);
    const { pointing, singleKeys, keymap, keys } = choices;
    const switches = [
        ["singleKeys", singleKeys, (on: boolean) => setPreferences(view, { singleKeys: on })],
        [
            "trackpad",
            pointing === "trackpad",
            (on: boolean) => setPreferences(view, { pointing: on ? "trackpad" : "mouse" }),
        ],
        ["changes", changes, onChanges],
    ] as const;
    return (
        <section>
            <h3>{KEY_TEXTS.choices}</h3>
            <dl>
                <div>
                    <dt>{KEY_TEXTS.keymap}</dt>
                    <dd>
                        <Select
                            label={KEY_TEXTS.keymap}
                            value={keymap}
                            options={KEYMAP_OPTIONS}
                            onChange={(next) => setPreferences(view, { keymap: next as Keymap })}
                        />
                    </dd>
                </div>
                {switches.map(([name, value, onCommit]) => (
                    <div key={name}>
                        <dt>{KEY_TEXTS[name]}</dt>
                        <dd>
                            <FlagField label={KEY_TEXTS[name]} value={value} onCommit={onCommit} />
                        </dd>
                    </div>
                ))}
            </dl>
            <div role="status">
                {takenKeys(COMMANDS, choices).map(({ key, by, from }) => (
                    <p key={from.id}>
                        <kbd>{keyText(key)}</kbd>
                        {` ${KEY_TEXTS.own} “${by.title}”, ${KEY_TEXTS.ownNot} “${from.title}”`}
                    </p>
                ))}
            </div>
            {Object.keys(keys).length > 0 && (
                <Button onClick={() => setPreferences(view, { keys: {} })}>
                    {KEY_TEXTS.reset}
                </Button>
            )}
        </section>
    );
}
