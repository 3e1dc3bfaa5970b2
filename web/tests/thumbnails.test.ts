/* SPDX-License-Identifier: MIT */
/* Thumbnails on the page: what the server is asked for, whose pictures change, and when they go. */
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { readTiles, type Tile, type TileKind } from "../src/link/protocol.ts";
import { ThumbnailStore } from "../src/link/thumbnails.ts";

interface Wanted {
    width: number;
    nodes: readonly string[];
    large: readonly string[];
    materials: readonly string[];
}

let sent: Wanted[] = [];
let living: Set<string>;
let made = 0;
const urls = {
    createObjectURL: () => {
        made += 1;
        living.add(`blob:${made}`);
        return `blob:${made}`;
    },
    revokeObjectURL: (url: string) => void living.delete(url),
};

function createStore(ratio = 1): ThumbnailStore {
    return new ThumbnailStore(({ wanted }) => sent.push(wanted as Wanted), ratio, urls);
}

function tile(id: string, kind: TileKind = "node", width = 96): Tile {
    return { kind, id, width, height: 64, picture: new Blob(["x"]) };
}

const ignore = (): void => undefined;

beforeEach(() => {
    vi.useFakeTimers();
    sent = [];
    living = new Set();
});
afterEach(() => vi.useRealTimers());

test("the union of what is shown is sent once it rests, and only when it differs", () => {
    const store = createStore(2);
    const ends = ["b", "a", "a"].map((id) => store.show("node", id, false, ignore));
    store.show("material", "snow", false, ignore);
    store.show("node", "a", true, ignore);
    expect(sent).toEqual([]);
    vi.runAllTimers();
    expect(sent).toEqual([{ width: 192, nodes: ["a", "b"], large: ["a"], materials: ["snow"] }]);
    ends[2]?.(); /* another shows it still */
    store.show("node", "c", false, ignore)(); /* only scrolled by */
    vi.runAllTimers();
    expect(sent.length).toBe(1);
    ends[1]?.();
    vi.runAllTimers();
    expect(sent[1]?.nodes).toEqual(["b"]);
});

test("the server's limits are kept", () => {
    const store = createStore(4);
    for (let i = 0; i < 300; i++) {
        store.show("node", `n${i}`, false, ignore);
    }
    vi.runAllTimers();
    expect(sent[0]?.nodes.length).toBe(256);
    expect(sent[0]?.width).toBe(192);
});

test("who shows a picture hears of it, others do not", () => {
    const store = createStore();
    const [a, large, ball] = [vi.fn(), vi.fn(), vi.fn()];
    store.show("node", "a", false, a);
    store.show("node", "a", true, large);
    store.show("material", "a", false, ball);
    store.take([tile("a")]);
    expect([a, large, ball].map((one) => one.mock.calls.length)).toEqual([1, 0, 0]);
    const url = store.urlOf("node", "a", false);
    expect(url).toMatch(/^blob:/);
    expect(store.urlOf("node", "a", true)).toBeNull();
    store.take([tile("a", "node", 256), tile("a", "material")]);
    expect([a, large, ball].map((one) => one.mock.calls.length)).toEqual([1, 1, 1]);
    expect(store.urlOf("node", "a", false)).toBe(url);
});

test("an old picture is released when a newer one comes, or none can be drawn", () => {
    const store = createStore();
    store.show("node", "a", false, ignore);
    store.take([tile("a")]);
    const first = store.urlOf("node", "a", false) ?? "";
    store.take([tile("a")]);
    expect(living.has(first)).toBe(false);
    expect(living.size).toBe(1);
    store.take([{ ...tile("a"), picture: null }]);
    expect(store.urlOf("node", "a", false)).toBeNull();
    expect(living.size).toBe(0);
});

test("pictures stay a while after they are shown, those shown longest", () => {
    const store = createStore();
    const end = store.show("node", "a", false, ignore);
    store.show("node", "b", false, ignore);
    store.take([tile("a"), tile("b")]);
    end();
    expect(store.urlOf("node", "a", false)).not.toBeNull();
    store.take(Array.from({ length: 600 }, (_, i) => tile(`n${i}`)));
    expect(store.urlOf("node", "a", false)).toBeNull();
    expect(store.urlOf("node", "b", false)).not.toBeNull();
    expect(living.size).toBeLessThan(520);
});

test("another scene has other pictures", () => {
    const store = createStore();
    const changed = vi.fn();
    store.show("node", "a", false, changed);
    store.take([tile("a")]);
    store.clear();
    expect(changed).toHaveBeenCalledTimes(2);
    expect(store.urlOf("node", "a", false)).toBeNull();
    expect(living.size).toBe(0);
});

/* As protocol/README.md has it. */
function pack(parts: readonly { kind: number; id: string; bytes: number[] }[]): ArrayBuffer {
    const rows = parts.flatMap(({ kind, id, bytes }) => [
        ...[kind, id.length, 96, 0, 64, 0, 0, 0, bytes.length, 0, 0, 0],
        ...new TextEncoder().encode(id),
        ...bytes,
    ]);
    const magic = [...new TextEncoder().encode("FCT1"), 1, 2, parts.length, 0];
    return new Uint8Array([...magic, 7, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, ...rows])
        .buffer;
}

test("a message of thumbnails is read, a torn one is not", async () => {
    const data = pack([
        { kind: 0, id: "ball", bytes: [1, 2, 3] },
        { kind: 1, id: "snow", bytes: [] },
    ]);
    const message = readTiles(data);
    expect(message).toMatchObject({ number: 7, revision: 9 });
    expect(message?.tiles.map(({ kind, id, width, height }) => [kind, id, width, height])).toEqual([
        ["node", "ball", 96, 64],
        ["material", "snow", 96, 64],
    ]);
    expect(message?.tiles[0]?.picture?.size).toBe(3);
    expect(message?.tiles[1]?.picture).toBeNull();
    for (let length = 0; length < data.byteLength; length++) {
        expect(readTiles(data.slice(0, length))).toBeNull();
    }
    new Uint8Array(data)[4] = 2;
    expect(readTiles(data)).toBeNull();
});
