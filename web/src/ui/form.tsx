/* SPDX-License-Identifier: MIT */
/* Forms from the schema: one row of a table becomes one labelled field. The only place that knows
 * which field a type gets; a type it does not know gets checked JSON, never nothing. */
import { Fragment, memo, type ReactNode, useEffect, useId, useRef, useState } from "react";
import type { Gesture } from "../link/link.ts";
import { paramAt, type SceneDocument } from "../model/document.ts";
import { equalJson } from "../model/json.ts";
import { type Change, mixedAt, multiEdit, type Revision } from "../model/multiEdit.ts";
import type { Operation } from "../model/operation.ts";
import { problemIn } from "../model/problems.ts";
import {
    type DeclaredRow,
    grouped,
    matters,
    type Param,
    type Value,
    valueIn,
} from "../model/schema.ts";
import type { SurfaceRevision, SurfaceValue } from "../model/surface.ts";
import { CodeField } from "./fields/Code.tsx";
import { EnumField } from "./fields/Enum.tsx";
import { EquationField } from "./fields/Equation.tsx";
import { FlagField, FlagsField } from "./fields/Flag.tsx";
import { JsonField } from "./fields/Json.tsx";
import { NumberField } from "./fields/Number.tsx";
import { ReferenceField } from "./fields/Reference.tsx";
import { TextField } from "./fields/Text.tsx";
import type { FieldProps } from "./fields/types.ts";
import { VectorField } from "./fields/Vector.tsx";
import { lazyPart } from "./lazy.tsx";
import { isLetter, paramTitle, shortTitle, words } from "./names.ts";
import { useDocument, useEditor, useView } from "./state.ts";
import { sentence, t } from "./texts.ts";
import "./inspector/inspector.css";

type Make = (param: Param, props: FieldProps<never>, place: string) => ReactNode;

/* The props of a field are typed by its value; the table is where types of values are told. */
const as = <T, C = Change>(props: FieldProps<never>): FieldProps<T, C> =>
    props as unknown as FieldProps<T, C>;
const number: Make = (param, props) => <NumberField param={param} {...as<number>(props)} />;
const vector: Make = (param, props) => (
    <VectorField param={param} {...as<number | readonly number[]>(props)} />
);
const reference: Make = (param, props, place) => (
    <ReferenceField param={param} place={place} {...as<string>(props)} />
);

const AssetField = lazyPart(() => import("./fields/Asset.tsx"));
const ColourField = lazyPart(() => import("./fields/Colour.tsx"));
const PointsField = lazyPart(() => import("./fields/Points.tsx"));
const RowsField = lazyPart(() => import("./fields/Rows.tsx"));
const SurfaceField = lazyPart(() => import("./fields/Surface.tsx"));

const fields: Record<string, Make> = {
    float: number,
    int: number,
    vec2: vector,
    vec3: vector,
    vec4: vector,
    ivec2: vector,
    ivec3: vector,
    ivec4: vector,
    bool: (_param, props) => <FlagField {...as<boolean>(props)} />,
    bvec3: (_param, props) => <FlagsField {...as<readonly boolean[]>(props)} />,
    color: (_param, props) => <ColourField {...as<readonly number[]>(props)} />,
    enum: (param, props) => <EnumField choices={param.choices} {...as<string>(props)} />,
    text: (_param, props) => <TextField {...as<string>(props)} />,
    material: reference,
    model: reference,
    function: reference,
    asset: (_param, props) => <AssetField {...as<string>(props)} />,
    code: (_param, props, place) => <CodeField place={place} {...as<string>(props)} />,
    equation: (param, props, place) => (
        <EquationField param={param} place={place} {...as<string>(props)} />
    ),
    surface: (_param, props, place) => (
        <SurfaceField place={place} {...as<SurfaceValue, SurfaceRevision>(props)} />
    ),
    points: (param, props) => (
        <PointsField param={param} {...as<readonly (readonly number[])[]>(props)} />
    ),
    rows: (_param, props, place) => (
        <RowsField place={place} fieldFor={fieldFor} {...as<readonly DeclaredRow[]>(props)} />
    ),
};

/* Fields that take the whole width, below their name. */
const WIDE = ["asset", "code", "equation", "points", "rows", "surface"];

const unknown: Make = (_param, props) => <JsonField {...as<Value>(props)} />;

export function fieldFor(type: string): Make {
    return fields[type] ?? unknown;
}

interface FormProps {
    params: readonly Param[];
    /* The place of a row is `base` + "/" + its name. */
    base: string;
    /* What the values belong to, for names such as "head radius". */
    owner: string;
}

export const Form = memo(function Form({ params, base, owner }: FormProps) {
    return grouped(params).map(([group, rows]) => (
        <Fragment key={group}>
            {group !== "" && <h3 className="form-group">{words(group)}</h3>}
            {rows.map((param) => {
                const place = `${base}/${param.name}`;
                const row = <FormRow key={place} param={param} place={place} owner={owner} />;
                return param.when === null ? (
                    row
                ) : (
                    <Where key={place} param={param} params={params} place={place}>
                        {row}
                    </Where>
                );
            })}
        </Fragment>
    ));
});

interface WhereProps {
    param: Param;
    params: readonly Param[];
    place: string;
    children: ReactNode;
}

/* A row that is there while it makes a difference. */
function Where({ param, params, place, children }: WhereProps) {
    const shown = useDocument(({ schema, document }) => {
        const found = document && paramAt(schema, document, place);
        return found !== null && matters(params, found.values, param);
    });
    return shown ? children : null;
}

interface RowProps {
    param: Param;
    place: string;
    owner: string;
}

/* Subscribes to its own value, so that a drag renders this row and no other. */
const FormRow = memo(function FormRow({ param, place, owner }: RowProps) {
    const id = useId();
    const values = useDocument((state) => {
        const found = state.document && paramAt(state.schema, state.document, place);
        return found?.values[param.name];
    });
    const problem = useDocument((state) => {
        const found = problemIn(state.problems, place);
        return found && sentence(found);
    });
    const selection = useView((view) => view.selection);
    const mixed = useDocument(({ schema, document }) =>
        document ? mixedAt(schema, document, selection, place) : "",
    );
    const [refused, setRefused] = useState<string | null>(null);
    const { onInput, onCommit, onCancel, onReset } = useGesture(place, param, owner);
    const value = valueIn(values === undefined ? {} : { [param.name]: values }, param);
    const changed = values !== undefined && !equalJson(values as never, param.default as never);
    const title = paramTitle(param);
    const message = refused ?? problem;
    const row = useRef<HTMLDivElement>(null);
    useBackspaceReset(row, changed, onReset);

    return (
        <div
            className="form-row"
            ref={row}
            data-param={param.name}
            data-wide={WIDE.includes(param.type) || undefined}
            data-changed={changed || undefined}
            data-shake={problem ? "" : undefined}
        >
            <span
                className="form-label"
                data-letter={isLetter(param) || undefined}
                title={param.doc}
            >
                {shortTitle(param)}
            </span>
            <div className="form-field">
                {fieldFor(param.type)(
                    param,
                    {
                        label: title,
                        value: value as never,
                        fallback: param.default as never,
                        mixed,
                        describedBy: message ? `${id}-error` : undefined,
                        onInput: onInput as FieldProps<never>["onInput"],
                        onCommit: onCommit as FieldProps<never>["onCommit"],
                        onCancel,
                        onRefuse: setRefused,
                    },
                    place,
                )}
            </div>
            {changed && (
                <button
                    type="button"
                    className="form-reset"
                    tabIndex={-1}
                    aria-label={t("field.reset", { name: title })}
                    title={t("field.reset", { name: title })}
                    onClick={onReset}
                />
            )}
            {message && (
                <p className="form-error" id={`${id}-error`} role="alert">
                    {message}
                </p>
            )}
        </div>
    );
});

/* One gesture is one undo step; a cancelled one leaves none. */
function useGesture(place: string, param: Param, owner: string) {
    const { link, stores } = useEditor();
    const gesture = useRef<Gesture | null>(null);
    const start = useRef<SceneDocument | null>(null);
    const label = t("edit.set", { owner, name: paramTitle(param) });
    /* All selected nodes that have such a value take part. */
    const set = (value: Value | null, change: Change | Revision | null = null): Operation[] => {
        const { schema, document } = stores.document.getState();
        const before = gesture.current === null ? document : start.current;
        const { selection } = stores.view.getState();
        return before ? multiEdit(schema, before, selection, place, value, change) : [];
    };
    return {
        onInput: (value: Value, change?: Change | Revision): void => {
            if (gesture.current === null) {
                start.current = stores.document.getState().document;
                gesture.current = link.gesture(label);
            }
            gesture.current.edit(set(value, change));
        },
        onCommit: (value: Value, change?: Change | Revision): void => {
            if (gesture.current === null) {
                link.edit(set(value, change), { label });
            } else {
                gesture.current.edit(set(value, change));
                gesture.current.end();
                gesture.current = null;
            }
        },
        onCancel: (): void => {
            gesture.current?.cancel();
            gesture.current = null;
        },
        onReset: (): void => {
            link.edit(set(null), { label });
        },
    };
}

/* Backspace over a row that is not being typed into: the default again. */
function useBackspaceReset(
    row: { readonly current: HTMLDivElement | null },
    changed: boolean,
    onReset: () => void,
): void {
    const reset = useRef(onReset);
    reset.current = onReset;
    useEffect(() => {
        if (!changed) {
            return;
        }
        const key = (event: KeyboardEvent): void => {
            const typing = document.activeElement?.matches("input, textarea, [contenteditable]");
            if (event.key === "Backspace" && !typing && row.current?.matches(":hover")) {
                event.preventDefault();
                event.stopPropagation();
                reset.current();
            }
        };
        window.addEventListener("keydown", key, true);
        return () => window.removeEventListener("keydown", key, true);
    }, [changed, row]);
}
