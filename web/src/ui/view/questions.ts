/* SPDX-License-Identifier: MIT */
/* What lies under a point, asked one after the other: the server answers only the newest question,
 * and every click counts. A ring marks a click until its answer is here. */
import type { PickedMessage } from "../../link/protocol.ts";
import { addNotice, type Stores } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";
import { t } from "../texts.ts";

/* How long a click waits for a connection. */
const CONNECT_MS = 20_000;

/* Resolves when the scene is live, or after CONNECT_MS; false: it is not. */
function whenLive({ link }: Stores): Promise<boolean> {
    const isLive = (): boolean => link.getState().connection === "live";
    if (isLive()) {
        return Promise.resolve(true);
    }
    return new Promise((resolve) => {
        const finish = (): void => {
            stop();
            clearTimeout(timer);
            resolve(isLive());
        };
        const stop = link.subscribe(() => isLive() && finish());
        const timer = setTimeout(finish, CONNECT_MS);
    });
}

function mark(element: HTMLElement, x: number, y: number): () => void {
    const ring = document.createElement("div");
    ring.className = "view-asked";
    ring.style.insetInlineStart = `${x}px`;
    ring.style.insetBlockStart = `${y}px`;
    element.append(ring);
    return () => ring.remove();
}

export interface Questions {
    /* CSS pixels from the picture's left top. Null: there is no answer, which a message says. */
    ask(x: number, y: number, through?: boolean): Promise<PickedMessage | null>;
    /* All that was asked so far has its answer: what comes now comes after it. */
    answered(): Promise<unknown>;
}

export function questions({ stores, link }: Editor, element: HTMLElement): Questions {
    let before: Promise<unknown> = Promise.resolve();
    const ask = async (x: number, y: number, through: boolean): Promise<PickedMessage | null> => {
        const { scene } = stores.document.getState();
        await whenLive(stores);
        try {
            return await link.pick(x, y, through);
        } catch {
            if (stores.document.getState().scene !== scene) {
                return null;
            }
            const message = t("view.noAnswer");
            addNotice(stores.notices, { level: "warning", code: "pick", message });
            return null;
        }
    };
    return {
        ask: (x, y, through = false) => {
            const unmark = mark(element, x, y);
            const answer = before.then(() => ask(x, y, through)).finally(unmark);
            before = answer;
            return answer;
        },
        answered: () => before,
    };
}
