/* SPDX-License-Identifier: MIT */
/* The letter of a text that an error is about, with some around it. */
import "./fields.css";

interface MarkProps {
    text: string;
    /* From 1, in code points. */
    line: number;
    column: number;
}

/* Letters before and behind the one that is meant. */
const AROUND = 14;

export function Mark({ text, line, column }: MarkProps) {
    const row = [...(text.split("\n")[line - 1] ?? "")];
    const at = Math.min(column - 1, row.length);
    const from = Math.max(0, at - AROUND);
    const to = at + 1 + AROUND;
    return (
        <pre className="equation-mark" aria-hidden="true">
            {from > 0 && "…"}
            {row.slice(from, at).join("")}
            <mark>{row[at] ?? " "}</mark>
            {row.slice(at + 1, to).join("")}
            {to < row.length && "…"}
        </pre>
    );
}
