/* SPDX-License-Identifier: MIT */
/* What the gizmo does, which way its axes point, and whether it goes in steps. */
import { ChevronDown, Move3d, Rotate3d, Ruler as RulerIcon, Scale3d } from "lucide-react";
import { changeHands } from "../../model/actions.ts";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { MOTIONS } from "../../model/grip.ts";
import { PIVOTS, SPACES } from "../../model/hands.ts";
import { keyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { Tip } from "../widgets/Tip.tsx";
import "./view.css";

const ICONS = { move: Move3d, turn: Rotate3d, scale: Scale3d };

export function HandTools() {
    const editor = useEditor();
    const { tool, space, snap } = useView((view) => view.preferences.hands);
    return (
        <div className="glass hand-tools" role="toolbar" aria-label={t("hands.tools")}>
            {MOTIONS.map((motion) => {
                const Icon = ICONS[motion];
                const command = commandById(`hands.tool.${motion}`);
                return (
                    <Tip key={motion} text={t(`hands.${motion}`)} keys={keyText(command?.keys[0])}>
                        <button
                            type="button"
                            className="pill"
                            aria-label={t(`hands.${motion}`)}
                            aria-pressed={tool === motion}
                            onClick={() => command && runCommand(editor, command)}
                        >
                            <Icon size={16} aria-hidden="true" />
                        </button>
                    </Tip>
                );
            })}
            <Ruler />
            <Menu
                align="start"
                trigger={
                    <button type="button" className="pill" aria-label={t("hands.settings")}>
                        <span className="hand-tools-space">{t(`hands.space.${space}`)}</span>
                        {snap && <span className="hand-tools-snap">0.1</span>}
                        <ChevronDown size={13} aria-hidden="true" />
                    </button>
                }
            >
                <Settings />
            </Menu>
        </div>
    );
}

function Ruler() {
    const editor = useEditor();
    const measuring = useView((view) => view.measured !== null);
    const command = commandById("view.measure");
    return (
        <Tip text={t("measure.title")}>
            <button
                type="button"
                className="pill"
                aria-label={t("measure.title")}
                aria-pressed={measuring}
                onClick={() => command && runCommand(editor, command)}
            >
                <RulerIcon size={16} aria-hidden="true" />
            </button>
        </Tip>
    );
}

function Settings() {
    const editor = useEditor();
    const { space, pivot, snap } = useView((view) => view.preferences.hands);
    return (
        <>
            {SPACES.map((one) => (
                <MenuItem
                    key={one}
                    checked={one === space}
                    onSelect={() => changeHands(() => ({ space: one }))(editor)}
                >
                    {`${t("hands.space")}: ${t(`hands.space.${one}`)}`}
                </MenuItem>
            ))}
            <MenuLine />
            {PIVOTS.map((one) => (
                <MenuItem
                    key={one}
                    checked={one === pivot}
                    onSelect={() => changeHands(() => ({ pivot: one }))(editor)}
                >
                    {`${t("hands.pivot")}: ${t(`hands.pivot.${one}`)}`}
                </MenuItem>
            ))}
            <MenuLine />
            <MenuItem
                checked={snap}
                keys={keyText("Shift+M")}
                onSelect={() => changeHands((now) => ({ snap: !now.snap }))(editor)}
            >
                {t("hands.snap")}
            </MenuItem>
        </>
    );
}
