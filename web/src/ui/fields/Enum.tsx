/* SPDX-License-Identifier: MIT */
/* One of a few words: side by side up to four, else a list. */
import { useRef } from "react";
import { Select } from "../widgets/Select.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const MOST_SEGMENTS = 4;
/* Segments are as wide as the longest, and each has a rim. */
const MOST_LETTERS = 28;
const RIM_LETTERS = 2;

interface Props extends FieldProps<string> {
    choices: readonly string[];
}

export function EnumField({ label, value, mixed, choices, describedBy, onCommit }: Props) {
    const group = useRef<HTMLDivElement>(null);
    const longest = Math.max(...choices.map((choice) => choice.length));
    const letters = choices.length * (longest + RIM_LETTERS);
    if (choices.length === 1 && value === choices[0]) {
        return <span className="only-choice">{words(value)}</span>;
    }
    if (choices.length > MOST_SEGMENTS || letters > MOST_LETTERS) {
        return (
            <Select
                value={value}
                mixed={mixed === "1"}
                label={label}
                describedBy={describedBy}
                options={choices.map((choice) => ({ value: choice, label: words(choice) }))}
                onChange={onCommit}
            />
        );
    }
    const step = (by: number): void => {
        const next = (choices.indexOf(value) + by + choices.length) % choices.length;
        const choice = choices[next];
        if (choice !== undefined) {
            onCommit(choice);
            (group.current?.children[next] as HTMLElement | undefined)?.focus();
        }
    };
    return (
        <div
            ref={group}
            className="segments"
            role="radiogroup"
            aria-label={label}
            aria-describedby={describedBy}
            onKeyDown={(event) => {
                const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
                if (by) {
                    event.preventDefault();
                    step(by);
                }
            }}
        >
            {choices.map((choice) => (
                // biome-ignore lint/a11y/useSemanticElements: a native radio cannot be styled as a segment
                <button
                    key={choice}
                    type="button"
                    role="radio"
                    className="segment"
                    aria-checked={choice === value && !mixed}
                    tabIndex={choice === value ? 0 : -1}
                    onClick={() => onCommit(choice)}
                >
                    {words(choice)}
                </button>
            ))}
        </div>
    );
}

function words(name: string): string {
    return name.replaceAll("_", " ");
}
