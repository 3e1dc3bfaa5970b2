/* SPDX-License-Identifier: MIT */
/* An equation. The picture follows what is typed, as long as it can be read; where it cannot, a mark
 * stands under the letter. Escape restores what was there. */
import { useEffect, useRef, useState } from "react";
import { lazyPart } from "../lazy.tsx";
import { useDocument, useView } from "../state.ts";
import { Mark } from "./Mark.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

/* A pause in typing after which the text is sent. */
const SEND_MS = 250;

const QualityBadge = lazyPart(() => import("./Quality.tsx"));

interface Props extends FieldProps<string> {
    place: string;
}

export function EquationField(props: Props) {
    const { label, value, place, mixed, describedBy, onInput, onCommit, onCancel } = props;
    const [draft, setDraft] = useState<string | null>(null);
    const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
    const area = useRef<HTMLTextAreaElement>(null);
    const shown = draft ?? (mixed ? "" : value);
    const problem = useDocument(({ problems }) => problems.get(place) ?? null);
    const node = /^\/nodes\/([^/]+)\/params\/equation$/.exec(place)?.[1];
    const alone = useView(({ selection }) => selection.length === 1);
    useEffect(() => () => clearTimeout(timer.current), []);
    const end = (take: boolean): void => {
        clearTimeout(timer.current);
        if (draft !== null) {
            take ? onCommit(draft) : onCancel();
        }
        setDraft(null);
    };
    return (
        <div className="equation-field">
            <textarea
                ref={area}
                className="text-field"
                data-field={draft === null ? "unchanged" : "typed"}
                aria-label={label}
                aria-describedby={describedBy}
                value={shown}
                rows={Math.min(8, Math.max(2, shown.split("\n").length))}
                spellCheck={false}
                autoComplete="off"
                onChange={({ target }) => {
                    setDraft(target.value);
                    clearTimeout(timer.current);
                    timer.current = setTimeout(() => onInput(target.value), SEND_MS);
                }}
                onBlur={() => end(true)}
                onKeyDown={(event) => {
                    if (event.key === "Enter" && !event.shiftKey) {
                        event.preventDefault();
                        end(true);
                    } else if (event.key === "Escape" && draft !== null) {
                        event.stopPropagation();
                        end(false);
                    }
                }}
            />
            {problem?.line !== undefined && (
                <Mark text={shown} line={problem.line} column={problem.column ?? 1} />
            )}
            {node !== undefined && alone && <QualityBadge node={node} place={place} />}
        </div>
    );
}
