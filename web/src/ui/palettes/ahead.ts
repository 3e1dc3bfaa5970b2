/* SPDX-License-Identifier: MIT */
/* Keys that are pressed while a palette is being opened: they are meant for its search. They are
 * kept until it takes them, and reach no command and no field. */
import type { Popup } from "../../model/view.ts";

const PALETTES: readonly Popup[] = ["commands", "add", "wrap", "input"];

type Take = (key: string) => void;

let kept: string[] = [];
let taker: Take | null = null;

/* Takes a key press that is meant for a palette, without the focus in it; false: it is not. */
export function keepForPalette(event: KeyboardEvent, popup: Popup): boolean {
    const modified = event.ctrlKey || event.metaKey || event.altKey;
    const isMeant =
        PALETTES.includes(popup) &&
        !modified &&
        (event.key.length === 1 || event.key === "Backspace" || event.key === "Enter");
    if (isMeant) {
        if (taker) {
            taker(event.key);
        } else {
            kept.push(event.key);
        }
    }
    return isMeant;
}

/* From now on `take` gets the keys, first those that were kept; answers the function that ends it. */
export function takeKept(take: Take): () => void {
    taker = take;
    const early = kept;
    kept = [];
    early.forEach(take);
    return () => {
        taker = taker === take ? null : taker;
    };
}

/* A palette that was closed before it was there. */
export function forgetKept(): void {
    kept = [];
}
