/* SPDX-License-Identifier: MIT */
/* What the user looks at, and from where: the picture's element and the camera. Tells the engine
 * what to ask for, whenever that changes. Knows nothing of edits. */
import { cameraOf, equalCamera, printCamera } from "../model/camera.ts";
import type { SceneDocument } from "../model/document.ts";
import type { Value, Values } from "../model/schema.ts";
import { sectionMember } from "../model/section.ts";
import type { Stores } from "../model/stores.ts";
import type { ViewState } from "./engine.ts";
import type { Host } from "./host.ts";
import { mountPicture, type PictureSize } from "./picture.ts";

export class Viewer {
    readonly #stores: Stores;
    readonly #host: Host;
    readonly #isOpen: () => boolean;
    readonly #stops: (() => void)[] = [];
    #element: HTMLElement | null = null;
    #size: PictureSize | null = null;

    /* Nothing is told while no scene `isOpen`. */
    constructor(stores: Stores, host: Host, isOpen: () => boolean) {
        this.#stores = stores;
        this.#host = host;
        this.#isOpen = isOpen;
        const tell = (): void => this.tell();
        document.addEventListener("visibilitychange", tell);
        this.#stops.push(
            stores.camera.subscribe((now, before) => {
                if (!now.own && before.own) {
                    this.followCamera();
                }
                this.tell();
            }),
            stores.view.subscribe((now, before) => {
                const { quality } = now.preferences;
                if (
                    now.aov !== before.aov ||
                    now.isolated !== before.isolated ||
                    now.section !== before.section ||
                    quality !== before.preferences.quality
                ) {
                    this.tell();
                }
            }),
            stores.document.subscribe(({ document: shown }, before) => {
                if (shown && shown !== before.document) {
                    this.#dropDeleted(shown);
                }
            }),
            () => document.removeEventListener("visibilitychange", tell),
        );
    }

    end(): void {
        for (const stop of this.#stops) {
            stop();
        }
    }

    /* Until the user looks around, the camera is the document's; then all but its place is. */
    followCamera(): void {
        const { document: shown, schema } = this.#stores.document.getState();
        const { camera, own, saved } = this.#stores.camera.getState();
        if (!shown) {
            return;
        }
        const defaults: Record<string, Value> = {};
        for (const param of schema.camera) {
            defaults[param.name] = param.default;
        }
        const { position, target, up } = camera;
        const now = cameraOf(shown.camera, defaults as Values);
        const followed = { ...now, ...(own ? { position, target, up } : {}) };
        const changed = !equalCamera(camera, followed);
        if (changed || !equalCamera(saved, now)) {
            this.#stores.camera.setState({ camera: changed ? followed : camera, saved: now });
        }
        this.tell();
    }

    /* A node that was deleted is isolated no longer. */
    #dropDeleted(shown: SceneDocument): void {
        const { isolated } = this.#stores.view.getState();
        const left = isolated.filter((id) => shown.nodes.has(id));
        if (left.length < isolated.length) {
            this.#stores.view.setState({ isolated: left });
        }
    }

    tell(): void {
        if (!this.#isOpen() || !this.#size) {
            return;
        }
        const { aov, isolated, preferences, section } = this.#stores.view.getState();
        const { camera, own } = this.#stores.camera.getState();
        const view: ViewState = {
            width: this.#size.width,
            height: this.#size.height,
            ...(own ? { camera: printCamera(camera) } : {}),
            aov,
            quality: preferences.quality,
            visible: document.visibilityState === "visible" && this.#element !== null,
            guides: true,
            ...(isolated.length > 0 ? { isolate: isolated } : {}),
            ...sectionMember(section),
        };
        this.#host.send({ kind: "view", view, camera });
    }

    /* Shows the picture in `element`; answers the function that takes it away. */
    attach(element: HTMLElement): () => void {
        const { canvas, unmount } = mountPicture(element, (size) => {
            this.#size = size;
            this.tell();
        });
        this.#element = element;
        this.#host.setCanvas(canvas);
        this.tell();
        return () => {
            unmount();
            if (this.#element === element) {
                this.#element = null;
                this.#host.setCanvas(null);
                this.tell();
            }
        };
    }

    /* The pixel under a point in CSS pixels; null while nothing is shown. */
    pixelAt(x: number, y: number): { readonly x: number; readonly y: number } | null {
        const element = this.#element;
        const size = this.#size;
        if (!element || !size) {
            return null;
        }
        const pixel = (at: number, css: number, device: number): number =>
            Math.min(device - 1, Math.max(0, Math.floor((at / Math.max(1, css)) * device)));
        return {
            x: pixel(x, element.clientWidth, size.width),
            y: pixel(y, element.clientHeight, size.height),
        };
    }
}
