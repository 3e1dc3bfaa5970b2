/* SPDX-License-Identifier: MIT */
/* Questions of one kind, which have numbers, and who waits for the answers. */
const ANSWER_MS = 60_000;

interface Waiter<Answer> {
    readonly take: (answer: Answer) => void;
    readonly fail: (error: Error) => void;
}

export class Questions<Answer> {
    readonly #waiters = new Map<number, Waiter<Answer>>();
    #asked = 0;

    /* Is an answer due? */
    get waiting(): boolean {
        return this.#waiters.size > 0;
    }

    ask(send: (number: number) => void): Promise<Answer> {
        this.#asked++;
        const number = this.#asked;
        send(number);
        return new Promise((take, fail) => {
            this.#waiters.set(number, { take, fail });
            setTimeout(() => {
                if (this.#waiters.delete(number)) {
                    fail(new Error("no answer"));
                }
            }, ANSWER_MS);
        });
    }

    /* The server answers only the newest of many: those before it are not waited for. */
    answer(answered: number, answer: Answer): void {
        for (const [number, { take, fail }] of [...this.#waiters]) {
            if (number === answered) {
                take(answer);
            } else if (number < answered) {
                fail(new Error("no answer"));
            }
            if (number <= answered) {
                this.#waiters.delete(number);
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
