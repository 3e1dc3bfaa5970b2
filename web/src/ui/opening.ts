/* SPDX-License-Identifier: MIT */
/* Opens a scene in place of the one before. What ends after its scene was left has no effect. */
import type { Author } from "../link/author.ts";
import type { Link } from "../link/link.ts";
import { type Rest, RestError } from "../link/rest.ts";
import { EMPTY_SCHEMA, outputsShown, type Schema } from "../model/schema.ts";
import type { Stores } from "../model/stores.ts";
import { COLOR, INITIAL_VIEW } from "../model/view.ts";

/* Between attempts to read the schema. */
const RETRY_MS = 2000;
/* Answers that waiting will not change. */
const FINAL_STATUS: readonly number[] = [401, 403];

interface Parts {
    readonly stores: Stores;
    readonly link: Pick<Link, "connect" | "disconnect" | "retry">;
    readonly rest: Pick<Rest, "readSchema">;
}

/* Tells later whether the scene that is open now still is. */
export function sceneKept({ stores }: Pick<Parts, "stores">): () => boolean {
    const { scene } = stores.document.getState();
    return () => stores.document.getState().scene === scene;
}

export class Opener {
    readonly #parts: Parts;
    readonly #author: Promise<Author>;
    #opened = 0;
    /* Ends the wait before the next attempt. */
    #hurry: (() => void) | null = null;

    constructor(parts: Parts, author: Promise<Author>) {
        this.#parts = parts;
        this.#author = author;
    }

    /* Null closes the scene that is open. */
    async open(scene: string | null): Promise<void> {
        this.#opened++;
        const opening = this.#opened;
        const { stores, link } = this.#parts;
        link.disconnect();
        stores.view.setState(({ aov, preferences }) => ({ ...INITIAL_VIEW, aov, preferences }));
        this.#hurry?.();
        if (scene === null) {
            return;
        }
        const schema = await this.#schema(opening);
        const author = await this.#author;
        if (schema !== null && opening === this.#opened) {
            this.#chooseOutput(schema);
            link.connect(scene, schema, author);
        }
    }

    /* Tries to connect at once instead of waiting for the next attempt. */
    retry(): void {
        if (this.#hurry) {
            this.#hurry();
        } else {
            this.#parts.link.retry();
        }
    }

    /* Null where another scene was opened meanwhile. */
    async #schema(opening: number): Promise<Schema | null> {
        const { stores, rest } = this.#parts;
        const { schema } = stores.document.getState();
        if (schema !== EMPTY_SCHEMA) {
            return schema;
        }
        while (opening === this.#opened) {
            try {
                return await rest.readSchema();
            } catch (error) {
                if (opening === this.#opened) {
                    await this.#wait(error);
                }
            }
        }
        return null;
    }

    /* Says that there is no connection yet, and waits for the time of the next attempt. */
    #wait(error: unknown): Promise<void> {
        const final = error instanceof RestError && FINAL_STATUS.includes(error.status);
        const reason = error instanceof Error ? error.message : String(error);
        this.#parts.stores.link.setState({
            connection: final ? "refused" : "offline",
            reason,
            retryAt: final ? null : performance.now() + RETRY_MS,
        });
        return new Promise((resolve) => {
            const end = (): void => {
                clearTimeout(timer);
                this.#hurry = null;
                resolve();
            };
            const timer = final ? undefined : setTimeout(end, RETRY_MS);
            this.#hurry = end;
        });
    }

    /* One that the server does not have gives way to colour. */
    #chooseOutput(schema: Schema): void {
        const { view } = this.#parts.stores;
        const { aov } = view.getState();
        if (!outputsShown(schema).some(({ name }) => name === aov)) {
            view.setState({ aov: COLOR });
        }
    }
}
