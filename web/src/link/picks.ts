/* SPDX-License-Identifier: MIT */
/* Questions about what lies under a pixel, and who waits for the answers. */
import type { Host } from "./host.ts";
import type { PickedMessage } from "./protocol.ts";

const ANSWER_MS = 60_000;

interface Waiter {
    readonly take: (message: PickedMessage) => void;
    readonly fail: (error: Error) => void;
}

export class Picks {
    readonly #host: Host;
    readonly #waiters = new Map<number, Waiter>();
    #asked = 0;

    constructor(host: Host) {
        this.#host = host;
    }

    /* Is an answer due? */
    get waiting(): boolean {
        return this.#waiters.size > 0;
    }

    ask(
        { x, y }: { readonly x: number; readonly y: number },
        through: boolean,
    ): Promise<PickedMessage> {
        this.#asked++;
        const pick = this.#asked;
        this.#host.send({ kind: "pick", pick, x, y, through });
        return new Promise((take, fail) => {
            this.#waiters.set(pick, { take, fail });
            setTimeout(() => {
                if (this.#waiters.delete(pick)) {
                    fail(new Error("no answer"));
                }
            }, ANSWER_MS);
        });
    }

    /* The server answers only the newest of many: those before it are not waited for. */
    answer(message: PickedMessage): void {
        for (const [pick, { take, fail }] of [...this.#waiters]) {
            if (pick === message.pick) {
                take(message);
            } else if (pick < message.pick) {
                fail(new Error("no answer"));
            }
            if (pick <= message.pick) {
                this.#waiters.delete(pick);
            }
        }
    }

    /* The connection is gone, and no answer will come. */
    fail(): void {
        for (const { fail } of this.#waiters.values()) {
            fail(new Error("not connected"));
        }
        this.#waiters.clear();
    }
}
