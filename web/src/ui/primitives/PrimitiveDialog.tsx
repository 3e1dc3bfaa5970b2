/* SPDX-License-Identifier: MIT */
/* A primitive made of a node: its name, and which numbers of the subtree become parameters. The same
 * for a model that is there. */
import { useMemo, useRef, useState } from "react";
import { perform } from "../../model/actions.ts";
import { typeNaming } from "../../model/add.ts";
import {
    type Choice,
    changeParameters,
    choose,
    chosenIn,
    type Field,
    type Group,
    groupsOf,
    keyOf,
    makePrimitive,
    type Part,
    whyNotChoice,
} from "../../model/choosing.ts";
import {
    findResource,
    modelNamed,
    nodeLabel,
    type Resource,
    type SceneDocument,
} from "../../model/document.ts";
import { apply } from "../../model/operations.ts";
import { limitOf, nodeType, type Schema } from "../../model/schema.ts";
import type { View } from "../../model/view.ts";
import type { Editor } from "../editor.ts";
import { TextField } from "../fields/Text.tsx";
import { saveNodeOf } from "../library/actions.ts";
import { paramTitle } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Filter } from "../widgets/Filter.tsx";
import { Glyph } from "../widgets/Glyph.tsx";
import { FieldRow } from "./FieldRow.tsx";
import "./primitives.css";

/* A node that is to become one, or a model that is there. */
interface Subject {
    readonly top: string;
    readonly label: string;
    readonly model: Resource | null;
}

function subjectOf(
    schema: Schema,
    document: SceneDocument,
    { model: name, selection }: View,
): Subject | null {
    const node = document.nodes.get(selection.at(-1) ?? "");
    const model = name
        ? findResource(document, "models", name)
        : modelNamed(schema, document, node);
    if (model) {
        return { top: model.root, label: model.name, model };
    }
    return node ? { top: node.id, label: nodeLabel(node), model: null } : null;
}

export default function PrimitiveDialog() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "primitive");
    const first = useRef<HTMLInputElement>(null);
    /* As it was when the dialog opened: what is chosen from does not change below the hand. */
    // biome-ignore lint/correctness/useExhaustiveDependencies: read anew each time it opens
    const seen = useMemo(() => {
        const { document, schema } = stores.document.getState();
        const subject = document && subjectOf(schema, document, stores.view.getState());
        return document && subject ? { document, schema, subject } : null;
    }, [open, stores]);
    const title = seen?.subject.model
        ? t("primitive.titleOf", { name: seen.subject.label })
        : t("primitive.title", { name: seen?.subject.label ?? "" });
    return (
        <Dialog
            open={open}
            title={title}
            wide
            first={first}
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null, model: null })}
        >
            {seen && <Sheet {...seen} first={first} />}
        </Dialog>
    );
}

interface SheetProps {
    document: SceneDocument;
    schema: Schema;
    subject: Subject;
    first: React.RefObject<HTMLInputElement | null>;
}

function Sheet({ document, schema, subject, first }: SheetProps) {
    const editor = useEditor();
    const groups = useMemo(
        () => groupsOf(schema, document, subject.top),
        [schema, document, subject.top],
    );
    const [choices, setChoices] = useState<readonly Choice[]>(() =>
        subject.model ? chosenIn(subject.model) : [],
    );
    const [label, setLabel] = useState(subject.label);
    const [query, setQuery] = useState("");
    const [inScene, setInScene] = useState(true);
    const [inLibrary, setInLibrary] = useState(false);
    const most = useDocument((state) => limitOf(state.schema, "declared", 16));
    const reasons = reasonsOf(schema, groups, choices);
    const nowhere = !inScene && !inLibrary;
    const done = (): void => {
        if (finish(editor, subject, label, choices, { inScene, inLibrary })) {
            editor.stores.view.setState({ popup: null, model: null });
        }
    };
    return (
        <div className="primitive" data-testid="primitive">
            <div className="primitive-bar">
                <Filter
                    ref={first}
                    label={t("primitive.filter")}
                    value={query}
                    onChange={setQuery}
                />
                <span className="primitive-count">
                    {t("primitive.count", { count: choices.length, most })}
                </span>
            </div>
            <div className="primitive-body">
                <p className="primitive-doc">{t("primitive.doc")}</p>
                <Groups
                    groups={groups}
                    top={subject.top}
                    query={query}
                    choices={choices}
                    reasons={reasons}
                    full={choices.length >= most}
                    onChange={setChoices}
                />
            </div>
            <footer className="dialog-foot primitive-foot">
                {subject.model === null && (
                    <div className="primitive-where">
                        <span className="primitive-name">
                            <span aria-hidden="true">{t("primitive.label")}</span>
                            <TextField
                                label={t("primitive.name")}
                                value={label}
                                fallback=""
                                maxLength={56}
                                {...plainly(setLabel)}
                            />
                        </span>
                        <Check
                            title={t("primitive.inScene")}
                            checked={inScene}
                            onChange={setInScene}
                        />
                        <Check
                            title={t("primitive.inLibrary")}
                            checked={inLibrary}
                            onChange={setInLibrary}
                        />
                    </div>
                )}
                <p role="status" data-bad>
                    {nowhere && t("primitive.nowhere")}
                </p>
                <Button look="primary" disabled={nowhere || reasons.size > 0} onClick={done}>
                    {t(subject.model ? "primitive.save" : "primitive.make")}
                </Button>
            </footer>
        </div>
    );
}

const ignore = (): void => undefined;

const plainly = (take: (text: string) => void) => ({
    onInput: ignore,
    onCancel: ignore,
    onRefuse: ignore,
    onCommit: take,
});

interface CheckProps {
    title: string;
    checked: boolean;
    onChange: (checked: boolean) => void;
}

function Check({ title, checked, onChange }: CheckProps) {
    return (
        <label className="primitive-check">
            <input type="checkbox" checked={checked} onChange={() => onChange(!checked)} />
            {title}
        </label>
    );
}

interface GroupsProps {
    groups: readonly Group[];
    top: string;
    query: string;
    choices: readonly Choice[];
    reasons: ReadonlyMap<string, string>;
    full: boolean;
    onChange: (choices: readonly Choice[]) => void;
}

function Groups({ groups, top, query, choices, reasons, full, onChange }: GroupsProps) {
    const wanted = (text: string): boolean => text.toLowerCase().includes(query.toLowerCase());
    const shown = groups.flatMap((group) => {
        const all = wanted(nodeLabel(group.node));
        const fields = group.fields.filter(
            ({ param, target }) => all || wanted(paramTitle(param)) || isChosen(choices, target),
        );
        return fields.length > 0 ? [{ ...group, fields }] : [];
    });
    const change = (field: Field, choice: Choice | null): void => {
        const others = choices.filter(({ target }) => keyOf(target) !== keyOf(field.target));
        const at = choices.findIndex(({ target }) => keyOf(target) === keyOf(field.target));
        onChange(
            choice === null
                ? others
                : at < 0
                  ? [...choices, choice]
                  : choices.map((one, i) => (i === at ? choice : one)),
        );
    };
    if (shown.length === 0) {
        return <p className="empty-note">{t("primitive.nothing")}</p>;
    }
    return shown.map(({ node, fields }) => (
        <fieldset key={node.id} className="primitive-group">
            <legend>
                <TypeGlyph type={node.type} />
                <span className="ellipsis">{nodeLabel(node)}</span>
            </legend>
            {fields.map((field) => {
                const key = keyOf(field.target);
                const choice = choices.find(({ target }) => keyOf(target) === key) ?? null;
                const taken = choices.filter((one) => one !== choice).map(({ name }) => name);
                const title = paramTitle(field.param);
                const called = node.id === top ? title : `${nodeLabel(node)} ${title}`;
                const pick = (part: Part): Choice => choose(field, part, called, taken);
                return (
                    <FieldRow
                        key={key}
                        field={field}
                        owner={nodeLabel(node)}
                        choice={choice}
                        reason={reasons.get(key) ?? null}
                        full={full}
                        pick={pick}
                        onChange={(next) => change(field, next)}
                    />
                );
            })}
        </fieldset>
    ));
}

const isChosen = (choices: readonly Choice[], of: Field["target"]): boolean =>
    choices.some(({ target }) => keyOf(target) === keyOf(of));

function TypeGlyph({ type }: { type: string }) {
    const group = useDocument((state) => nodeType(state.schema, type)?.group);
    return <Glyph type={type} group={group} size={14} />;
}

/* By the key of the field. */
function reasonsOf(
    schema: Schema,
    groups: readonly Group[],
    choices: readonly Choice[],
): ReadonlyMap<string, string> {
    const reserved = typeNaming(schema, "model")?.params.map(({ name }) => name) ?? [];
    const fields = new Map(
        groups.flatMap(({ fields: inner }) => inner.map((one) => [keyOf(one.target), one])),
    );
    const reasons = new Map<string, string>();
    for (const choice of choices) {
        const key = keyOf(choice.target);
        const field = fields.get(key);
        const others = choices.filter((one) => one !== choice).map(({ name }) => name);
        const reason = field && whyNotChoice(choice, field, [...others, ...reserved]);
        if (reason) {
            reasons.set(key, reason);
        }
    }
    return reasons;
}

interface Where {
    inScene: boolean;
    inLibrary: boolean;
}

/* Against the scene as it is by now. False: the edit was refused. */
function finish(
    editor: Editor,
    { top, model }: Subject,
    label: string,
    choices: readonly Choice[],
    { inScene, inLibrary }: Where,
): boolean {
    const { document, schema } = editor.stores.document.getState();
    const now = model && document && findResource(document, "models", model.name);
    const edit =
        document &&
        (model
            ? now && changeParameters(document, schema, now, choices)
            : makePrimitive(document, schema, top, label, choices));
    if (!document || !edit) {
        return false;
    }
    if (model) {
        return editor.edit(edit.ops, { label: edit.label });
    }
    const made = apply(document, edit.ops, schema);
    if (inLibrary && made.ok) {
        saveNodeOf(editor, made.document, edit.select[0] ?? "", label);
    }
    return !inScene || perform(editor, edit);
}
