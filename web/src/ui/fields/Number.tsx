/* SPDX-License-Identifier: MIT */
/* A number: drag to scrub, click to type (expressions allowed), arrows to step. Shows the value in
 * the unit that people think in; the document keeps its own. */
import { memo, useRef, useState } from "react";
import type { Change } from "../../model/multiEdit.ts";
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
    /* Takes a pasted or typed text as a whole vector; false: it was none. */
    onPasteText?: (text: string) => boolean;
}

export const NumberField = memo(function NumberField(props: Props) {
    const { param, label, value, axis, describedBy } = props;
    const mixed = props.mixed?.includes("1") ?? false;
    const display = displayOf(param);
    const [draft, setDraft] = useState<string | null>(null);
    const [stop, setStop] = useState<"min" | "max" | null>(null);
    const [scrubbing, setScrubbing] = useState(false);
    const input = useRef<HTMLInputElement>(null);
    const start = useRef(value);
    const latest = useRef(value);

    const clamp = (wanted: number): number => {
        const next = clampNumber(param, wanted);
        setStop(next > wanted + 1e-9 ? "min" : next < wanted - 1e-9 ? "max" : null);
        return next;
    };
    /* Others go as far as the dragged one, factors by as much. */
    const dragged = (): Change => {
        const [from, to] = [start.current, latest.current];
        const scales = param.uniform && from !== 0;
        return { axis: null, by: (own) => (scales ? (own * to) / from : own + to - from) };
    };
    const scrub = useScrub({
        onStart: () => {
            start.current = value;
            latest.current = value;
            setScrubbing(true);
        },
        onMove: (pixels: number, keys: ScrubKeys) => {
            latest.current = clamp(display.scrub(start.current, pixels, keys));
            props.onInput(latest.current, dragged());
        },
        onEnd: () => {
            setScrubbing(false);
            setStop(null);
            props.onCommit(latest.current, dragged());
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
    const cancel = (): void => {
        props.onRefuse(null);
        setDraft(null);
    };
    const commit = (): void => {
        if (draft === null) {
            return;
        }
        if (mixed && draft === "") {
            cancel();
            return;
        }
        const parsed = display.parse(draft, value);
        if (parsed === null && props.onPasteText?.(draft)) {
            cancel();
            return;
        }
        const problem = parsed === null ? t("field.notNumber") : checkNumber(param, parsed);
        if (parsed === null || problem !== null) {
            props.onRefuse(problem);
            return;
        }
        props.onRefuse(null);
        setDraft(null);
        if (parsed !== value || mixed) {
            props.onCommit(parsed, {
                axis: null,
                by: (own) => display.parse(draft, own) ?? own,
            });
        }
    };
    const key = (event: React.KeyboardEvent<HTMLInputElement>): void => {
        const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        if (direction) {
            event.preventDefault();
            setDraft(null);
            const keys = { coarse: event.shiftKey, fine: event.altKey };
            const step = (own: number): number => display.arrow(own, direction, keys);
            props.onCommit(clampNumber(param, step(value)), { axis: null, by: step });
        } else if (event.key === "Enter") {
            commit();
            input.current?.select();
        } else if (event.key === "Escape" && draft !== null) {
            event.stopPropagation();
            cancel();
            input.current?.select();
        }
    };
    const shown = mixed ? "" : display.print(value);
    const fill = draft === null && axis === undefined && !mixed ? fraction(param, value) : null;

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
                data-field={draft === null || draft === shown ? "unchanged" : "typed"}
                role="spinbutton"
                inputMode="text"
                aria-label={label}
                aria-describedby={describedBy}
                aria-valuenow={value}
                aria-valuetext={mixed ? t("field.mixed") : shown}
                placeholder={mixed ? t("field.mixed") : undefined}
                onPointerEnter={(event) =>
                    tellWhole(event.currentTarget, display.full(value), mixed)
                }
                aria-valuemin={param.min ?? undefined}
                aria-valuemax={param.max ?? undefined}
                aria-invalid={(describedBy && draft !== null) || undefined}
                spellCheck={false}
                autoComplete="off"
                value={draft ?? shown}
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

/* A tip with the whole value, where the field has no room for it or shows fewer digits. */
function tellWhole(input: HTMLInputElement, full: string, mixed: boolean): void {
    const cut = input.scrollWidth > input.clientWidth || input.value !== full;
    input.title = cut && !mixed ? full : "";
}

/* How much of its range a value fills; null where it is no slider. */
function fraction(param: Param, value: number): number | null {
    const range = sliderRange(param);
    return range && Math.min(1, Math.max(0, (value - range.min) / (range.max - range.min)));
}
