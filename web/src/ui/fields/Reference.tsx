/* SPDX-License-Identifier: MIT */
/* A material of the scene: choose, make a new one, or make a shared one this node's own. */
import { CopyPlus, Palette, Plus } from "lucide-react";
import { useMemo } from "react";
import { materialOf, materialUsers, nodeOfPlace } from "../../model/document.ts";
import { addMaterial, makeMaterialUnique } from "../acts.ts";
import { IconButton } from "../parts/Button.tsx";
import { type Option, Select } from "../parts/Select.tsx";
import { Swatch } from "../parts/Swatch.tsx";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

interface Props extends FieldProps<string> {
    place: string;
}

/* The option that stands for "the parent's". */
const INHERIT = "";

export function ReferenceField({ label, value, place, describedBy, onCommit }: Props) {
    const editor = useEditor();
    const materials = useDocument((state) => state.document?.materials);
    const node = nodeOfPlace(place);
    const inherited = useDocument((state) => {
        const parent = node === null ? null : state.document?.nodes.get(node)?.parent;
        const found = parent && state.document ? materialOf(state.document, parent) : null;
        return found?.material ?? null;
    });
    const shared = useDocument((state) =>
        state.document && value !== "" ? materialUsers(state.document, value).length > 1 : false,
    );
    const options = useMemo<Option[]>(
        () => [
            {
                value: INHERIT,
                label:
                    inherited === null
                        ? t("material.none")
                        : t("material.inherited", { name: inherited }),
                icon: <Palette size={14} />,
            },
            ...(materials ?? []).map((material) => ({
                value: material.name,
                label: material.name,
                icon: <Swatch name={material.name} />,
            })),
        ],
        [materials, inherited],
    );
    return (
        <div className="reference">
            <Select
                value={value}
                label={label}
                describedBy={describedBy}
                options={options}
                onChange={onCommit}
            />
            {value !== "" && (
                <IconButton
                    title={t("material.edit", { name: value })}
                    data-size="s"
                    onClick={() => editor.show({ kind: "material", name: value })}
                >
                    <Palette size={14} />
                </IconButton>
            )}
            {shared && node !== null && (
                <IconButton
                    title={t("material.unique")}
                    data-size="s"
                    onClick={() => makeMaterialUnique(editor, node, value)}
                >
                    <CopyPlus size={14} />
                </IconButton>
            )}
            <IconButton
                title={t("material.new")}
                data-size="s"
                onClick={() => addMaterial(editor, node)}
            >
                <Plus size={14} />
            </IconButton>
        </div>
    );
}
