/* SPDX-License-Identifier: MIT */
/* An equation. The picture follows what is typed, as long as it can be read; where it cannot, a mark
 * stands under the letter. Escape restores what was there. */
import { lazyPart } from "../lazy.tsx";
import { useDocument, useView } from "../state.ts";
import { Mark } from "./Mark.tsx";
import { useTypedText } from "./typedText.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const QualityBadge = lazyPart(() => import("./Quality.tsx"));

interface Props extends FieldProps<string> {
    place: string;
}

export function EquationField(props: Props) {
    const { label, value, place, mixed, describedBy, onInput, onCommit, onCancel } = props;
    const { shown, isTyped, listeners } = useTypedText({
        text: mixed ? "" : value,
        lines: true,
        onInput,
        onCommit,
        onCancel,
    });
    const problem = useDocument(({ problems }) => problems.get(place) ?? null);
    const node = /^\/nodes\/([^/]+)\/params\/equation$/.exec(place)?.[1];
    const alone = useView(({ selection }) => selection.length === 1);
    return (
        <div className="equation-field">
            <textarea
                className="text-field"
                data-field={isTyped ? "typed" : "unchanged"}
                aria-label={label}
                aria-describedby={describedBy}
                value={shown}
                rows={Math.min(8, Math.max(2, shown.split("\n").length))}
                spellCheck={false}
                autoComplete="off"
                {...listeners}
            />
            {problem?.line !== undefined && (
                <Mark text={shown} line={problem.line} column={problem.column ?? 1} />
            )}
            {node !== undefined && alone && <QualityBadge node={node} place={place} />}
        </div>
    );
}
