/* SPDX-License-Identifier: MIT */
/* A line of text, sent when it is left or Enter is pressed; Escape restores. */
import { useState } from "react";
import { t } from "../texts.ts";
import { useNameCut } from "./nameCut.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

interface Props extends FieldProps<string> {
    placeholder?: string;
    maxLength?: number;
}

export function TextField({
    label,
    value,
    mixed,
    placeholder,
    maxLength,
    describedBy,
    onCommit,
}: Props) {
    const [draft, setDraft] = useState<string | null>(null);
    const cut = useNameCut();
    const commit = (): void => {
        if (draft !== null && (mixed ? draft !== "" : draft !== value)) {
            onCommit(draft);
        }
        setDraft(null);
    };
    return (
        <input
            className="text-field"
            data-field={draft === null || draft === value ? "unchanged" : "typed"}
            aria-label={label}
            aria-describedby={describedBy}
            value={draft ?? (mixed ? "" : value)}
            placeholder={mixed ? t("field.mixed") : placeholder}
            maxLength={maxLength}
            spellCheck={false}
            autoComplete="off"
            onChange={(event) => setDraft(cut(event.target))}
            onBlur={commit}
            onKeyDown={(event) => {
                if (event.key === "Enter") {
                    commit();
                    event.currentTarget.select();
                } else if (event.key === "Escape" && draft !== null) {
                    event.stopPropagation();
                    setDraft(null);
                }
            }}
        />
    );
}
