/* SPDX-License-Identifier: MIT */
/* Draws frames on the picture's canvas. The canvas has the size of the view in device pixels
 * whatever the resolution of the frame, so that the picture never changes size or place. */
import type { FrameHeader } from "./protocol.ts";
import { type Moved, Warp } from "./warp.ts";

/* The common part of HTMLCanvasElement and OffscreenCanvas. */
export interface Surface {
    width: number;
    height: number;
    getContext(kind: "2d", settings: { alpha: boolean }): Brush | null;
}

/* Left, top, width and height, in the image and on the surface. */
type Columns = [number, number, number, number, number, number, number, number];

interface Brush {
    imageSmoothingEnabled: boolean;
    imageSmoothingQuality: "low" | "medium" | "high";
    drawImage(
        image: ImageBitmap | OffscreenCanvas,
        x: number,
        y: number,
        width: number,
        height: number,
    ): void;
    drawImage(image: ImageBitmap, ...fromAndTo: Columns): void;
    clearRect(x: number, y: number, width: number, height: number): void;
}

export class Presenter {
    #surface: Surface | null = null;
    #brush: Brush | null = null;
    #bitmap: ImageBitmap | null = null;
    #header: FrameHeader | null = null;
    #moved: Moved | null = null;
    /* Undefined: not asked for yet. */
    #warp: Warp | null | undefined;
    #width = 1;
    #height = 1;

    setSurface(surface: Surface | null): void {
        this.#surface = surface;
        this.#brush = surface?.getContext("2d", { alpha: false }) ?? null;
        this.#fit();
    }

    /* Device pixels of the view. The last frame stays, scaled about its centre. */
    resize(width: number, height: number): void {
        this.#width = width;
        this.#height = height;
        this.#fit();
    }

    /* Shows a frame; owns the bitmap from now on. `moved`: null, as it is. */
    show(bitmap: ImageBitmap, header: FrameHeader, moved: Moved | null): void {
        this.#bitmap?.close();
        this.#bitmap = bitmap;
        this.#header = header;
        this.move(moved);
    }

    canMove(): boolean {
        if (this.#warp === undefined) {
            this.#warp = Warp.create();
        }
        return this.#warp !== null && !this.#warp.isLost();
    }

    /* Shows the same frame as another camera sees it. */
    move(moved: Moved | null): void {
        this.#moved = moved;
        this.#draw();
    }

    clear(): void {
        this.#bitmap?.close();
        this.#bitmap = null;
        this.#header = null;
        this.#moved = null;
        this.#brush?.clearRect(0, 0, this.#width, this.#height);
    }

    #fit(): void {
        const surface = this.#surface;
        if (surface && (surface.width !== this.#width || surface.height !== this.#height)) {
            surface.width = this.#width;
            surface.height = this.#height;
        }
        this.#draw();
    }

    #draw(): void {
        const [brush, bitmap, header] = [this.#brush, this.#bitmap, this.#header];
        if (!brush || !bitmap || !header) {
            return;
        }
        const warped =
            this.#moved && this.#warp?.draw(bitmap, this.#moved, this.#width, this.#height);
        if (warped) {
            brush.imageSmoothingEnabled = false;
            brush.drawImage(warped, 0, 0, this.#width, this.#height);
            return;
        }
        /* The field of view is vertical: a frame of another view keeps its height. */
        const scale = this.#height / Math.max(1, header.viewHeight);
        const width = header.viewWidth * scale;
        const left = (this.#width - width) / 2;
        if (left > 0) {
            this.#drawEdges(brush, bitmap, left);
        }
        brush.imageSmoothingEnabled = bitmap.width !== width || bitmap.height !== this.#height;
        brush.imageSmoothingQuality = "low";
        brush.drawImage(bitmap, left, 0, width, this.#height);
    }

    /* Beside a narrower frame its outermost columns go on until the next frame. */
    #drawEdges(brush: Brush, bitmap: ImageBitmap, left: number): void {
        for (const [from, to] of [
            [0, 0],
            [bitmap.width - 1, this.#width - left],
        ] as const) {
            brush.drawImage(bitmap, from, 0, 1, bitmap.height, to, 0, left, this.#height);
        }
    }
}
