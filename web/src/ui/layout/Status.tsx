/* SPDX-License-Identifier: MIT */
/* The line below: what can be done next with what is selected, and whether all is saved. */
import { Braces, Workflow } from "lucide-react";
import { commandById } from "../../model/commandLookup.ts";
import { drawerOf, toggleDrawer } from "../../model/view.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { TOUCH, useMedia } from "../theme.ts";
import { Tip } from "../widgets/Tip.tsx";
import { keyText, useKeyText } from "./keys.ts";
import { Region } from "./Region.tsx";
import { Saved } from "./Saved.tsx";
import "./layout.css";

interface Hint {
    key?: string;
    gesture?: TextKey;
    what: TextKey;
}

const nothing: readonly Hint[] = [
    { gesture: "hint.click", what: "hint.clickDo" },
    { gesture: "hint.drag", what: "hint.dragDo" },
    { gesture: "hint.rightDrag", what: "hint.rightDragDo" },
    { key: "Shift+A", what: "hint.add" },
    { key: "?", what: "hint.keys" },
];

const something: readonly Hint[] = [
    { gesture: "hint.scrub", what: "hint.scrubDo" },
    { key: "F2", what: "hint.rename" },
    { key: "Ctrl+D", what: "hint.duplicate" },
    { key: "F", what: "hint.frame" },
    { key: "?", what: "hint.keys" },
];

const drawers = {
    graph: { command: "view.graph", icon: Workflow },
    text: { command: "view.text", icon: Braces },
} as const;

/* Opens something below the picture, and closes it. */
function DrawerTab({ drawer }: { drawer: keyof typeof drawers }) {
    const { view } = useEditor().stores;
    const open = useView((state) => drawerOf(state) === drawer);
    const { command, icon: Icon } = drawers[drawer];
    const row = commandById(command);
    return (
        <Tip text={row?.title ?? ""} keys={useKeyText(command)}>
            <button
                type="button"
                className="status-tab"
                aria-pressed={open}
                data-command={command}
                onClick={() => view.setState(toggleDrawer(drawer))}
            >
                <Icon size={14} aria-hidden="true" />
                {t(`tab.${drawer}`)}
            </button>
        </Tip>
    );
}

export function Status() {
    const touch = useMedia(TOUCH);
    const touched = (gesture: TextKey): TextKey =>
        touch && gesture === "hint.click" ? "hint.tap" : gesture;
    const selection = useView((view) => view.selection);
    /* What is deleted by others stays selected, for when it comes back. */
    const selected = useDocument(({ document }) => selection.some((id) => document?.nodes.has(id)));
    return (
        <Region as="footer" name={t("region.status")} className="status">
            <DrawerTab drawer="graph" />
            <DrawerTab drawer="text" />
            <div className="status-hints">
                {(selected ? something : nothing).map(({ key, gesture, what }) => (
                    <span key={what}>
                        {key ? <kbd>{keyText(key)}</kbd> : gesture && <b>{t(touched(gesture))}</b>}
                        {t(what)}
                    </span>
                ))}
            </div>
            <div className="status-end">
                <Saved />
            </div>
        </Region>
    );
}
