/* SPDX-License-Identifier: MIT */
/* What the gizmo does, which way its axes point, and whether it goes in steps; measuring, a section, the grid. */
import {
    ChevronDown,
    Grid3x3,
    type LucideIcon,
    Move3d,
    Rotate3d,
    Ruler,
    Scale3d,
    SquareSplitHorizontal,
} from "lucide-react";
import { changeHands } from "../../model/actions.ts";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { MOTIONS } from "../../model/grip.ts";
import { PIVOTS, SPACES } from "../../model/hands.ts";
import { useKeyText } from "../layout/keys.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { Tip } from "../widgets/Tip.tsx";
import "./view.css";

const ICONS = { move: Move3d, turn: Rotate3d, scale: Scale3d };

export function HandTools() {
    const { tool, space, snap } = useView((view) => view.preferences.hands);
    const grid = useView((view) => view.preferences.grid);
    const measuring = useView((view) => view.measured !== null);
    const cut = useView((view) => view.section !== null);
    return (
        <div className="glass hand-tools" role="toolbar" aria-label={t("hands.tools")}>
            {MOTIONS.map((motion) => (
                <Tool
                    key={motion}
                    command={`hands.tool.${motion}`}
                    text={t(`hands.${motion}`)}
                    pressed={tool === motion}
                    Icon={ICONS[motion]}
                />
            ))}
            <Tool
                command="view.measure"
                text={t("measure.title")}
                pressed={measuring}
                Icon={Ruler}
            />
            <Tool
                command="view.section"
                text={t("section.title")}
                pressed={cut}
                Icon={SquareSplitHorizontal}
            />
            <Tool command="view.grid" text={t("grid.title")} pressed={grid} Icon={Grid3x3} />
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

interface ToolProps {
    command: string;
    text: string;
    pressed: boolean;
    Icon: LucideIcon;
}

function Tool({ command: id, text, pressed, Icon }: ToolProps) {
    const editor = useEditor();
    const command = commandById(id);
    return (
        <Tip text={text} keys={useKeyText(id)}>
            <button
                type="button"
                className="pill"
                data-command={id}
                aria-label={text}
                aria-pressed={pressed}
                onClick={() => command && runCommand(editor, command)}
            >
                <Icon size={16} aria-hidden="true" />
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
                keys={useKeyText("hands.snap")}
                onSelect={() => changeHands((now) => ({ snap: !now.snap }))(editor)}
            >
                {t("hands.snap")}
            </MenuItem>
        </>
    );
}
