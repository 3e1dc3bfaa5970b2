/* SPDX-License-Identifier: MIT */
/* A switch; and three of them, one per axis. */
import type { FieldProps } from "./types.ts";
import "./fields.css";

type FlagProps = Pick<
    FieldProps<boolean>,
    "label" | "value" | "mixed" | "describedBy" | "onCommit"
>;

export function FlagField({ label, value, mixed, describedBy, onCommit }: FlagProps) {
    return (
        // biome-ignore lint/a11y/useAriaPropsSupportedByRole: both roles have it
        <button
            type="button"
            role={mixed ? "checkbox" : "switch"}
            className="switch"
            aria-label={label}
            aria-checked={mixed ? "mixed" : value}
            aria-describedby={describedBy}
            onClick={() => onCommit(!value)}
        >
            <span className="switch-knob" />
        </button>
    );
}

const axes = ["x", "y", "z"] as const;

export function FlagsField({
    label,
    value,
    mixed,
    describedBy,
    onCommit,
}: FieldProps<readonly boolean[]>) {
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="segments" role="group" aria-label={label} aria-describedby={describedBy}>
            {axes.map((axis, i) => (
                <button
                    key={axis}
                    type="button"
                    className="segment axis"
                    data-axis={axis}
                    aria-pressed={mixed ? "mixed" : value[i] === true}
                    aria-label={`${label} ${axis}`}
                    onClick={() => onCommit(value.map((flag, k) => (k === i ? !flag : flag)))}
                >
                    {axis.toUpperCase()}
                </button>
            ))}
        </div>
    );
}
