/* SPDX-License-Identifier: MIT */
/* Two to four numbers in the colours of their axes; a pasted "1 2 3" fills all. Scales can be
 * linked. */
import { Link2, Link2Off } from "lucide-react";
import { useState } from "react";
import type { Change } from "../../model/multiEdit.ts";
import { components, type Param } from "../../model/schema.ts";
import { parseVector } from "../../model/units.ts";
import { numbersOf } from "../../model/values.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { displayOf } from "./display.ts";
import { type Axis, NumberField } from "./Number.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const allAxes: readonly Axis[] = ["x", "y", "z", "w"];

type Send = (value: readonly number[], change?: Change) => void;

interface Props extends FieldProps<number | readonly number[]> {
    param: Param;
}

export function VectorField({ param, label, value, fallback, ...rest }: Props) {
    const count = components(param.type);
    const axes = allAxes.slice(0, count);
    const numbers = numbersOf(value, count);
    const defaults = numbersOf(fallback, count);
    const even = numbers.every((x) => x === numbers[0]);
    const mayLink = param.uniform;
    const [linked, setLinked] = useState(mayLink && even);
    const one = mayLink && linked && even;
    const put =
        (send: Send, axis: number) =>
        (x: number, change?: Change): void =>
            send(
                one ? axes.map(() => x) : numbers.map((old, i) => (i === axis ? x : old)),
                change && { ...change, axis: one ? null : axis },
            );
    const display = displayOf(param);
    const paste = (text: string): boolean => {
        /* No part is relative to what is there: nothing of it would be a number. */
        const pasted = parseVector(text, count, (part) => display.parse(part, Number.NaN));
        if (pasted !== null) {
            rest.onCommit(pasted);
        }
        return pasted !== null;
    };
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="vector" data-count={one ? 1 : count} role="group" aria-label={label}>
            {(one ? axes.slice(0, 1) : axes).map((axis, i) => (
                <NumberField
                    key={axis}
                    param={param}
                    axis={one ? undefined : axis}
                    label={one ? label : `${label} ${axis}`}
                    value={numbers[i] ?? 0}
                    fallback={defaults[i] ?? 0}
                    describedBy={rest.describedBy}
                    mixed={one ? rest.mixed : rest.mixed?.charAt(i)}
                    onInput={put(rest.onInput, i)}
                    onCommit={put(rest.onCommit, i)}
                    onCancel={rest.onCancel}
                    onRefuse={rest.onRefuse}
                    onPasteText={paste}
                />
            ))}
            {mayLink && (
                <IconButton
                    title={t("field.link")}
                    data-size="s"
                    aria-pressed={one}
                    onClick={() => {
                        setLinked(!one);
                        if (!one && !even) {
                            const x = numbers[0] ?? 1;
                            rest.onCommit(axes.map(() => x));
                        }
                    }}
                >
                    {one ? <Link2 size={14} /> : <Link2Off size={14} />}
                </IconButton>
            )}
        </div>
    );
}
