/* SPDX-License-Identifier: MIT */
/* An equation. The picture and the equation as it is typeset follow what is typed, as long as it can
 * be read; where it cannot, marks stand under the letters. Escape restores what was there. */
import type { Param } from "../../model/schema.ts";
import { checkText } from "../../model/values.ts";
import { lazyPart } from "../lazy.tsx";
import { useDocument, useView } from "../state.ts";
import { useTypedText } from "./typedText.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const Typeset = lazyPart(() => import("./Typeset.tsx"));
const QualityBadge = lazyPart(() => import("./Quality.tsx"));

interface Props extends FieldProps<string> {
    param: Param;
    place: string;
}

export function EquationField(props: Props) {
    const { label, value, param, place, mixed, describedBy } = props;
    const { onInput, onCommit, onCancel, onRefuse } = props;
    const schema = useDocument((state) => state.schema);
    const { shown, isTyped, listeners } = useTypedText({
        place,
        text: value,
        mixed: Boolean(mixed),
        lines: true,
        onInput,
        onCommit,
        onCancel,
        whyNot: (text) => checkText(schema, param, text),
        onRefuse,
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
            <Typeset
                text={shown}
                form={place.endsWith("/function") ? "function" : "equation"}
                problem={problem}
            />
            {node !== undefined && alone && <QualityBadge node={node} place={place} />}
        </div>
    );
}
