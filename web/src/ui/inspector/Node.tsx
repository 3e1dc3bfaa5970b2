/* SPDX-License-Identifier: MIT */
/* The forms of a node: its own parameters, where it stands, what it is made of. */
import { CircleQuestionMark } from "lucide-react";
import { useMemo } from "react";
import {
    functionOf,
    modelNamed,
    modelOf,
    nodeLabel,
    nodeParams,
    shownParams,
} from "../../model/document.ts";
import { rename } from "../../model/edits.ts";
import { nodeType, type Param } from "../../model/schema.ts";
import { usersOf } from "../../model/usage.ts";
import { TextField } from "../fields/Text.tsx";
import { Form } from "../form.tsx";
import { selectNode } from "../insertions.ts";
import { CommandButton } from "../layout/Act.tsx";
import { typeTitle } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Glyph } from "../widgets/Glyph.tsx";
import { type Option, Select } from "../widgets/Select.tsx";
import { Thumbnail } from "../widgets/Thumbnail.tsx";
import { Nothing } from "./Inspector.tsx";
import { Section } from "./Section.tsx";
import { Surface } from "./Surface.tsx";
import "./inspector.css";

const ignore = (): void => undefined;

export default function NodeInspector({ id }: { id: string }) {
    const type = useDocument((state) => state.document?.nodes.get(id)?.type ?? null);
    const label = useDocument((state) => {
        const node = state.document?.nodes.get(id);
        return node ? nodeLabel(node) : id;
    });
    const group = useDocument((state) => nodeType(state.schema, type ?? "")?.group ?? "structure");
    const params = useParams(id);
    const transform = useDocument((state) => state.schema.transform);
    const selected = useView((view) => view.selection.length);
    if (type === null) {
        return <Nothing />;
    }
    return (
        <div className="panel-scroll" data-testid="inspector">
            {selected > 1 ? <Several /> : <Head id={id} type={type} label={label} />}
            {params.length > 0 && (
                <Section title={t(`inspector.${group}` as TextKey)}>
                    <div className="section-body">
                        <Form params={params} base={`/nodes/${id}/params`} owner={label} />
                        <InstanceActs id={id} />
                    </div>
                </Section>
            )}
            <Section title={t("inspector.place")}>
                <div className="section-body">
                    <Form params={transform} base={`/nodes/${id}/transform`} owner={label} />
                </div>
            </Section>
            <Surface id={id} owner={label} />
        </div>
    );
}

const NO_PARAMS: readonly Param[] = [];

/* The rows of all types and of all that the document declares; they change seldom. */
function useParams(id: string): readonly Param[] {
    const schema = useDocument((state) => state.schema);
    const all = useDocument(({ document }) => {
        const node = document?.nodes.get(id);
        return document && node ? nodeParams(schema, document, node) : NO_PARAMS;
    });
    const named = useDocument(({ document }) => {
        const node = document?.nodes.get(id);
        return (document && node && functionOf(schema, document, node)?.name) ?? null;
    });
    const { stores } = useEditor();
    // biome-ignore lint/correctness/useExhaustiveDependencies: what is shown follows from these
    return useMemo(() => {
        const { document } = stores.document.getState();
        const node = document?.nodes.get(id);
        return document && node ? shownParams(schema, document, node) : NO_PARAMS;
    }, [all, named, schema, id]);
}

/* What can be done with an instance of a model. */
function InstanceActs({ id }: { id: string }) {
    const instance = useDocument(
        ({ document, schema }) =>
            document !== null && modelNamed(schema, document, document.nodes.get(id)) !== null,
    );
    if (!instance) {
        return null;
    }
    return (
        <div className="form-acts">
            <CommandButton id="model.edit" />
            <CommandButton id="model.parameters" />
            <CommandButton id="model.unpack" />
        </div>
    );
}

const MOST_NAMED = 8;

/* How many nodes are selected, which, and what a change does. Each name is a way to it alone. */
function Several() {
    const editor = useEditor();
    const selection = useView((view) => view.selection);
    /* A text, so that numbers that change do not draw the list anew. */
    const text = useDocument(({ document }) =>
        JSON.stringify(
            selection.flatMap((id) => {
                const node = document?.nodes.get(id);
                return node ? [[id, nodeLabel(node), node.type]] : [];
            }),
        ),
    );
    const nodes = useMemo(() => JSON.parse(text) as [string, string, string][], [text]);
    const count = nodes.length;
    return (
        <header className="inspector-head">
            <h2 className="inspector-title">{t("inspector.several", { count })}</h2>
            <div className="user-list inspector-several">
                {nodes.slice(0, MOST_NAMED).map(([id, label, type]) => (
                    <Button
                        key={id}
                        look="outline"
                        icon={<TypeGlyph type={type} />}
                        onClick={() => selectNode(editor, id)}
                    >
                        {label}
                    </Button>
                ))}
                {count > MOST_NAMED && (
                    <span>{t("inspector.more", { count: count - MOST_NAMED })}</span>
                )}
            </div>
            <p className="inspector-doc">{t("inspector.many")}</p>
        </header>
    );
}

function TypeGlyph({ type }: { type: string }) {
    const group = useDocument((state) => nodeType(state.schema, type)?.group);
    return <Glyph type={type} group={group} size={14} />;
}

function Head({ id, type, label }: { id: string; type: string; label: string }) {
    const { link, stores } = useEditor();
    const name = useDocument((state) => state.document?.nodes.get(id)?.common.name);
    const problem = useDocument(({ problems }) => {
        const found = problems.get(`/nodes/${id}`) ?? problems.get(`/nodes/${id}/type`);
        return found?.message ?? null;
    });
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
                <Thumbnail id={id} className="inspector-thumbnail">
                    <Glyph type={type} group={row?.group} size={22} />
                </Thumbnail>
            </span>
            <div className="inspector-name">
                <TextField
                    label={t("inspector.name")}
                    value={typeof name === "string" ? name : ""}
                    fallback=""
                    placeholder={label}
                    onInput={ignore}
                    onCancel={ignore}
                    onRefuse={ignore}
                    onCommit={send}
                />
                <div className="inspector-sub">
                    <TypeSelect id={id} type={type} />
                    <IconButton
                        title={t("reference.about", { name: typeTitle(type) })}
                        data-size="s"
                        onClick={() => stores.view.setState({ popup: "reference", topic: type })}
                    >
                        <CircleQuestionMark size={14} />
                    </IconButton>
                </div>
            </div>
            {row?.doc && <p className="inspector-doc">{row.doc}</p>}
            <PartOf id={id} />
            {problem && (
                <p className="form-error" role="alert">
                    {problem}
                </p>
            )}
        </header>
    );
}

/* That a change here changes every instance of a model. */
function PartOf({ id }: { id: string }) {
    const editor = useEditor();
    const model = useDocument(({ document }) => document && (modelOf(document, id)?.name ?? null));
    const count = useDocument(({ document, schema }) =>
        document && model !== null ? usersOf(schema, document, "models", model).length : 0,
    );
    if (model === null) {
        return null;
    }
    return (
        <p className="inspector-doc part-of">
            <button
                type="button"
                className="link-button"
                onClick={() => editor.show({ kind: "resource", list: "models", name: model })}
            >
                {t("inspector.partOf", { name: model })}
            </button>{" "}
            {t(count === 0 ? "inspector.noInstance" : "inspector.instances", { count })}
        </p>
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
