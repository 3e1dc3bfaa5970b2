/* SPDX-License-Identifier: MIT */
/* What is under the pointer in the picture, for the tree and the outline to show: known at once where
 * there is a guide. Else it is asked for when the pointer rests, and only while nothing else is, so
 * that a click never waits for it. */
import { guideAt } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";

/* The pointer rests when it has not moved for this long. */
const REST_MS = 80;

/* Answers the function that ends it. */
export function watchHover(editor: Editor, element: HTMLElement): () => void {
    const { view } = editor.stores;
    const listening = new AbortController();
    const options = { signal: listening.signal };
    let timer: ReturnType<typeof setTimeout> | undefined;
    let asked = 0;
    let shown: string | null = null;
    const show = (node: string | null): void => {
        shown = node;
        if (view.getState().hovered !== node) {
            view.setState({ hovered: node });
        }
    };
    const ask = async (x: number, y: number): Promise<void> => {
        asked++;
        const mine = asked;
        const picked = await editor.link.pickIdle(x, y).catch(() => null);
        if (picked !== null && mine === asked) {
            show(picked.node);
        }
    };
    const leave = (): void => {
        clearTimeout(timer);
        asked++;
        /* React tells a row that the pointer enters it before this is told that it leaves. */
        if (view.getState().hovered === shown) {
            show(null);
        }
    };
    element.addEventListener(
        "pointermove",
        (event) => {
            clearTimeout(timer);
            if (event.buttons !== 0 || event.pointerType === "touch") {
                return;
            }
            const box = element.getBoundingClientRect();
            const [x, y] = [event.clientX - box.left, event.clientY - box.top];
            const known = guideAt(editor.stores, element, { x, y });
            if (known !== undefined) {
                asked++;
                show(known);
                return;
            }
            timer = setTimeout(() => void ask(x, y), REST_MS);
        },
        options,
    );
    element.addEventListener("pointerdown", () => clearTimeout(timer), options);
    element.addEventListener("pointerleave", leave, options);
    return () => {
        listening.abort();
        leave();
    };
}
