/* SPDX-License-Identifier: MIT */
/* The field of last resort: a value of a type that this page does not know, as checked JSON. */
import { useState } from "react";
import type { Value } from "../../model/schema.ts";
import { t } from "../texts.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

export function JsonField({ label, value, describedBy, onCommit, onRefuse }: FieldProps<Value>) {
    const [draft, setDraft] = useState<string | null>(null);
    const commit = (): void => {
        if (draft === null) {
            return;
        }
        try {
            const parsed = JSON.parse(draft) as Value;
            onRefuse(null);
            setDraft(null);
            onCommit(parsed);
        } catch (error) {
            onRefuse(t("field.notJson", { message: (error as Error).message }));
        }
    };
    return (
        <textarea
            className="json-field"
            aria-label={label}
            aria-describedby={describedBy}
            rows={2}
            spellCheck={false}
            value={draft ?? JSON.stringify(value)}
            onChange={(event) => setDraft(event.target.value)}
            onBlur={commit}
        />
    );
}
