/* SPDX-License-Identifier: MIT */
/* The picture's canvas in the page: its size in device pixels, whether anybody can see it. */

export interface PictureSize {
    /* Device pixels, as the server is asked for. */
    readonly width: number;
    readonly height: number;
}

/* Largest side of a live view (limit view_side); a larger element is shown magnified. */
const LONGEST_SIDE = 4096;

export function fitSize(width: number, height: number): PictureSize {
    const shrink = Math.min(1, LONGEST_SIDE / Math.max(width, height, 1));
    const side = (x: number): number => Math.max(1, Math.round(x * shrink));
    return { width: side(width), height: side(height) };
}

/* Device pixels of a box; exact where the browser tells them. */
function sizeOf(entry: ResizeObserverEntry): PictureSize {
    const exact = entry.devicePixelContentBoxSize?.[0];
    if (exact) {
        return fitSize(exact.inlineSize, exact.blockSize);
    }
    const ratio = window.devicePixelRatio;
    return fitSize(entry.contentRect.width * ratio, entry.contentRect.height * ratio);
}

/* Puts a canvas into `element` and tells its size, now and at every change. The function answered
 * takes it away again. A canvas can be handed over only once, so each mounting makes one. */
export function mountPicture(
    element: HTMLElement,
    onSize: (size: PictureSize) => void,
): { readonly canvas: HTMLCanvasElement; readonly unmount: () => void } {
    const canvas = document.createElement("canvas");
    canvas.style.cssText = "display:block;width:100%;height:100%";
    canvas.setAttribute("aria-hidden", "true");
    element.prepend(canvas);
    const observer = new ResizeObserver((entries) => {
        const entry = entries.at(-1);
        if (entry && entry.contentRect.width > 0 && entry.contentRect.height > 0) {
            onSize(sizeOf(entry));
        }
    });
    try {
        observer.observe(element, { box: "device-pixel-content-box" });
    } catch {
        observer.observe(element);
    }
    return {
        canvas,
        unmount: () => {
            observer.disconnect();
            canvas.remove();
        },
    };
}
