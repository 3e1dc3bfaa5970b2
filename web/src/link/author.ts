/* SPDX-License-Identifier: MIT */
/* Who edits: an author's id, to which the server keeps what can be undone, and the key that the
 * server wants to see with it. They outlive a reload of the page and a restart of the browser; each
 * open tab holds ones of its own. */
import type { Storage } from "../model/stores.ts";

const TAB_KEY = "fieldcast.author";
const KNOWN_KEY = "fieldcast.authors";
const MOST_KNOWN = 16;
/* "yes": the page that was in this tab has left. A copy of the tab is made while it is there. */
const LEFT_KEY = "fieldcast.left";
/* It lets go of its id when it is gone. */
const LEAVING_MS = 60000;

/* As it is kept: the id, and behind a dot the key, once there is one. */
interface Kept {
    readonly id: string;
    readonly key: string | null;
}

export interface Author extends Kept {
    /* The server has told the key. */
    keep(key: string): void;
    /* The server knows the id as somebody else's: from now on another one. */
    renew(): void;
}

export function randomId(): string {
    const bytes = crypto.getRandomValues(new Uint8Array(12));
    return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

function parseKept(text: string): Kept {
    const [id = "", key = null] = text.split(".");
    return { id, key };
}

function printKept({ id, key }: Kept): string {
    return key === null ? id : `${id}.${key}`;
}

function readKnown(all: Storage): Kept[] {
    try {
        const known: unknown = JSON.parse(all.getItem(KNOWN_KEY) ?? "[]");
        return Array.isArray(known)
            ? known.filter((kept) => typeof kept === "string").map(parseKept)
            : [];
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
    own: Kept | null,
    left: boolean,
    known: readonly Kept[],
): Promise<Kept> {
    const options = left ? { signal: AbortSignal.timeout(LEAVING_MS) } : { ifAvailable: true };
    if (own !== null && (await hold(locks, own.id, options))) {
        return own;
    }
    for (const kept of known) {
        if (kept.id !== own?.id && (await hold(locks, kept.id, { ifAvailable: true }))) {
            return kept;
        }
    }
    return newcomer(locks);
}

async function newcomer(locks: LockManager): Promise<Kept> {
    const id = randomId();
    await hold(locks, id, { ifAvailable: true });
    return { id, key: null };
}

class StoredAuthor implements Author {
    readonly #all: Storage;
    readonly #tab: Storage;
    readonly #locks: LockManager | undefined;
    #kept: Kept;

    constructor(all: Storage, tab: Storage, locks: LockManager | undefined, kept: Kept) {
        this.#all = all;
        this.#tab = tab;
        this.#locks = locks;
        this.#kept = kept;
        this.#store();
    }

    get id(): string {
        return this.#kept.id;
    }

    get key(): string | null {
        return this.#kept.key;
    }

    keep(key: string): void {
        if (key !== this.#kept.key) {
            this.#kept = { ...this.#kept, key };
            this.#store();
        }
    }

    renew(): void {
        const { id } = this.#kept;
        this.#kept = { id: randomId(), key: null };
        if (this.#locks) {
            void hold(this.#locks, this.#kept.id, { ifAvailable: true });
        }
        this.#store(id);
    }

    #store(gone = ""): void {
        const text = printKept(this.#kept);
        this.#tab.setItem(TAB_KEY, text);
        if (this.#locks) {
            const others = readKnown(this.#all)
                .filter(({ id }) => id !== this.#kept.id && id !== gone)
                .map(printKept);
            this.#all.setItem(KNOWN_KEY, JSON.stringify([text, ...others].slice(0, MOST_KNOWN)));
        }
    }
}

/* `all` is kept for the browser, `tab` for this tab. `locks` is missing on pages that came over plain
 * HTTP from elsewhere: then an id lives as long as its tab. */
export async function takeAuthor(
    all: Storage,
    tab: Storage,
    locks: LockManager | undefined,
): Promise<Author> {
    const text = tab.getItem(TAB_KEY);
    const own = text === null ? null : parseKept(text);
    const left = tab.getItem(LEFT_KEY) === "yes";
    tab.setItem(LEFT_KEY, "");
    const kept = locks
        ? await firstFree(locks, own, left, readKnown(all))
        : (own ?? { id: randomId(), key: null });
    return new StoredAuthor(all, tab, locks, kept);
}

/* Tells the next page of this tab that this one has left. */
export function tellLeaving(page: EventTarget, tab: Storage): void {
    page.addEventListener("pagehide", () => tab.setItem(LEFT_KEY, "yes"));
    page.addEventListener("pageshow", () => tab.setItem(LEFT_KEY, ""));
}
