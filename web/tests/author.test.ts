/* SPDX-License-Identifier: MIT */
/* One author for each open tab, the same one after a reload. */
import { expect, test } from "vitest";
import { takeAuthor, tellLeaving } from "../src/link/author.ts";

class Memory {
    readonly #items = new Map<string, string>();
    getItem(key: string): string | null {
        return this.#items.get(key) ?? null;
    }
    setItem(key: string, value: string): void {
        this.#items.set(key, value);
    }
}

/* The browser's locks: a tab that closes lets go of all that it holds. */
class Tabs {
    readonly held = new Map<string, string>();

    locksOf(tab: string): LockManager {
        const request = async (
            name: string,
            _options: LockOptions,
            callback: (lock: Lock | null) => unknown,
        ): Promise<unknown> => {
            if (this.held.has(name)) {
                return _options.ifAvailable ? callback(null) : Promise.reject(new Error("waited"));
            }
            this.held.set(name, tab);
            return callback({ name, mode: "exclusive" });
        };
        return { request } as unknown as LockManager;
    }

    close(tab: string): void {
        for (const [name, holder] of this.held) {
            if (holder === tab) {
                this.held.delete(name);
            }
        }
    }
}

test("a reloaded tab keeps its author, another open tab has its own", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const one = new Memory();
    const first = await takeAuthor(all, one, tabs.locksOf("one"));
    const other = await takeAuthor(all, new Memory(), tabs.locksOf("two"));
    expect(other.id).not.toBe(first.id);
    tabs.close("one");
    expect((await takeAuthor(all, one, tabs.locksOf("one"))).id).toBe(first.id);
});

test("a reloaded tab waits for the page before it, however long that takes to go", async () => {
    const all = new Memory();
    const tab = new Memory();
    const tabs = new Tabs();
    const page = new EventTarget();
    const first = await takeAuthor(all, tab, tabs.locksOf("old"));
    tellLeaving(page, tab);
    page.dispatchEvent(new Event("pagehide"));
    let gone = (): void => undefined;
    const leaving = new Promise<void>((resolve) => {
        gone = resolve;
    });
    const waiting = {
        request: async (
            name: string,
            options: LockOptions,
            callback: LockGrantedCallback<unknown>,
        ) => {
            await (options.ifAvailable ? undefined : leaving);
            return tabs.locksOf("new").request(name, options, callback);
        },
    } as unknown as LockManager;
    const second = takeAuthor(all, tab, waiting);
    tabs.close("old");
    gone();
    expect((await second).id).toBe(first.id);
    page.dispatchEvent(new Event("pageshow"));
    expect((await takeAuthor(all, tab, tabs.locksOf("copy"))).id).not.toBe(first.id);
});

test("a duplicated tab is not taken for the one it was made of", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const copied = new Memory();
    const first = await takeAuthor(all, copied, tabs.locksOf("one"));
    expect((await takeAuthor(all, copied, tabs.locksOf("two"))).id).not.toBe(first.id);
});

test("a restarted browser is the author it was", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const first = await takeAuthor(all, new Memory(), tabs.locksOf("one"));
    tabs.close("one");
    expect((await takeAuthor(all, new Memory(), tabs.locksOf("two"))).id).toBe(first.id);
});

test("without locks an author lives as long as the tab", async () => {
    const all = new Memory();
    const tab = new Memory();
    const first = await takeAuthor(all, tab, undefined);
    expect((await takeAuthor(all, tab, undefined)).id).toBe(first.id);
    expect((await takeAuthor(all, new Memory(), undefined)).id).not.toBe(first.id);
});

const KEY = "0123456789abcdef".repeat(2);

test("the key stays beside its author, in the tab and in the browser", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const one = new Memory();
    const first = await takeAuthor(all, one, tabs.locksOf("one"));
    expect(first.key).toBe(null);
    first.keep(KEY);
    tabs.close("one");
    const reloaded = await takeAuthor(all, one, tabs.locksOf("one"));
    expect([reloaded.id, reloaded.key]).toEqual([first.id, KEY]);
    tabs.close("one");
    const restarted = await takeAuthor(all, new Memory(), tabs.locksOf("two"));
    expect([restarted.id, restarted.key]).toEqual([first.id, KEY]);
    const other = await takeAuthor(all, new Memory(), tabs.locksOf("three"));
    expect([other.id === first.id, other.key]).toEqual([false, null]);
});

test("an author from before there were keys has none", async () => {
    const all = new Memory();
    all.setItem("fieldcast.authors", JSON.stringify(["old-author"]));
    const author = await takeAuthor(all, new Memory(), new Tabs().locksOf("one"));
    expect([author.id, author.key]).toEqual(["old-author", null]);
});

test("an author whose id is somebody else's is never taken again", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const one = new Memory();
    const author = await takeAuthor(all, one, tabs.locksOf("one"));
    const { id } = author;
    author.keep(KEY);
    author.renew();
    expect([author.id === id, author.key]).toEqual([false, null]);
    tabs.close("one");
    expect((await takeAuthor(all, one, tabs.locksOf("one"))).id).toBe(author.id);
    tabs.close("one");
    const next = await takeAuthor(all, new Memory(), tabs.locksOf("two"));
    const later = await takeAuthor(all, new Memory(), tabs.locksOf("three"));
    expect([next.id, later.id]).not.toContain(id);
});
