/* SPDX-License-Identifier: MIT */
/* Whether a hand moves the camera or a value: it does from each touch on for a short while. */
import type { Stores } from "../model/stores.ts";

const REST_MS = 200;

export class Motion {
    readonly #stores: Stores;
    readonly #stop: () => void;
    #timer: ReturnType<typeof setTimeout> | null = null;

    constructor(stores: Stores) {
        this.#stores = stores;
        this.#stop = stores.camera.subscribe((now, before) => {
            if (now.own && now.camera !== before.camera) {
                this.touch();
            }
        });
    }

    touch(): void {
        if (this.#timer === null) {
            this.#stores.link.setState({ moving: true });
        } else {
            clearTimeout(this.#timer);
        }
        this.#timer = setTimeout(() => {
            this.#timer = null;
            this.#stores.link.setState({ moving: false });
        }, REST_MS);
    }

    end(): void {
        this.#stop();
        if (this.#timer !== null) {
            clearTimeout(this.#timer);
        }
    }
}
