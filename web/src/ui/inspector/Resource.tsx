/* SPDX-License-Identifier: MIT */
/* The forms of a resource: a material, a light or a volume with its values, a distance function or
 * a shader with what it declares and its code, a model. */
import { useMemo, useState } from "react";
import {
    findResource,
    nodeLabel,
    resourceParams,
    type SceneDocument,
    typesOf,
} from "../../model/document.ts";
import { LISTS, type ListName, resourcePlace, valuesPlace } from "../../model/places.ts";
import { problemIn } from "../../model/problems.ts";
import { changeShader } from "../../model/shading.ts";
import { addNotice } from "../../model/stores.ts";
import { type User, usersOf } from "../../model/usage.ts";
import { TextField } from "../fields/Text.tsx";
import { Form } from "../form.tsx";
import { addInstance, rename, selectNode, whyNotName } from "../insertions.ts";
import { typeTitle, words } from "../names.ts";
import { ResourceIcon } from "../scene/ResourceIcon.tsx";
import { ResourceMenu } from "../scene/ResourceMenu.tsx";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { type Option, Select } from "../widgets/Select.tsx";
import { Nothing } from "./Inspector.tsx";
import { Section } from "./Section.tsx";
import "./inspector.css";

const ignore = (): void => undefined;

interface Props {
    list: ListName;
    name: string;
}

export default function ResourceInspector({ list, name }: Props) {
    const type = useDocument(({ document }) =>
        document ? (findResource(document, list, name)?.type ?? null) : null,
    );
    const params = useDocument(({ document, schema }) =>
        document && type !== null ? resourceParams(schema, document, list, type) : null,
    );
    if (type === null || params === null) {
        return <Nothing />;
    }
    return (
        <div className="panel-scroll" data-testid="inspector">
            <Head list={list} name={name} type={type} />
            <Acts list={list} name={name} />
            {params.length > 0 && (
                <Section title={t(`${list}.values`)}>
                    <div className="section-body">
                        <Form params={params} base={valuesPlace(list, name)} owner={name} />
                    </div>
                </Section>
            )}
            {!LISTS[list].id && <Users list={list} name={name} />}
        </div>
    );
}

function Head({ list, name, type }: Props & { type: string }) {
    const editor = useEditor();
    const [refused, setRefused] = useState<string | null>(null);
    const resource = useDocument(({ document }) => document && findResource(document, list, name));
    const doc = useDocument(({ schema }) => {
        const row = typesOf(schema, list).find((one) => one.type === type);
        return row?.doc ?? t(`${list}.doc`);
    });
    const problem = useDocument(({ problems }) => {
        const found = problemIn(problems, resourcePlace(list, name));
        return found?.place === resourcePlace(list, name) ? found.message : null;
    });
    const change = (text: string): void => {
        const reason = whyNotName(editor, list, text);
        setRefused(reason);
        if (resource && reason === null) {
            rename(editor, list, resource, text);
        }
    };
    return (
        <header className="inspector-head">
            <span className="inspector-badge">
                <ResourceIcon list={list} name={name} size={18} />
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
                    onCommit={change}
                />
                <div className="inspector-sub">
                    {LISTS[list].type === null ? (
                        <span className="only-choice">{typeTitle(LISTS[list].one)}</span>
                    ) : (
                        <TypeSelect list={list} name={name} type={type} />
                    )}
                </div>
            </div>
            {resource && (
                <ResourceMenu title={t("inspector.acts")} list={list} resource={resource} />
            )}
            {(refused ?? problem) && (
                <p className="form-error" role="alert">
                    {refused ?? problem}
                </p>
            )}
            <p className="inspector-doc">{doc}</p>
        </header>
    );
}

/* What it is made for, in sight. */
function Acts({ list, name }: Props) {
    const editor = useEditor();
    const root = useDocument(({ document }) =>
        list === "models" && document ? (findResource(document, list, name)?.root ?? "") : "",
    );
    if (list !== "models" && list !== "primitives" && list !== "shaders") {
        return null;
    }
    return (
        <div className="inspector-acts">
            {root !== "" && (
                <Button look="outline" onClick={() => selectNode(editor, root)}>
                    {t("models.parts")}
                </Button>
            )}
            <Button look="outline" onClick={() => addInstance(editor, list, name)}>
                {t(`${list}.instance`)}
            </Button>
        </div>
    );
}

/* A material's shader may be one of the document's; those come last. */
function TypeSelect({ list, name, type }: Props & { type: string }) {
    const { link, stores } = useEditor();
    const rows = useDocument(({ schema }) => typesOf(schema, list));
    const own = useDocument((state) => (list === "materials" ? state.document?.shaders : null));
    const options = useMemo<Option[]>(
        () => [
            ...rows.map((row) => ({ value: row.type, label: typeTitle(row.type) })),
            ...(own ?? []).map((shader) => ({ value: shader.name, label: shader.name })),
        ],
        [rows, own],
    );
    const place = `${resourcePlace(list, name)}/${LISTS[list].type}`;
    const label = t("edit.set", { owner: name, name: t("inspector.type") });
    const change = (value: string): void => {
        link.edit([{ op: "set", at: place, value }], { label });
    };
    const shade = (value: string): void => {
        const { document, schema } = stores.document.getState();
        const changed = document && changeShader(document, schema, name, value);
        if (changed && link.edit(changed.ops, { label }) && changed.lost.length > 0) {
            const lost = changed.lost.map(words).join(", ");
            const message = t("material.lost", { shader: typeTitle(value), lost });
            const acts = [{ kind: "undo", label } as const];
            addNotice(stores.notices, { level: "info", code: "lost", message, acts });
        }
    };
    return (
        <Select
            quiet
            value={type}
            label={t(list === "materials" ? "inspector.shader" : "inspector.type")}
            options={options}
            onChange={list === "materials" ? shade : change}
        />
    );
}

const MOST_USERS = 8;

interface LabelledUser extends User {
    label: string;
}

function labelled(document: SceneDocument, users: readonly User[]): LabelledUser[] {
    return users.map((user) => {
        const node = user.kind === "node" ? document.nodes.get(user.name) : undefined;
        return { ...user, label: node ? nodeLabel(node) : user.name };
    });
}

/* Who names it, each a way there. */
function Users({ list, name }: Props) {
    const editor = useEditor();
    /* A text, so that numbers that change do not draw the list anew. */
    const text = useDocument(({ document, schema }) =>
        JSON.stringify(document ? labelled(document, usersOf(schema, document, list, name)) : []),
    );
    const users = useMemo(() => JSON.parse(text) as LabelledUser[], [text]);
    const count = users.length;
    return (
        <Section title={t("inspector.users")} count={count}>
            {count === 0 && <p className="empty-note">{t("inspector.unused")}</p>}
            <div className="user-list">
                {users.slice(0, MOST_USERS).map((user, i) => (
                    <Button
                        // biome-ignore lint/suspicious/noArrayIndexKey: one may name it twice
                        key={`${user.name}-${i}`}
                        look="outline"
                        onClick={() =>
                            user.kind === "node"
                                ? selectNode(editor, user.name)
                                : editor.show({
                                      kind: "resource",
                                      list: "materials",
                                      name: user.name,
                                  })
                        }
                    >
                        {user.label}
                    </Button>
                ))}
                {count > MOST_USERS && (
                    <span>{t("inspector.more", { count: count - MOST_USERS })}</span>
                )}
            </div>
        </Section>
    );
}
