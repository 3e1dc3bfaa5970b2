/* SPDX-License-Identifier: MIT */
/* The forms of a node: its own parameters, where it stands, what it is made of. */
import { useMemo } from "react";
import { nodeLabel } from "../../model/document.ts";
import { rename } from "../../model/edits.ts";
import { findParam, nodeType } from "../../model/schema.ts";
import { TextField } from "../fields/Text.tsx";
import { Form } from "../form.tsx";
import { typeTitle } from "../names.ts";
import { Glyph } from "../parts/Glyph.tsx";
import { type Option, Select } from "../parts/Select.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { Nothing } from "./Inspector.tsx";
import { Section } from "./Section.tsx";
import "./inspector.css";

const ignore = (): void => undefined;

export function NodeInspector({ id }: { id: string }) {
    const type = useDocument((state) => state.document?.nodes.get(id)?.type ?? null);
    const label = useDocument((state) => {
        const node = state.document?.nodes.get(id);
        return node ? nodeLabel(node) : id;
    });
    const row = useDocument((state) => nodeType(state.schema, type ?? ""));
    const transform = useDocument((state) => state.schema.transform);
    const common = useDocument((state) => state.schema.node);
    const selected = useView((view) => view.selection.length);
    const surface = useMemo(() => {
        const material = findParam(common, "material");
        return material ? [material] : [];
    }, [common]);
    if (type === null) {
        return <Nothing />;
    }
    const group = row?.group ?? "structure";
    return (
        <div className="panel-scroll" data-testid="inspector">
            <Head id={id} type={type} label={label} />
            {selected > 1 && (
                <p className="empty-note">{t("inspector.many", { count: selected })}</p>
            )}
            {row && row.params.length > 0 && (
                <Section title={t(`inspector.${group}` as TextKey)}>
                    <div className="section-body">
                        <Form params={row.params} base={`/nodes/${id}/params`} owner={label} />
                    </div>
                </Section>
            )}
            <Section title={t("inspector.place")}>
                <div className="section-body">
                    <Form params={transform} base={`/nodes/${id}/transform`} owner={label} />
                </div>
            </Section>
            <Section title={t("inspector.surface")}>
                <div className="section-body">
                    <Form params={surface} base={`/nodes/${id}`} owner={label} />
                </div>
            </Section>
        </div>
    );
}

function Head({ id, type, label }: { id: string; type: string; label: string }) {
    const { link, stores } = useEditor();
    const name = useDocument((state) => state.document?.nodes.get(id)?.common.name);
    const problem = useDocument((state) => state.problems.get(id));
    const row = useDocument((state) => nodeType(state.schema, type));
    const send = (text: string): void => {
        const { document } = stores.document.getState();
        if (document) {
            const edit = rename(document, id, text);
            link.edit(edit.ops, { label: edit.label });
        }
    };
    return (
        <header className="inspector-head">
            <span className="inspector-badge">
                <Glyph type={type} group={row?.group} size={22} />
            </span>
            <div className="inspector-name">
                <TextField
                    label={t("inspector.name")}
                    value={typeof name === "string" ? name : ""}
                    fallback=""
                    placeholder={label}
                    maxLength={200}
                    onInput={ignore}
                    onCancel={ignore}
                    onRefuse={ignore}
                    onCommit={send}
                />
                <div className="inspector-sub">
                    <TypeSelect id={id} type={type} />
                </div>
            </div>
            {row?.doc && <p className="inspector-doc">{row.doc}</p>}
            {problem && (
                <p className="form-error" role="alert">
                    {problem.message}
                </p>
            )}
        </header>
    );
}

/* A node can become another type of its group; what both know is kept. */
function TypeSelect({ id, type }: { id: string; type: string }) {
    const { link } = useEditor();
    const types = useDocument((state) => state.schema.nodes);
    const options = useMemo<Option[]>(() => {
        const group = types.find((row) => row.type === type)?.group;
        return types
            .filter((row) => row.group === group)
            .map((row) => ({
                value: row.type,
                label: typeTitle(row.type),
                icon: <Glyph type={row.type} group={row.group} />,
            }));
    }, [types, type]);
    return (
        <Select
            quiet
            value={type}
            label={t("inspector.type")}
            options={options}
            onChange={(value) =>
                link.edit([{ op: "set", at: `/nodes/${id}/type`, value }], {
                    label: t("edit.set", { owner: id, name: t("inspector.type") }),
                })
            }
        />
    );
}
