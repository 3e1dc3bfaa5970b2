/* SPDX-License-Identifier: MIT */
/* Small pictures of nodes and materials. Whoever shows one says so, and the server is told of all of
 * them together; it sends those that look different. Pictures stay here as blob URLs, also a while
 * after nobody shows them, until the scene is closed. Outside React: a component subscribes to its
 * own picture alone. */
import type { Order } from "./engine.ts";
import type { Tile, TileKind } from "./protocol.ts";

export interface Thumbnails {
    /* Shows one from now on; answers the function that ends it. `large`: 256 instead of 96 pixels
     * wide in CSS. `changed` is called with every new picture. */
    show(kind: TileKind, id: string, large: boolean, changed: () => void): () => void;
    /* A URL for an image. Null: there is none yet, or it cannot be drawn. */
    urlOf(kind: TileKind, id: string, large: boolean): string | null;
}

/* CSS pixels. The height is 2/3 of it. */
export const TILE_WIDTH = 96;
/* Rows that scroll by come and go; the server is told once they rest. */
const SETTLE_MS = 60;
/* As the server's limits have them: ids of one list, device pixels. */
const MOST_IDS = 256;
const MOST_WIDTH = 192;
/* That nobody shows are kept up to this many. */
const KEPT = 512;

/* What can make URLs of pictures; the browser's URL fits. */
export interface Urls {
    createObjectURL(blob: Blob): string;
    revokeObjectURL(url: string): void;
}

interface Shown {
    readonly kind: TileKind;
    readonly id: string;
    readonly large: boolean;
    readonly listeners: Set<() => void>;
}

function keyOf(kind: TileKind, id: string, large: boolean): string {
    return `${kind} ${large ? "large" : "small"} ${id}`;
}

export class ThumbnailStore implements Thumbnails {
    readonly #send: (order: Order & { kind: "thumbnails" }) => void;
    readonly #width: number;
    readonly #urls: Urls;
    readonly #shown = new Map<string, Shown>();
    /* By key, the oldest first; null: cannot be drawn. */
    readonly #pictures = new Map<string, string | null>();
    #timer: ReturnType<typeof setTimeout> | null = null;
    #told = "";

    /* `ratio`: device pixels of a CSS pixel. */
    constructor(
        send: (order: Order & { kind: "thumbnails" }) => void,
        ratio: number,
        urls: Urls = URL,
    ) {
        this.#send = send;
        this.#width = Math.min(MOST_WIDTH, Math.round(TILE_WIDTH * Math.max(1, ratio)));
        this.#urls = urls;
    }

    show(kind: TileKind, id: string, large: boolean, changed: () => void): () => void {
        const key = keyOf(kind, id, large);
        const shown = this.#shown.get(key) ?? { kind, id, large, listeners: new Set() };
        this.#shown.set(key, shown);
        const listener = (): void => changed(); /* one for each call */
        shown.listeners.add(listener);
        this.#tellSoon();
        return () => {
            shown.listeners.delete(listener);
            if (shown.listeners.size === 0 && this.#shown.get(key) === shown) {
                this.#shown.delete(key);
                this.#tellSoon();
            }
        };
    }

    urlOf(kind: TileKind, id: string, large: boolean): string | null {
        return this.#pictures.get(keyOf(kind, id, large)) ?? null;
    }

    /* Pictures from the server. */
    take(tiles: readonly Tile[]): void {
        for (const { kind, id, width, picture } of tiles) {
            const key = keyOf(kind, id, width > this.#width);
            this.#drop(key);
            this.#pictures.set(key, picture && this.#urls.createObjectURL(picture));
            for (const changed of this.#shown.get(key)?.listeners ?? []) {
                changed();
            }
        }
        this.#dropOld();
    }

    /* Another scene: its ids mean something else. */
    clear(): void {
        for (const key of [...this.#pictures.keys()]) {
            this.#drop(key);
        }
        for (const { listeners } of this.#shown.values()) {
            for (const changed of listeners) {
                changed();
            }
        }
    }

    #drop(key: string): void {
        const url = this.#pictures.get(key);
        if (typeof url === "string") {
            this.#urls.revokeObjectURL(url);
        }
        this.#pictures.delete(key);
    }

    #dropOld(): void {
        let left = this.#pictures.size - this.#shown.size - KEPT;
        for (const key of [...this.#pictures.keys()]) {
            if (left > 0 && !this.#shown.has(key)) {
                this.#drop(key);
                left--;
            }
        }
    }

    #tellSoon(): void {
        this.#timer ??= setTimeout(() => {
            this.#timer = null;
            this.#tell();
        }, SETTLE_MS);
    }

    #tell(): void {
        const ids = (kind: TileKind, large: boolean): string[] =>
            [...this.#shown.values()]
                .filter((one) => one.kind === kind && one.large === large)
                .map(({ id }) => id)
                .sort()
                .slice(0, MOST_IDS);
        const wanted = {
            width: this.#width,
            nodes: ids("node", false),
            large: ids("node", true),
            materials: ids("material", false),
        };
        const text = JSON.stringify(wanted);
        if (text !== this.#told) {
            this.#told = text;
            this.#send({ kind: "thumbnails", wanted });
        }
    }
}
