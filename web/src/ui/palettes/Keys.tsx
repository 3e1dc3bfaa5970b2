/* SPDX-License-Identifier: MIT */
/* The sheet of keys, made from the table of commands, with the gestures beside them. */
import { useRef } from "react";
import { COMMANDS, type Command } from "../../model/commands.ts";
import { keyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { Dialog } from "../widgets/Dialog.tsx";
import "./palettes.css";

const gestures: readonly { title: TextKey; rows: readonly (readonly [TextKey, string])[] }[] = [
    {
        title: "keys.picture",
        rows: [
            ["keys.select", "Click"],
            ["keys.selectMore", "Shift+Click"],
            ["keys.under", "Alt+Click"],
            ["keys.box", "Shift+Drag"],
            ["keys.orbit", "Drag"],
            ["keys.pan", "Right drag"],
            ["keys.dolly", "Wheel"],
            ["keys.touch", "1 / 2 fingers"],
            ["keys.regions", "F6"],
            ["keys.section", "Drag / ↑ ↓"],
        ],
    },
    {
        title: "keys.fields",
        rows: [
            ["keys.scrub", "Drag"],
            ["keys.fine", "Shift+Drag"],
            ["keys.snap", "Ctrl+Drag"],
            ["keys.type", "Click"],
            ["keys.step", "↑ ↓"],
            ["keys.restore", "Esc"],
            ["keys.default", "Backspace"],
        ],
    },
    {
        title: "keys.tree",
        rows: [
            ["keys.treeMove", "↑ ↓ ← →"],
            ["keys.treeDrag", "Ctrl+Shift+D"],
            ["keys.treeMenu", "Right click"],
        ],
    },
    {
        title: "keys.graph",
        rows: [
            ["keys.graphMove", "↑ ↓ ← →"],
            ["keys.graphFold", "Space"],
            ["keys.graphWire", "Drag"],
            ["keys.graphAdd", "Drag"],
            ["keys.graphPark", "Drag"],
            ["keys.graphInsert", "Drag"],
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
            title={t("keys.title")}
            wide
            first={list}
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            {/* biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, so keys must reach it */}
            <section ref={list} className="keys" tabIndex={0} aria-label={t("keys.title")}>
                {gestures.map(({ title, rows }) => (
                    <section key={title}>
                        <h3>{t(title)}</h3>
                        <dl>
                            {rows.map(([what, how]) => (
                                <div key={what}>
                                    <dt>{t(what)}</dt>
                                    <dd>
                                        <kbd>{keyText(how)}</kbd>
                                    </dd>
                                </div>
                            ))}
                        </dl>
                    </section>
                ))}
                {groups.map((group) => (
                    <KeyGroup key={group} group={group} />
                ))}
            </section>
        </Dialog>
    );
}

function KeyGroup({ group }: { group: Command["group"] }) {
    const rows = COMMANDS.filter((command) => command.group === group && command.keys.length > 0);
    if (rows.length === 0) {
        return null;
    }
    return (
        <section>
            <h3>{t(`keys.${group}`)}</h3>
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
