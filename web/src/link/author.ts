/* SPDX-License-Identifier: MIT */
/* Who edits: an author's id, to which the server keeps what can be undone. It outlives a reload of
 * the page and a restart of the browser; each open tab holds one of its own. */
import type { Storage } from "../model/stores.ts";

const TAB_KEY = "fieldcast.author";
const KNOWN_KEY = "fieldcast.authors";
const MOST_KNOWN = 16;
/* The page before a reload lets go of its id when it is gone. */
const RELOAD_MS = 1000;

export function randomId(): string {
    const bytes = crypto.getRandomValues(new Uint8Array(12));
    return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

function readKnown(all: Storage): string[] {
    try {
        const known: unknown = JSON.parse(all.getItem(KNOWN_KEY) ?? "[]");
        return Array.isArray(known) ? known.filter((id) => typeof id === "string") : [];
    } catch {
        return [];
    }
}

/* Holds the id as long as the page lives; false where another tab does. */
function hold(locks: LockManager, id: string, options: LockOptions): Promise<boolean> {
    return new Promise((resolve) => {
        locks
            .request(`${TAB_KEY}.${id}`, options, (lock) => {
                resolve(lock !== null);
                return lock === null ? undefined : new Promise<void>(() => undefined);
            })
            .catch(() => resolve(false));
    });
}

async function firstFree(
    locks: LockManager,
    own: string | null,
    known: readonly string[],
): Promise<string> {
    if (own !== null && (await hold(locks, own, { signal: AbortSignal.timeout(RELOAD_MS) }))) {
        return own;
    }
    for (const id of known) {
        if (id !== own && (await hold(locks, id, { ifAvailable: true }))) {
            return id;
        }
    }
    const id = randomId();
    await hold(locks, id, { ifAvailable: true });
    return id;
}

/* `all` is kept for the browser, `tab` for this tab. `locks` is missing on pages that came over plain
 * HTTP from elsewhere: then an id lives as long as its tab. */
export async function takeAuthor(
    all: Storage,
    tab: Storage,
    locks: LockManager | undefined,
): Promise<string> {
    const own = tab.getItem(TAB_KEY);
    const known = readKnown(all);
    const id = locks ? await firstFree(locks, own, known) : (own ?? randomId());
    tab.setItem(TAB_KEY, id);
    if (locks) {
        const others = readKnown(all).filter((one) => one !== id);
        all.setItem(KNOWN_KEY, JSON.stringify([id, ...others].slice(0, MOST_KNOWN)));
    }
    return id;
}
