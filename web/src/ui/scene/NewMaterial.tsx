/* SPDX-License-Identifier: MIT */
/* A button for a new material: what it is to look like, or a plain one. */
import { Plus } from "lucide-react";
import { PRESETS } from "../../model/presets.ts";
import { vectorOf } from "../../model/transform.ts";
import { toHex } from "../../model/units.ts";
import { addResource } from "../insertions.ts";
import { typeTitle } from "../names.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { ball } from "../widgets/Swatch.tsx";

interface Props {
    title: string;
    /* The place that is to name it. */
    use: string | null;
}

function colourOf(properties: (typeof PRESETS)[number]["properties"]): string {
    const { emission, base_color } = properties;
    return toHex(vectorOf((emission ?? base_color) as number[]));
}

export function NewMaterial({ title, use }: Props) {
    const editor = useEditor();
    return (
        <Menu
            align="end"
            trigger={
                <IconButton title={title} data-size="s">
                    <Plus size={14} />
                </IconButton>
            }
        >
            {PRESETS.map((preset) => (
                <MenuItem
                    key={preset.name}
                    icon={
                        <span
                            className="swatch"
                            style={{ background: ball(colourOf(preset.properties)) }}
                        />
                    }
                    onSelect={() => addResource(editor, "materials", use, preset)}
                >
                    {typeTitle(preset.name)}
                </MenuItem>
            ))}
            <MenuLine />
            <MenuItem onSelect={() => addResource(editor, "materials", use)}>
                {t("materials.plain")}
            </MenuItem>
        </Menu>
    );
}
