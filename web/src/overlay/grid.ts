/* SPDX-License-Identifier: MIT */
/* The ground grid over the picture. Where its guide tells how far surfaces are, they hide what is
 * behind them; while the picture moves, the grid is faint and whole. */
import { type Camera, equalCamera } from "../model/camera.ts";
import { distanceAt } from "../model/distances.ts";
import { type GridStroke, gridStrokes, type Visible } from "../model/grid.ts";
import { type Guide, shownGuide } from "../model/guide.ts";
import type { Size } from "../model/projection.ts";
import type { Stores } from "../model/stores.ts";
import { COLOR, type View } from "../model/view.ts";
import { type Brush, colorOf } from "./paint.ts";
import { drawOver, shownCamera } from "./shown.ts";

/* Parts of full opacity. */
const LIGHT = 0.42;
const AXIS = 0.75;
const DARK = 0.2;
const MOVING = 0.45;

/* A surface hides what is behind it by more than what the guide does not tell exactly. */
const SLACK = 0.004;

function seenBeside(guide: Guide, { width, height }: Size): Visible {
    return (x, y, far) => distanceAt(guide, x / width, y / height) > far * (1 - SLACK);
}

function paint(brush: Brush, strokes: readonly GridStroke[], opacity: number): void {
    for (const { axis, strength, pieces } of strokes) {
        brush.beginPath();
        for (let i = 0; i < pieces.length; i += 4) {
            brush.moveTo(pieces[i] as number, pieces[i + 1] as number);
            brush.lineTo(pieces[i + 2] as number, pieces[i + 3] as number);
        }
        brush.globalAlpha = opacity * strength * DARK;
        brush.strokeStyle = "#000";
        brush.lineWidth = axis === null ? 1.75 : 2.5;
        brush.stroke();
        brush.globalAlpha = opacity * strength * (axis === null ? LIGHT : AXIS);
        brush.strokeStyle = colorOf(axis);
        brush.lineWidth = axis === null ? 1 : 1.25;
        brush.stroke();
    }
    brush.globalAlpha = 1;
}

/* What is drawn, so that nothing is drawn twice: looking where surfaces hide lines takes longest. */
interface Drawn {
    readonly camera: Camera | null;
    readonly guide: Guide | null;
    readonly size: string;
}

const sameDrawn = (a: Drawn, b: Drawn): boolean =>
    a.guide === b.guide &&
    a.size === b.size &&
    (a.camera === b.camera || (!!a.camera && !!b.camera && equalCamera(a.camera, b.camera)));

export class Grid {
    readonly #stores: Stores;
    readonly #element: HTMLElement;
    readonly #canvas: HTMLCanvasElement;
    readonly #stops: (() => void)[] = [];
    #drawn: Drawn | null = null;

    constructor(stores: Stores, element: HTMLElement) {
        this.#stores = stores;
        this.#element = element;
        this.#canvas = document.createElement("canvas");
        this.#canvas.className = "view-grid";
        this.#canvas.setAttribute("aria-hidden", "true");
        this.#canvas.dataset.testid = "grid";
        element.append(this.#canvas);
        const draw = (): void => this.#draw();
        const observer = new ResizeObserver(draw);
        observer.observe(element);
        this.#stops.push(
            drawOver(stores, draw),
            stores.view.subscribe((now, before) => looksDiffer(now, before) && draw()),
            () => observer.disconnect(),
        );
    }

    end(): void {
        for (const stop of this.#stops) {
            stop();
        }
        this.#canvas.remove();
    }

    /* The camera of the picture, where the grid is to be shown. */
    get #camera(): Camera | null {
        const { preferences, chromeHidden, aov } = this.#stores.view.getState();
        const shown = preferences.grid && !chromeHidden && aov === COLOR;
        return shown ? shownCamera(this.#stores) : null;
    }

    #draw(): void {
        const ratio = window.devicePixelRatio;
        const { clientWidth, clientHeight } = this.#element;
        const size = { width: Math.max(1, clientWidth), height: Math.max(1, clientHeight) };
        const camera = this.#camera;
        const guide = camera && shownGuide(this.#stores.link.getState());
        const next = { camera, guide, size: `${size.width} ${size.height} ${ratio}` };
        if (this.#drawn && sameDrawn(this.#drawn, next)) {
            return;
        }
        this.#drawn = next;
        this.#canvas.width = Math.round(size.width * ratio); /* clears it */
        this.#canvas.height = Math.round(size.height * ratio);
        this.#canvas.dataset.shown = !camera ? "" : guide ? "hidden" : "whole";
        const brush = this.#canvas.getContext("2d");
        if (brush && camera) {
            brush.setTransform(ratio, 0, 0, ratio, 0, 0);
            const strokes = gridStrokes(camera, size, guide && seenBeside(guide, size));
            paint(brush, strokes, guide ? 1 : MOVING);
        }
    }
}

function looksDiffer(now: View, before: View): boolean {
    return (
        now.aov !== before.aov ||
        now.chromeHidden !== before.chromeHidden ||
        now.preferences.grid !== before.preferences.grid
    );
}
