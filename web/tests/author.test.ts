/* SPDX-License-Identifier: MIT */
/* One author for each open tab, the same one after a reload. */
import { expect, test } from "vitest";
import { takeAuthor } from "../src/link/author.ts";

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
    expect(other).not.toBe(first);
    tabs.close("one");
    expect(await takeAuthor(all, one, tabs.locksOf("one"))).toBe(first);
});

test("a duplicated tab is not taken for the one it was made of", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const copied = new Memory();
    const first = await takeAuthor(all, copied, tabs.locksOf("one"));
    expect(await takeAuthor(all, copied, tabs.locksOf("two"))).not.toBe(first);
});

test("a restarted browser is the author it was", async () => {
    const all = new Memory();
    const tabs = new Tabs();
    const first = await takeAuthor(all, new Memory(), tabs.locksOf("one"));
    tabs.close("one");
    expect(await takeAuthor(all, new Memory(), tabs.locksOf("two"))).toBe(first);
});

test("without locks an author lives as long as the tab", async () => {
    const all = new Memory();
    const tab = new Memory();
    const first = await takeAuthor(all, tab, undefined);
    expect(await takeAuthor(all, tab, undefined)).toBe(first);
    expect(await takeAuthor(all, new Memory(), undefined)).not.toBe(first);
});
