/* SPDX-License-Identifier: MIT */
/* The letters of a text that errors are about, with some around them. */
import { type Fault, markedLines } from "../../model/faults.ts";
import "./fields.css";

interface MarkProps {
    text: string;
    faults: readonly Pick<Fault, "line" | "column">[];
}

export function Mark({ text, faults }: MarkProps) {
    return markedLines(text, faults).map((pieces, i) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: lines have no other name
        <pre key={i} className="equation-mark" aria-hidden="true">
            {pieces.map((piece, k) =>
                piece.wrong ? (
                    // biome-ignore lint/suspicious/noArrayIndexKey: pieces have no other name
                    <mark key={k}>{piece.text}</mark>
                ) : (
                    piece.text
                ),
            )}
        </pre>
    ));
}
