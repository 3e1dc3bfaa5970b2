/* SPDX-License-Identifier: MIT */
/* A number: drag to scrub, click to type (expressions allowed), arrows to step. Shows the value in
 * the unit that people think in; the document keeps its own. */
import { memo, useRef, useState } from "react";
import type { Param } from "../../model/schema.ts";
import { checkNumber, clampNumber } from "../../model/values.ts";
import { t } from "../texts.ts";
import { displayOf, sliderRange } from "./display.ts";
import { type ScrubKeys, useScrub } from "./scrub.ts";
import type { FieldProps } from "./types.ts";

import "./fields.css";

export type Axis = "x" | "y" | "z" | "w";

interface Props extends FieldProps<number> {
    param: Param;
    axis?: Axis;
    /* Takes a pasted text as a whole vector; false: it was none. */
    onPasteText?: (text: string) => boolean;
}

export const NumberField = memo(function NumberField(props: Props) {
    const { param, label, value, axis, describedBy } = props;
    const display = displayOf(param);
    const [draft, setDraft] = useState<string | null>(null);
    const [stop, setStop] = useState<"min" | "max" | null>(null);
    const [scrubbing, setScrubbing] = useState(false);
    const input = useRef<HTMLInputElement>(null);
    const start = useRef(value);
    const latest = useRef(value);

    const put = (wanted: number, commit: boolean): void => {
        const next = clampNumber(param, wanted);
        setStop(next > wanted + 1e-9 ? "min" : next < wanted - 1e-9 ? "max" : null);
        latest.current = next;
        (commit ? props.onCommit : props.onInput)(next);
    };
    const scrub = useScrub({
        onStart: () => {
            start.current = value;
            latest.current = value;
            setScrubbing(true);
        },
        onMove: (pixels: number, keys: ScrubKeys) =>
            put(display.scrub(start.current, pixels, keys), false),
        onEnd: () => {
            setScrubbing(false);
            setStop(null);
            props.onCommit(latest.current);
        },
        onCancel: () => {
            setScrubbing(false);
            setStop(null);
            props.onCancel();
        },
        onClick: () => {
            input.current?.focus();
            input.current?.select();
        },
    });
    const commit = (): void => {
        if (draft === null) {
            return;
        }
        const parsed = display.parse(draft, value);
        const problem = parsed === null ? t("field.notNumber") : checkNumber(param, parsed);
        if (parsed === null || problem !== null) {
            props.onRefuse(problem);
            return;
        }
        props.onRefuse(null);
        setDraft(null);
        if (parsed !== value) {
            props.onCommit(parsed);
        }
    };
    const cancel = (): void => {
        props.onRefuse(null);
        setDraft(null);
    };
    const key = (event: React.KeyboardEvent<HTMLInputElement>): void => {
        const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        if (direction) {
            event.preventDefault();
            setDraft(null);
            const keys = { coarse: event.shiftKey, fine: event.altKey };
            put(display.arrow(value, direction, keys), true);
            setStop(null);
        } else if (event.key === "Enter") {
            commit();
            input.current?.select();
        } else if (event.key === "Escape" && draft !== null) {
            event.stopPropagation();
            cancel();
            input.current?.select();
        }
    };
    const text = draft ?? display.print(value);
    const fill = draft === null && axis === undefined ? fraction(param, value) : null;

    return (
        <div
            className="number"
            data-scrub={scrubbing || undefined}
            data-stop={stop ?? undefined}
            data-bad={(describedBy && draft !== null) || undefined}
        >
            {fill !== null && (
                <span
                    className="number-fill"
                    style={{ inlineSize: `calc(${fill * 100}% - 2px)` }}
                />
            )}
            {axis && (
                <span className="number-axis" data-axis={axis} aria-hidden="true">
                    {axis.toUpperCase()}
                </span>
            )}
            <input
                ref={input}
                role="spinbutton"
                inputMode="text"
                aria-label={label}
                aria-describedby={describedBy}
                aria-valuenow={value}
                aria-valuetext={display.print(value)}
                aria-valuemin={param.min ?? undefined}
                aria-valuemax={param.max ?? undefined}
                aria-invalid={(describedBy && draft !== null) || undefined}
                spellCheck={false}
                autoComplete="off"
                value={text}
                onPointerDown={scrub}
                onFocus={(event) => event.currentTarget.select()}
                onChange={(event) => setDraft(event.target.value)}
                onBlur={commit}
                onKeyDown={key}
                onPaste={(event) => {
                    if (props.onPasteText?.(event.clipboardData.getData("text"))) {
                        event.preventDefault();
                        cancel();
                    }
                }}
            />
        </div>
    );
});

/* How much of its range a value fills; null where it is no slider. */
function fraction(param: Param, value: number): number | null {
    const range = sliderRange(param);
    return range && Math.min(1, Math.max(0, (value - range.min) / (range.max - range.min)));
}
