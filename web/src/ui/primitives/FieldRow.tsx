/* SPDX-License-Identifier: MIT */
/* One field of a node: a checkbox that makes it a parameter; then what of it, its name, its range. */
import type { Choice, Field, Part } from "../../model/choosing.ts";
import { components, numberParam } from "../../model/schema.ts";
import { numbersOf } from "../../model/values.ts";
import { displayOf } from "../fields/display.ts";
import { NumberField } from "../fields/Number.tsx";
import { TextField } from "../fields/Text.tsx";
import { paramTitle } from "../names.ts";
import { t } from "../texts.ts";
import { Select } from "../widgets/Select.tsx";

interface Props {
    field: Field;
    /* The label of its node. */
    owner: string;
    choice: Choice | null;
    reason: string | null;
    /* No more can be chosen. */
    full: boolean;
    pick: (part: Part) => Choice;
    onChange: (choice: Choice | null) => void;
}

const ignore = (): void => undefined;

export function FieldRow({ field, owner, choice, reason, full, pick, onChange }: Props) {
    const title = paramTitle(field.param);
    const first = field.parts[0];
    const blocked = full && choice === null;
    return (
        <div className="primitive-field" data-chosen={choice !== null || undefined}>
            <label className="primitive-check" title={blocked ? t("primitive.full") : undefined}>
                <input
                    type="checkbox"
                    aria-label={t("primitive.choose", { owner, name: title })}
                    checked={choice !== null}
                    disabled={blocked}
                    onChange={() => onChange(choice === null && first ? pick(first) : null)}
                />
                <span className="ellipsis">{title}</span>
            </label>
            {choice === null ? (
                <span className="primitive-value">{shown(field)}</span>
            ) : (
                <Details {...{ field, choice, reason, pick, onChange, title }} />
            )}
        </div>
    );
}

const LETTERS = "xyzw";

function Details({
    field,
    choice,
    reason,
    pick,
    onChange,
    title,
}: Pick<Props, "field" | "reason" | "pick" | "onChange"> & { choice: Choice; title: string }) {
    const { parts } = field;
    const at = parts.findIndex(({ component }) => component === choice.target.component);
    return (
        <div className="primitive-details">
            <TextField
                label={t("primitive.nameOf", { name: title })}
                value={choice.name}
                fallback=""
                maxLength={64}
                onInput={ignore}
                onCancel={ignore}
                onRefuse={ignore}
                onCommit={(name) => onChange({ ...choice, name })}
            />
            {parts.length > 1 && (
                <Select
                    label={t("primitive.part", { name: title })}
                    value={String(at)}
                    options={parts.map(({ component }, i) => ({
                        value: String(i),
                        label: component === null ? t("primitive.all") : (LETTERS[component] ?? ""),
                    }))}
                    onChange={(index) => {
                        const part = parts[Number(index)];
                        if (part) {
                            onChange({ ...pick(part), name: renamed(choice, field, part) });
                        }
                    }}
                />
            )}
            {choice.range && <Range {...{ field, choice, onChange, title }} />}
            {reason && (
                <p className="form-error" role="alert">
                    {reason}
                </p>
            )}
        </div>
    );
}

/* The name follows the component while it says one. */
function renamed({ name, target }: Choice, field: Field, part: Part): string {
    const stem =
        target.component === null ? name : name.replace(`_${LETTERS[target.component]}`, "");
    const said = stem === name && target.component !== null;
    const letter = part.component === null || said ? "" : `_${LETTERS[part.component]}`;
    return field.parts.length > 1 ? `${stem}${letter}` : name;
}

function Range({
    field: { param },
    choice,
    onChange,
    title,
}: Pick<Props, "field" | "onChange"> & { choice: Choice; title: string }) {
    const range = choice.range ?? [0, 1];
    const { unit, step } = param;
    const type = choice.type === "int" || choice.type.startsWith("ivec") ? "int" : "float";
    const row = numberParam("range", { type, unit, step });
    const end = (index: 0 | 1, label: string) => (
        <NumberField
            param={row}
            label={label}
            value={range[index]}
            fallback={range[index]}
            onInput={(x) => put(index, x)}
            onCommit={(x) => put(index, x)}
            onCancel={ignore}
            onRefuse={ignore}
        />
    );
    const put = (index: 0 | 1, x: number): void =>
        onChange({ ...choice, range: index === 0 ? [x, range[1]] : [range[0], x] });
    return (
        <div className="primitive-range">
            {end(0, t("primitive.from", { name: title }))}
            <span aria-hidden="true">–</span>
            {end(1, t("primitive.to", { name: title }))}
        </div>
    );
}

/* As the inspector shows it. */
function shown({ param, value }: Field): string {
    const display = displayOf(param);
    return typeof value === "boolean" || param.type === "bvec3"
        ? String(value)
        : numbersOf(value, components(param.type))
              .map((x) => display.print(x))
              .join("  ");
}
