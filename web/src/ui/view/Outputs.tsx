/* SPDX-License-Identifier: MIT */
/* Which output is shown, and how sharp while moving. */
import { Check, Layers2 } from "lucide-react";
import { setPreferences } from "../../model/stores.ts";
import { AOVS, QUALITIES } from "../../model/view.ts";
import { Menu, MenuItem, MenuLine } from "../parts/Menu.tsx";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

export function Outputs() {
    const { stores } = useEditor();
    const aov = useView((view) => view.aov);
    const quality = useView((view) => view.preferences.quality);
    const mark = (on: boolean) => (on ? <Check size={14} /> : undefined);
    return (
        <Menu
            align="end"
            trigger={
                <button type="button" className="glass pill" data-testid="outputs">
                    <Layers2 size={14} aria-hidden="true" />
                    {t(`aov.${aov}`)}
                </button>
            }
        >
            {AOVS.map((one) => (
                <MenuItem
                    key={one}
                    icon={mark(one === aov)}
                    onSelect={() => stores.view.setState({ aov: one })}
                >
                    {t(`aov.${one}`)}
                </MenuItem>
            ))}
            <MenuLine />
            {QUALITIES.map((one) => (
                <MenuItem
                    key={one}
                    icon={mark(one === quality)}
                    onSelect={() => setPreferences(stores.view, { quality: one })}
                >
                    {t(`quality.${one}`)}
                </MenuItem>
            ))}
        </Menu>
    );
}
