/* SPDX-License-Identifier: MIT */
/* Code in a form: its first lines, and the way to the editor where it is written. */
import { SquareCode } from "lucide-react";
import { openCode } from "../insertions.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const LINES_SHOWN = 7;

interface Props extends FieldProps<string> {
    place: string;
}

export function CodeField({ label, value, place, describedBy }: Props) {
    const editor = useEditor();
    const open = useView((view) => view.code === place);
    const lines = value.split("\n");
    const more = lines.length > LINES_SHOWN;
    return (
        <div className="code-field" data-place={place}>
            {value !== "" && (
                <pre aria-hidden="true" data-more={more || undefined}>
                    {lines.slice(0, LINES_SHOWN).join("\n")}
                </pre>
            )}
            <Button
                look="outline"
                icon={<SquareCode size={15} aria-hidden="true" />}
                aria-label={t("code.open", { name: label })}
                aria-describedby={describedBy}
                aria-pressed={open}
                onClick={() => openCode(editor, place)}
            >
                {t(value === "" ? "code.write" : "code.edit")}
            </Button>
        </div>
    );
}
