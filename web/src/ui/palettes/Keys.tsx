/* SPDX-License-Identifier: MIT */
/* The sheet of keys, made from the table of commands, with the gestures beside them. */
import { useRef } from "react";
import { COMMANDS, type Command } from "../../model/commands.ts";
import { setPreferences } from "../../model/stores.ts";
import { FlagField } from "../fields/Flag.tsx";
import { keyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Dialog } from "../widgets/Dialog.tsx";
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
                <Choices />
                {groups.map((group) => (
                    <KeyGroup key={group} group={group} />
                ))}
            </section>
        </Dialog>
    );
}

function Choices() {
    const { stores } = useEditor();
    const { pointing, singleKeys } = useView(({ preferences }) => preferences);
    const rows = [
        ["singleKeys", singleKeys, (on: boolean) => ({ singleKeys: on })],
        [
            "trackpad",
            pointing === "trackpad",
            (on: boolean) => ({ pointing: on ? ("trackpad" as const) : ("mouse" as const) }),
        ],
    ] as const;
    return (
        <section>
            <h3>{KEY_TEXTS.choices}</h3>
            <dl>
                {rows.map(([name, value, choice]) => (
                    <div key={name}>
                        <dt>{KEY_TEXTS[name]}</dt>
                        <dd>
                            <FlagField
                                label={KEY_TEXTS[name]}
                                value={value}
                                onCommit={(on) => setPreferences(stores.view, choice(on))}
                            />
                        </dd>
                    </div>
                ))}
            </dl>
        </section>
    );
}

function KeyGroup({ group }: { group: Command["group"] }) {
    const rows = COMMANDS.filter((command) => command.group === group && command.keys.length > 0);
    if (rows.length === 0) {
        return null;
    }
    return (
        <section>
            <h3>{KEY_TEXTS[group]}</h3>
            <dl>
                {rows.map(({ id, title, keys }) => (
                    <div key={id}>
                        <dt>{title}</dt>
                        <dd>
                            {keys.slice(0, 2).map((key) => (
                                <kbd key={key}>{keyText(key)}</kbd>
                            ))}
                        </dd>
                    </div>
                ))}
            </dl>
        </section>
    );
}
