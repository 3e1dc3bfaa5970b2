/* SPDX-License-Identifier: MIT */
/* Something of the scene by its name: a material, a model, a distance function. Choose it, go to
 * it, or make a new one. */
import { type LucideIcon, Plus, SquarePen } from "lucide-react";
import { useMemo } from "react";
import { materialOf } from "../../model/document.ts";
import { LISTS, nodeOfPlace } from "../../model/places.ts";
import type { Param } from "../../model/schema.ts";
import { listNamedBy, modelsFor, type NamedList } from "../../model/usage.ts";
import { addResource } from "../insertions.ts";
import { NewMaterial } from "../materials/NewMaterial.tsx";
import { ResourceIcon } from "../scene/ResourceIcon.tsx";
import { useDocument, useEditor } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { type Option, Select } from "../widgets/Select.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

interface Props extends FieldProps<string> {
    param: Param;
    place: string;
}

const nothings: Partial<Record<Param["type"], TextKey>> = {
    function: "reference.code",
    model: "reference.nothing",
};

/* The option that stands for nothing, or for "the parent's". */
const NOTHING = "";

export function ReferenceField({
    param,
    label,
    value,
    mixed,
    place,
    describedBy,
    onCommit,
}: Props) {
    const editor = useEditor();
    const list = listNamedBy(param.type) ?? "materials";
    const { one } = LISTS[list];
    const node = nodeOfPlace(place);
    const options = useOptions(param, list, node);
    return (
        <div className="named">
            <Select
                value={value}
                mixed={mixed === "1"}
                label={label}
                describedBy={describedBy}
                options={options}
                onChange={onCommit}
            />
            {value !== NOTHING && mixed !== "1" && (
                <Act
                    title={t("reference.edit", { name: value })}
                    icon={SquarePen}
                    onClick={() => editor.show({ kind: "resource", list, name: value })}
                />
            )}
            {list === "materials" ? (
                <NewMaterial title={t("reference.new", { what: one })} use={place} />
            ) : (
                <Act
                    title={t("reference.new", { what: one })}
                    icon={Plus}
                    onClick={() => addResource(editor, list, place)}
                />
            )}
        </div>
    );
}

function useOptions(param: Param, list: NamedList, node: string | null) {
    const resources = useDocument((state) => state.document?.[list]);
    /* As texts, so that numbers that change do not make new options. */
    const nothing = useDocument(({ document }) => {
        const parent = node === null ? null : document?.nodes.get(node)?.parent;
        const found = list === "materials" && parent && document && materialOf(document, parent);
        return found
            ? t("material.inherited", { name: found.material })
            : t(nothings[param.type] ?? "reference.none");
    });
    const allowed = useDocument(({ document, schema }) =>
        list === "models" && document && node !== null
            ? modelsFor(schema, document, node).join(" ")
            : null,
    );
    return useMemo<Option[]>(() => {
        const names = (resources ?? []).map(({ name }) => name);
        const fitting = names.filter((name) => allowed?.split(" ").includes(name) ?? true);
        return [
            { value: NOTHING, label: nothing },
            ...fitting.map((name) => ({
                value: name,
                label: name,
                icon: <ResourceIcon list={list} name={name} />,
            })),
        ];
    }, [resources, allowed, nothing, list]);
}

interface ActProps {
    title: string;
    icon: LucideIcon;
    onClick: () => void;
}

function Act({ title, icon: Icon, onClick }: ActProps) {
    return (
        <IconButton title={title} data-size="s" onClick={onClick}>
            <Icon size={14} />
        </IconButton>
    );
}
