/* SPDX-License-Identifier: MIT */
/* Texts that the server did not take: why, and what of them stays while nothing shows them. */
import { type RefObject, useEffect, useRef } from "react";
import type { Problem } from "../model/operation.ts";
import { isStanding, settleProblems } from "../model/problems.ts";
import type { Editor } from "./editor.ts";
import { useDocument } from "./state.ts";

interface Refusal {
    readonly text: string;
    readonly problem: Problem;
}

/* `sent`: what was sent last from a place and is not settled yet. `refusal`: why it was not taken,
 * where the server said so; once. */
export function useRefusal(
    place: string,
    text: string,
): {
    readonly sent: RefObject<string | null>;
    readonly refusal: Refusal | null;
    /* What is wrong at the place, whoever sent it. */
    readonly problem: Problem | null;
} {
    const sent = useRef<string | null>(null);
    const saved = useDocument((state) => state.saved);
    const problem = useDocument(({ problems }) => problems.get(place) ?? null);
    const gone = sent.current === text ? null : sent.current;
    const refused = gone !== null && problem !== null && !isStanding(problem);
    useEffect(() => {
        if (saved) {
            sent.current = null;
        }
    }, [saved]);
    return { sent, refusal: refused ? { text: gone, problem } : null, problem };
}

/* What was refused at a place was given up. */
export function settleRefusal({ stores }: Editor, place: string): void {
    stores.document.setState(({ problems }) => ({
        problems: settleProblems(problems, [{ op: "remove", at: place }]),
    }));
}

/* A text that was not taken; `problem` null: it was on its way. */
interface Kept {
    readonly text: string;
    readonly problem: Problem | null;
}
const keptTexts = new WeakMap<Editor, Map<string, Kept>>();

/* What an editor keeps, by scene and place. */
export function keptOf(editor: Editor, place: string) {
    const texts = keptTexts.get(editor) ?? new Map<string, Kept>();
    keptTexts.set(editor, texts);
    const { stores } = editor;
    const key = `${stores.document.getState().scene} ${place}`;
    return {
        put: (kept: Kept): void => void texts.set(key, kept),
        /* What was refused, with the reason; it is kept no longer. */
        take: (): Refusal | null => {
            const kept = texts.get(key);
            texts.delete(key);
            const told = stores.document.getState().problems.get(place);
            const problem = kept?.problem ?? (told && !isStanding(told) ? told : null);
            return kept && problem ? { text: kept.text, problem } : null;
        },
    };
}
