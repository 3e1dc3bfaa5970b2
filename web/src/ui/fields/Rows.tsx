/* SPDX-License-Identifier: MIT */
/* The parameters that a distance function or a shader declares: name, type, default, range, help;
 * in their order. A new name keeps the values of all users, and the code follows. */
import {
    ArrowDown,
    ArrowUp,
    ChevronRight,
    Ellipsis,
    Plus,
    SlidersHorizontal,
    Trash2,
} from "lucide-react";
import { type ReactNode, useId, useState } from "react";
import { typeNaming } from "../../model/add.ts";
import { declaredParams, mayHaveRange, whyNotIdentifier } from "../../model/declaredParams.ts";
import { findResource } from "../../model/document.ts";
import { resourceOfPlace } from "../../model/places.ts";
import { renameDeclared } from "../../model/resources.ts";
import { type DeclaredRow, limitOf, type Param } from "../../model/schema.ts";
import { checkValue } from "../../model/values.ts";
import { placeTitle, words } from "../names.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { Select } from "../widgets/Select.tsx";
import { NumberField } from "./Number.tsx";
import { TextField } from "./Text.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

type MakeField = (param: Param, props: FieldProps<never>, place: string) => ReactNode;

interface Props extends FieldProps<readonly DeclaredRow[]> {
    place: string;
    /* The form's table: a default is entered like a value. */
    fieldFor: (type: string) => MakeField;
}

const ignore = (): void => undefined;

export default function RowsField(props: Props) {
    const owner = resourceOfPlace(props.place);
    return owner?.list === "models" ? (
        <Settings model={owner.name} rows={props.value} label={props.label} />
    ) : (
        <Declared {...props} />
    );
}

function Declared(props: Props) {
    const { label, value: rows, place, describedBy, onCommit, onRefuse } = props;
    const { link, stores } = useEditor();
    const schema = useDocument((state) => state.schema);
    const most = limitOf(schema, "declared", 16);
    const owner = resourceOfPlace(place);
    const reserved =
        owner?.list === "primitives"
            ? (typeNaming(schema, "function")?.params.map(({ name }) => name) ?? [])
            : [];
    const replaced = (index: number, row: DeclaredRow | null): DeclaredRow[] =>
        rows.flatMap((old, i) => (i !== index ? [old] : row === null ? [] : [row]));
    const rename = (index: number, name: string): void => {
        const from = rows[index];
        const others = rows.filter((_, i) => i !== index).map((row) => row.name);
        const reason = whyNotIdentifier(name, [...others, ...reserved]);
        onRefuse(reason);
        const { document } = stores.document.getState();
        const list = owner?.list === "shaders" ? "shaders" : "primitives";
        const resource = document && owner && findResource(document, list, owner.name);
        if (reason === null && from && resource) {
            const next = replaced(index, { ...from, name });
            const ops = renameDeclared(document, schema, list, resource, next, from.name, name);
            link.edit(ops, { label: t("edit.rename", { name: from.name }) });
        }
    };
    const move = (index: number, by: -1 | 1): void => {
        const row = rows[index];
        if (row) {
            const others = rows.filter((_, i) => i !== index);
            onCommit([...others.slice(0, index + by), row, ...others.slice(index + by)]);
        }
    };
    const add = (): void => {
        const taken = [...rows.map((row) => row.name), ...reserved];
        let n = 1;
        while (taken.includes(`value${n}`)) {
            n++;
        }
        onCommit([...rows, { name: `value${n}`, type: "float" }]);
    };
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="rows" role="group" aria-label={label} aria-describedby={describedBy}>
            {rows.map((row, index) => (
                <Row
                    key={row.name}
                    row={row}
                    types={schema.declared}
                    first={index === 0}
                    last={index === rows.length - 1}
                    fieldFor={props.fieldFor}
                    onRename={(name) => rename(index, name)}
                    onInput={(next) => props.onInput(replaced(index, next))}
                    onCommit={(next) => onCommit(replaced(index, next))}
                    onMove={(by) => move(index, by)}
                    onRemove={() => onCommit(replaced(index, null))}
                    onCancel={props.onCancel}
                    onRefuse={onRefuse}
                />
            ))}
            <Button
                look="outline"
                icon={<Plus size={14} aria-hidden="true" />}
                disabled={rows.length >= most}
                onClick={add}
            >
                {t(owner?.list === "shaders" ? "rows.addProperty" : "rows.add")}
            </Button>
        </div>
    );
}

/* What instances of a model may have of their own, and the way to change that. */
function Settings({ model, rows, label }: SettingsProps) {
    const { stores } = useEditor();
    const titles = useDocument(({ document }) =>
        rows.map(({ sets }) => placeTitle(document, sets ?? "")).join("\n"),
    ).split("\n");
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="rows" role="group" aria-label={label}>
            {rows.length === 0 && <p className="settings-none">{t("primitive.empty")}</p>}
            {rows.map((row, i) => (
                <div key={row.name} className="row settings-row">
                    <span className="settings-name ellipsis">{words(row.name)}</span>
                    <span className="settings-of ellipsis">{titles[i]}</span>
                </div>
            ))}
            <Button
                look="outline"
                icon={<SlidersHorizontal size={14} aria-hidden="true" />}
                onClick={() => stores.view.setState({ popup: "primitive", model })}
            >
                {t("primitive.choose.all")}
            </Button>
        </div>
    );
}

interface SettingsProps {
    model: string;
    rows: readonly DeclaredRow[];
    label: string;
}

interface RowProps {
    row: DeclaredRow;
    types: readonly string[];
    first: boolean;
    last: boolean;
    fieldFor: (type: string) => MakeField;
    onRename: (name: string) => void;
    onInput: (row: DeclaredRow) => void;
    onCommit: (row: DeclaredRow) => void;
    onMove: (by: -1 | 1) => void;
    onRemove: () => void;
    onCancel: () => void;
    onRefuse: (message: string | null) => void;
}

/* What of a row another type can keep. */
function retyped(row: DeclaredRow, type: string): DeclaredRow {
    const { default: old, range, ...rest } = row;
    const whole = type !== "int" || (range?.every(Number.isInteger) ?? true);
    const kept: DeclaredRow = {
        ...rest,
        type,
        ...(range && mayHaveRange(type) && whole ? { range } : {}),
    };
    const [param] = declaredParams([kept]);
    const fits = old !== undefined && param && checkValue(param, old as never) === null;
    return fits ? { ...kept, default: old } : kept;
}

function Row(props: RowProps) {
    const { row, types, first, last, onCommit, onMove } = props;
    const [open, setOpen] = useState(false);
    const id = useId();
    const { name } = row;
    return (
        <div className="row" data-row={name}>
            <div className="row-head">
                <button
                    type="button"
                    className="row-twist"
                    aria-label={t("rows.more", { name })}
                    aria-expanded={open}
                    aria-controls={id}
                    onClick={() => setOpen(!open)}
                >
                    <ChevronRight size={13} />
                </button>
                <TextField
                    label={t("rows.name", { name })}
                    value={name}
                    fallback=""
                    maxLength={64}
                    onInput={ignore}
                    onCancel={ignore}
                    onRefuse={ignore}
                    onCommit={props.onRename}
                />
                <Select
                    value={row.type}
                    label={t("rows.type", { name })}
                    options={types.map((type) => ({ value: type, label: type }))}
                    onChange={(type) => onCommit(retyped(row, type))}
                />
                <Menu
                    align="end"
                    trigger={
                        <IconButton title={t("resource.more", { name })} data-size="s">
                            <Ellipsis size={14} />
                        </IconButton>
                    }
                >
                    <MenuItem
                        icon={<ArrowUp size={14} />}
                        disabled={first}
                        onSelect={() => onMove(-1)}
                    >
                        {t("rows.up")}
                    </MenuItem>
                    <MenuItem
                        icon={<ArrowDown size={14} />}
                        disabled={last}
                        onSelect={() => onMove(1)}
                    >
                        {t("rows.down")}
                    </MenuItem>
                    <MenuLine />
                    <MenuItem icon={<Trash2 size={14} />} danger onSelect={props.onRemove}>
                        {t("resource.remove")}
                    </MenuItem>
                </Menu>
            </div>
            <div className="row-body" id={id} hidden={!open}>
                {open && <Details {...props} />}
            </div>
        </div>
    );
}

function Details({ row, fieldFor, onInput, onCommit, onCancel, onRefuse }: RowProps) {
    const [param] = declaredParams([row]);
    if (!param) {
        return null;
    }
    const common = { onCancel, onRefuse };
    const withDefault = (value: unknown): DeclaredRow => ({ ...row, default: value as never });
    return (
        <>
            <div className="row-line">
                <span>{t("rows.default")}</span>
                <div className="form-field">
                    {fieldFor(param.type)(
                        param,
                        {
                            ...common,
                            label: t("rows.defaultOf", { name: row.name }),
                            value: param.default as never,
                            fallback: param.default as never,
                            onInput: (value: never) => onInput(withDefault(value)),
                            onCommit: (value: never) => onCommit(withDefault(value)),
                        },
                        "",
                    )}
                </div>
            </div>
            {mayHaveRange(row.type) && (
                <div className="row-line">
                    <span>{t("rows.range")}</span>
                    <Range row={row} onCommit={onCommit} onRefuse={onRefuse} />
                </div>
            )}
            <div className="row-line">
                <span>{t("rows.doc")}</span>
                <TextField
                    {...common}
                    label={t("rows.docOf", { name: row.name })}
                    value={row.doc ?? ""}
                    fallback=""
                    onInput={ignore}
                    onCommit={(doc) => {
                        const { doc: _old, ...rest } = row;
                        onCommit(doc === "" ? rest : { ...rest, doc });
                    }}
                />
            </div>
        </>
    );
}

type RangeProps = Pick<RowProps, "row" | "onCommit" | "onRefuse">;

/* A range is two numbers or none. The default is kept inside. */
function Range({ row, onCommit, onRefuse }: RangeProps) {
    const { range, default: old, ...rest } = row;
    const [param] = declaredParams([{ ...rest }]);
    if (!range || !param) {
        return (
            <Button
                className="row-range"
                onClick={() => onCommit(clamped({ ...row, range: [0, 1] }))}
            >
                {t("rows.addRange")}
            </Button>
        );
    }
    const ends = [
        { title: t("rows.from", { name: row.name }), at: 0 },
        { title: t("rows.to", { name: row.name }), at: 1 },
    ];
    const put = (at: number, x: number): void => {
        const next: [number, number] = at === 0 ? [x, range[1]] : [range[0], x];
        const reason = next[0] < next[1] ? null : t("rows.badRange");
        onRefuse(reason);
        if (reason === null) {
            onCommit(clamped({ ...row, range: next }));
        }
    };
    return (
        <div className="form-field">
            {ends.map(({ title, at }) => (
                <NumberField
                    key={at}
                    param={{ ...param, type: row.type === "int" ? "int" : "float" }}
                    label={title}
                    value={range[at] ?? 0}
                    fallback={at}
                    onInput={ignore}
                    onCommit={(x) => put(at, x)}
                    onCancel={ignore}
                    onRefuse={onRefuse}
                />
            ))}
            <IconButton
                title={t("rows.noRange")}
                data-size="s"
                onClick={() => onCommit(old === undefined ? rest : { ...rest, default: old })}
            >
                <Trash2 size={13} />
            </IconButton>
        </div>
    );
}

function clamped(row: DeclaredRow): DeclaredRow {
    const [low, high] = row.range ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
    const inside = (x: number): number => Math.min(high, Math.max(low, x));
    const { default: old } = row;
    if (typeof old === "number") {
        return { ...row, default: inside(old) };
    }
    return Array.isArray(old) ? { ...row, default: old.map((x) => inside(Number(x))) } : row;
}
