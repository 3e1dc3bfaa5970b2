/* SPDX-License-Identifier: MIT */
/* The camera of the picture that is shown, for all that the page draws over it. */
import type { Camera } from "../model/camera.ts";
import { type Guide, nodeAt, shownGuide } from "../model/guide.ts";
import type { Spot } from "../model/projection.ts";
import type { Stores } from "../model/stores.ts";

/* Null while there is no picture. */
export function shownCamera({ link, camera }: Stores): Camera | null {
    const { frame } = link.getState();
    return frame.state === "none" ? null : (frame.camera ?? camera.getState().saved);
}

/* The node at a point of the picture's element, in CSS pixels from its left top, as the guide of the
 * picture tells it; null: none. Undefined: there is no guide, and it must be asked. */
export function guideAt(
    { link }: Stores,
    element: HTMLElement,
    { x, y }: Spot,
): string | null | undefined {
    const guide = shownGuide(link.getState());
    return guide === null
        ? undefined
        : nodeAt(guide, x / element.clientWidth, y / element.clientHeight);
}

/* Calls `take` with the guide of the picture, now or when it is there, unless the camera or the scene
 * changes first. */
export function whenGuide(stores: Stores, take: (guide: Guide) => void): void {
    const { link, camera, document } = stores;
    const { scene } = document.getState();
    const now = shownGuide(link.getState());
    if (now !== null) {
        take(now);
        return;
    }
    const stop = (): void => {
        for (const end of ends) {
            end();
        }
    };
    const ends = [
        camera.subscribe(stop),
        document.subscribe((state) => state.scene !== scene && stop()),
        link.subscribe((state) => {
            const guide = shownGuide(state);
            if (guide !== null) {
                stop();
                take(guide);
            }
        }),
    ];
}

/* Runs `draw` now, and in the next animation frame after the picture, its guide, the camera or the
 * document has changed. Answers the function that ends it. */
export function drawOver(stores: Stores, draw: () => void): () => void {
    let asked = 0;
    const ask = (): void => {
        if (asked === 0) {
            asked = requestAnimationFrame(() => {
                asked = 0;
                draw();
            });
        }
    };
    const stops = [
        stores.document.subscribe((now, before) => now.document !== before.document && ask()),
        stores.link.subscribe(
            (now, before) => (now.frame !== before.frame || now.guide !== before.guide) && ask(),
        ),
        stores.camera.subscribe(ask),
    ];
    draw();
    return () => {
        cancelAnimationFrame(asked);
        for (const stop of stops) {
            stop();
        }
    };
}
