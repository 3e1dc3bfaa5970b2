/* SPDX-License-Identifier: MIT */
/* What becomes of a text that somebody has typed: the edits that bring it about, or what speaks
 * against them. Pure; waiting, sending and showing are ui/text/draft.ts's. */
import { nodeLabel, type SceneDocument } from "./document.ts";
import { difference, meeting } from "./documentDiff.ts";
import { faultAt, readText, type TextFault } from "./documentRead.ts";
import type { Part } from "./documentText.ts";
import { bytesOf } from "./jsonText.ts";
import type { Operation } from "./operation.ts";
import { apply } from "./operations.ts";
import { nodeOfPlace, resourceOfPlace } from "./places.ts";
import { limitOf, type Schema } from "./schema.ts";

/* Edits that fit, and what others did meanwhile that they meet. */
export interface Meeting {
    /* Places that both have changed. */
    readonly places: readonly string[];
    /* Why mine do not fit any more; "": they do. */
    readonly message: string;
    /* What makes the scene as I want it all the same. */
    readonly ops: readonly Operation[];
}

export type Judged =
    | { readonly kind: "faults"; readonly faults: readonly TextFault[] }
    | { readonly kind: "meeting"; readonly meeting: Meeting }
    /* No operations: the text says what its scene is. */
    | {
          readonly kind: "edit";
          readonly ops: readonly Operation[];
          readonly parts: readonly Part[];
      };

/* Why operations are too many for one edit, in the words that `tell` has. */
export type TooMuch = (
    limit: "operations" | "message_bytes",
    count: number,
    most: number,
) => string;

/* What is left of a message for its envelope. */
const ENVELOPE = 1024;

function whyTooMuch(schema: Schema, ops: readonly Operation[], tell: TooMuch): string | null {
    const most = limitOf(schema, "operations", 10_000);
    if (ops.length > most) {
        return tell("operations", ops.length, most);
    }
    const room = limitOf(schema, "message_bytes", 1_048_576) - ENVELOPE;
    const bytes = bytesOf(JSON.stringify(ops));
    return bytes > room ? tell("message_bytes", bytes, room) : null;
}

/* `base`: the scene that the text was before somebody typed in it; `now`: what it is by now. */
export function judgeText(
    schema: Schema,
    base: SceneDocument,
    now: SceneDocument,
    text: string,
    tell: TooMuch,
): Judged {
    const read = readText(schema, base, text);
    if (!read.ok) {
        return { kind: "faults", faults: read.faults };
    }
    const { parts, document } = read;
    const fault = (place: string, message: string): Judged => ({
        kind: "faults",
        faults: [faultAt(parts, { code: "", place, message })],
    });
    const mine = difference(schema, base, document);
    if (!mine.ok) {
        return fault(mine.problem.place, mine.problem.message);
    }
    const tooMuch = whyTooMuch(schema, mine.ops, tell);
    if (tooMuch !== null) {
        return fault("", tooMuch);
    }
    if (mine.ops.length === 0 || now === base) {
        return { kind: "edit", ops: mine.ops, parts };
    }
    const theirs = difference(schema, base, now);
    const places = theirs.ok ? meeting(base, mine.ops, theirs.ops) : [];
    const fits = apply(now, mine.ops, schema);
    if (fits.ok && places.length === 0) {
        return { kind: "edit", ops: mine.ops, parts };
    }
    if (fits.ok) {
        return { kind: "meeting", meeting: { places, message: "", ops: mine.ops } };
    }
    const whole = difference(schema, now, document);
    return whole.ok
        ? { kind: "meeting", meeting: { places, message: fits.problem.message, ops: whole.ops } }
        : fault(whole.problem.place, whole.problem.message);
}

/* The one thing that all operations are about, by its name; null: there are several. */
export function ownerOf(document: SceneDocument, ops: readonly Operation[]): string | null {
    const names = ops.map((op) => {
        const place = "at" in op ? op.at : op.into;
        const node = document.nodes.get(nodeOfPlace(place) ?? "");
        return node ? nodeLabel(node) : (resourceOfPlace(place)?.name ?? place.split("/")[1] ?? "");
    });
    return new Set(names).size === 1 ? (names[0] ?? null) : null;
}
