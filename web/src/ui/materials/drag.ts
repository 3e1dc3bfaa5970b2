/* SPDX-License-Identifier: MIT */
/* Materials that are dragged: a ball of the gallery or of the scene, onto the picture, a row of the
 * tree or a card of the graph. */
import type { DragEvent } from "react";
import { PRESETS, type Preset } from "../../model/presets.ts";
import type { Editor } from "../editor.ts";
import { addResource } from "../insertions.ts";
import { t } from "../texts.ts";

const PRESET = "application/x-fieldcast-preset";
const MATERIAL = "application/x-fieldcast-material";

type Transfer = Pick<DragEvent, "dataTransfer">;

const drag =
    (type: string, name: string) =>
    ({ dataTransfer }: Transfer): void => {
        dataTransfer.setData(type, name);
        dataTransfer.effectAllowed = "copy";
    };

export const dragPreset = (name: string) => drag(PRESET, name);
export const dragMaterial = (name: string) => drag(MATERIAL, name);

/* What a browser tells before the drop: its types alone. */
export function carriesMaterial({ dataTransfer }: { dataTransfer: DataTransfer | null }): boolean {
    const types = dataTransfer?.types ?? [];
    return types.includes(PRESET) || types.includes(MATERIAL);
}

export interface Carried {
    readonly preset: Preset | null;
    /* A material of the scene; "": none. */
    readonly material: string;
}

/* Can be read during the drop alone. */
export function carriedBy(data: DataTransfer): Carried {
    const name = data.getData(PRESET);
    const preset = PRESETS.find((one) => one.name === name) ?? null;
    return { preset, material: data.getData(MATERIAL) };
}

/* Gives a node what was dropped on it. */
export function dropMaterial(editor: Editor, { preset, material }: Carried, node: string): void {
    const use = `/nodes/${node}/material`;
    if (preset) {
        addResource(editor, "materials", use, preset);
    } else if (material !== "") {
        const label = t("edit.set", { owner: node, name: "material" });
        editor.link.edit([{ op: "set", at: use, value: material }], { label });
    }
}

/* What a row or a card of a node does with materials that are dragged over it; what else is dragged
 * is for `others`. */
export function takesMaterial(
    editor: Editor,
    node: string,
    others: { onDragOver?: DragTaker; onDrop?: DragTaker } = {},
): { onDragOver: DragTaker; onDrop: DragTaker } {
    return {
        onDragOver: (event) => {
            if (carriesMaterial(event)) {
                event.preventDefault();
                editor.stores.view.setState({ hovered: node });
            } else {
                others.onDragOver?.(event);
            }
        },
        onDrop: (event) => {
            if (carriesMaterial(event)) {
                event.preventDefault();
                dropMaterial(editor, carriedBy(event.dataTransfer), node);
            } else {
                others.onDrop?.(event);
            }
        },
    };
}

type DragTaker = (event: DragEvent) => void;
