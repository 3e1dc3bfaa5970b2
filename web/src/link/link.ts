/* SPDX-License-Identifier: MIT */
/* The page's side of a live scene: connects, edits, picks, shows. Keeps the stores up to date.
 * Socket, decoding and presentation run in a worker where the browser allows it. */
import type { Operation } from "../model/operations.ts";
import type { Schema } from "../model/schema.ts";
import type { Stores } from "../model/stores.ts";
import type { PickedMessage } from "./protocol.ts";

export interface EditOptions {
    /* Edits of one group are one undo step. */
    readonly group?: string;
    /* What the undo entry is called: "move head". */
    readonly label?: string;
}

/* One drag, one undo step: shown at once, sent at most once per animation frame. */
export interface Gesture {
    readonly group: string;
    /* False where the edit cannot be; the reason is in the notices. */
    edit(ops: readonly Operation[]): boolean;
    end(): void;
    /* Takes back everything that the gesture did. */
    cancel(): void;
}

export interface Link {
    /* Opens a scene; closes the one before. Needs the schema to know what may be set. */
    connect(scene: string, schema: Schema): void;
    disconnect(): void;
    /* Shows the picture in `element`, filling it; answers the function that takes it away. */
    attach(element: HTMLElement): () => void;
    /* Shows and sends an edit. False where it cannot be; the reason is in the notices. */
    edit(ops: readonly Operation[], options?: EditOptions): boolean;
    gesture(label: string): Gesture;
    undo(): void;
    redo(): void;
    /* What lies under a point of the picture, in CSS pixels from its left top. */
    pick(x: number, y: number): Promise<PickedMessage>;
    /* Tries to connect at once instead of waiting for the next attempt. */
    retry(): void;
    destroy(): void;
}

export interface LinkOptions {
    /* Address of the server, such as "http://127.0.0.1:8080"; "" is the page's own. */
    readonly base: string;
    readonly token: string | null;
    /* Shown to others. */
    readonly name?: string;
}

export function createLink(_stores: Stores, _options: LinkOptions): Link {
    throw new Error("not connected");
}
