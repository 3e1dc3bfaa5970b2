/* SPDX-License-Identifier: MIT */
/* The forms of a material or a light. */
import { useMemo, useState } from "react";
import { findResource, type ListName, materialUsers, resourceType } from "../../model/document.ts";
import { renameResource, whyNotName } from "../acts.ts";
import { TextField } from "../fields/Text.tsx";
import { Form } from "../form.tsx";
import { typeTitle } from "../names.ts";
import { type Option, Select } from "../parts/Select.tsx";
import { Swatch } from "../parts/Swatch.tsx";
import { LightIcon } from "../scene/Resources.tsx";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Nothing } from "./Inspector.tsx";
import { Section } from "./Section.tsx";
import "./inspector.css";

const ignore = (): void => undefined;

export function ResourceInspector({ list, name }: { list: ListName; name: string }) {
    const type = useDocument((state) =>
        state.document ? (findResource(state.document, list, name)?.type ?? null) : null,
    );
    const row = useDocument((state) => resourceType(state.schema, list, type ?? ""));
    if (type === null) {
        return <Nothing />;
    }
    const base = list === "lights" ? `/lights/${name}` : `/materials/${name}/properties`;
    return (
        <div className="panel-scroll" data-testid="inspector">
            <Head list={list} name={name} type={type} doc={row?.doc ?? ""} />
            <Section title={t(list === "lights" ? "inspector.light" : "inspector.material")}>
                <div className="section-body">
                    {row && <Form params={row.params} base={base} owner={name} />}
                </div>
            </Section>
        </div>
    );
}

interface HeadProps {
    list: ListName;
    name: string;
    type: string;
    doc: string;
}

function Head({ list, name, type, doc }: HeadProps) {
    const editor = useEditor();
    const [refused, setRefused] = useState<string | null>(null);
    const users = useDocument((state) =>
        state.document && list === "materials" ? materialUsers(state.document, name).length : 0,
    );
    const types = useDocument((state) => state.schema[list === "lights" ? "lights" : "shaders"]);
    const options = useMemo<Option[]>(
        () => types.map((row) => ({ value: row.type, label: typeTitle(row.type) })),
        [types],
    );
    const rename = (text: string): void => {
        const { document } = editor.stores.document.getState();
        const resource = document && findResource(document, list, name);
        const reason = whyNotName(editor, list, text);
        setRefused(reason);
        if (resource && reason === null) {
            renameResource(editor, list, resource, text);
        }
    };
    const place = list === "lights" ? `/lights/${name}/type` : `/materials/${name}/shader`;
    return (
        <header className="inspector-head">
            <span className="inspector-badge">
                {list === "lights" ? <LightIcon type={type} size={18} /> : <Swatch name={name} />}
            </span>
            <div className="inspector-name">
                <TextField
                    label={t("inspector.name")}
                    value={name}
                    fallback=""
                    maxLength={64}
                    onInput={ignore}
                    onCancel={ignore}
                    onRefuse={ignore}
                    onCommit={rename}
                />
                <div className="inspector-sub">
                    <Select
                        quiet
                        value={type}
                        label={t(list === "lights" ? "inspector.type" : "inspector.shader")}
                        options={options}
                        onChange={(value) =>
                            editor.link.edit([{ op: "set", at: place, value }], {
                                label: t("edit.set", { owner: name, name: t("inspector.type") }),
                            })
                        }
                    />
                </div>
            </div>
            {refused && (
                <p className="form-error" role="alert">
                    {refused}
                </p>
            )}
            {doc && <p className="inspector-doc">{doc}</p>}
            {list === "materials" && (
                <p className="form-note">
                    {users === 0 ? t("inspector.unused") : t("inspector.usedBy", { count: users })}
                </p>
            )}
        </header>
    );
}
