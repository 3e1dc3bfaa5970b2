/* SPDX-License-Identifier: MIT */
/* Faults of a text that is typed, and the parts of its lines that are shown with marks. */

export interface Fault {
    /* From 1, in code points. */
    readonly line: number;
    readonly column: number;
    readonly message: string;
}

/* A part of a line; `wrong` is marked. */
export interface Piece {
    readonly text: string;
    readonly wrong: boolean;
}

/* Letters that are shown before and behind one that is meant. */
const AROUND = 14;

/* A name is meant as a whole, else one letter is. */
function endOf(row: readonly string[], at: number): number {
    const name = /^[A-Za-z_]\w*/.exec(row.slice(at).join(""));
    return at + (name ? name[0].length : 1);
}

function piecesOf(row: readonly string[], places: readonly number[]): Piece[] {
    const pieces: Piece[] = [];
    const put = (text: string, wrong: boolean): void => {
        if (text !== "") {
            pieces.push({ text, wrong });
        }
    };
    let shown = 0;
    for (const [i, at] of places.entries()) {
        if (at < shown) {
            continue;
        }
        const from = Math.max(shown, at - AROUND);
        put(`${from > shown ? "…" : ""}${row.slice(from, at).join("")}`, false);
        shown = endOf(row, at);
        put(row.slice(at, shown).join("") || " ", true);
        const next = places.slice(i + 1).find((place) => place >= shown) ?? row.length;
        const to = Math.min(next, shown + AROUND);
        put(row.slice(shown, to).join(""), false);
        shown = to;
    }
    put(shown < row.length ? "…" : "", false);
    return pieces;
}

/* The lines that have faults, each in pieces. */
export function markedLines(
    text: string,
    faults: readonly Pick<Fault, "line" | "column">[],
): Piece[][] {
    const rows = text.split("\n");
    const lines = [...new Set(faults.map(({ line }) => line))].sort((a, b) => a - b);
    return lines.map((line) => {
        const row = [...(rows[line - 1] ?? "")];
        const places = faults
            .filter((fault) => fault.line === line)
            .map(({ column }) => Math.min(column - 1, row.length));
        return piecesOf(
            row,
            [...new Set(places)].sort((a, b) => a - b),
        );
    });
}

/* What they say, each once. */
export const messagesOf = (faults: readonly Fault[]): readonly string[] => [
    ...new Set(faults.map(({ message }) => message)),
];
