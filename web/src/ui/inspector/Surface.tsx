/* SPDX-License-Identifier: MIT */
/* What a node is made of: its material, and the material's two main values at hand, with a word on
 * who else has it. Of several nodes only what all have in common. */
import { useMemo } from "react";
import { findResource, resourceParams } from "../../model/document.ts";
import { mixedAt } from "../../model/multiEdit.ts";
import { valuesPlace } from "../../model/places.ts";
import { findParam, type Param } from "../../model/schema.ts";
import { usersOf } from "../../model/usage.ts";
import { Form } from "../form.tsx";
import { makeMaterialUnique } from "../insertions.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Section } from "./Section.tsx";
import "./inspector.css";

/* Meanings of properties that most people want first (`means` in the schema). */
const MAIN = ["color", "roughness", "gloss"];

export function Surface({ id, owner }: { id: string; owner: string }) {
    const common = useDocument((state) => state.schema.node);
    const name = useDocument(({ document }) => document?.nodes.get(id)?.common.material ?? "");
    const selection = useView((view) => view.selection);
    const mixed = useDocument(
        ({ schema, document }) =>
            document !== null &&
            mixedAt(schema, document, selection, `/nodes/${id}/material`) !== "",
    );
    const surface = useMemo(() => {
        const material = findParam(common, "material");
        return material ? [material] : [];
    }, [common]);
    return (
        <Section title={t("inspector.surface")}>
            <div className="section-body">
                <Form params={surface} base={`/nodes/${id}`} owner={owner} />
                {typeof name === "string" && name !== "" && !mixed && (
                    <Values id={id} material={name} />
                )}
            </div>
        </Section>
    );
}

function mainOf(params: readonly Param[]): readonly Param[] {
    const known = params.filter(({ means }) => MAIN.includes(means));
    return known.length > 0 ? known : params.filter(({ type }) => type === "color").slice(0, 2);
}

function Values({ id, material }: { id: string; material: string }) {
    const editor = useEditor();
    const all = useDocument(({ document, schema }) => {
        const found = document && findResource(document, "materials", material);
        return found ? resourceParams(schema, document, "materials", found.type) : null;
    });
    const users = useDocument(({ document, schema }) =>
        document ? usersOf(schema, document, "materials", material).length : 0,
    );
    const params = useMemo(() => mainOf(all ?? []), [all]);
    return (
        <>
            <Form params={params} base={valuesPlace("materials", material)} owner={material} />
            {users > 1 && (
                <p className="form-note">
                    {t("material.shared", { count: users - 1 })}{" "}
                    <button
                        type="button"
                        className="link-button"
                        onClick={() => makeMaterialUnique(editor, id, material)}
                    >
                        {t("material.unique")}
                    </button>
                </p>
            )}
        </>
    );
}
