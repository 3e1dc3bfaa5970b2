/* SPDX-License-Identifier: MIT */
/* Outlines of what is selected and of what is under the pointer, from the guide of the picture shown:
 * they are drawn while the picture rests, and cost the server nothing. */
import { preorder } from "../model/document.ts";
import { type Guide, type Mask, maskOf, shownGuide } from "../model/guide.ts";
import type { Stores } from "../model/stores.ts";
import type { View } from "../model/view.ts";
import type { Brush } from "./paint.ts";
import { drawOver } from "./shown.ts";

interface Look {
    readonly color: string;
    /* CSS pixels. */
    readonly width: number;
}

const SELECTED: Look = { color: "#ffb454", width: 2 };
const HOVERED: Look = { color: "rgb(255 255 255 / 85%)", width: 1 };
const HALO: Look = { color: "rgb(0 0 0 / 50%)", width: 1.25 };
/* A mask that is drawn around itself in so many directions is one with a round edge. */
const DIRECTIONS = 16;

/* A canvas that nobody sees. */
function sheet(width: number, height: number): { canvas: OffscreenCanvas; brush: Painter } | null {
    const canvas = new OffscreenCanvas(Math.max(1, width), Math.max(1, height));
    const brush = canvas.getContext("2d");
    return brush && { canvas, brush };
}
type Painter = OffscreenCanvasRenderingContext2D;

function stencilOf(mask: Mask): OffscreenCanvas | null {
    const made = sheet(mask.width, mask.height);
    made?.brush.putImageData(new ImageData(mask.pixels, mask.width, mask.height), 0, 0);
    return made?.canvas ?? null;
}

/* Where a mask is on the canvas, in its pixels. */
interface Place {
    readonly x: number;
    readonly y: number;
    readonly width: number;
    readonly height: number;
}

/* A band of a colour around the mask, none of it inside. */
function band(brush: Painter, stencil: OffscreenCanvas, at: Place, color: string, wide: number) {
    brush.globalCompositeOperation = "source-over";
    for (let i = 0; i < DIRECTIONS; i++) {
        const angle = (2 * Math.PI * i) / DIRECTIONS;
        const [dx, dy] = [wide * Math.cos(angle), wide * Math.sin(angle)];
        brush.drawImage(stencil, at.x + dx, at.y + dy, at.width, at.height);
    }
    brush.globalCompositeOperation = "source-in";
    brush.fillStyle = color;
    brush.fillRect(0, 0, brush.canvas.width, brush.canvas.height);
    brush.globalCompositeOperation = "destination-out";
    brush.drawImage(stencil, at.x, at.y, at.width, at.height);
}

function outline(brush: Brush, guide: Guide, nodes: ReadonlySet<string>, look: Look): void {
    const mask = maskOf(guide, nodes);
    const stencil = mask && stencilOf(mask);
    if (!mask || !stencil) {
        return;
    }
    const { width, height } = brush.canvas;
    const [sx, sy] = [width / guide.width, height / guide.height];
    const ratio = window.devicePixelRatio;
    const margin = Math.ceil((look.width + HALO.width) * ratio) + 1;
    const at = { x: margin, y: margin, width: mask.width * sx, height: mask.height * sy };
    for (const [color, wide] of [
        [HALO.color, look.width + HALO.width],
        [look.color, look.width],
    ] as const) {
        const made = sheet(Math.ceil(at.width) + 2 * margin, Math.ceil(at.height) + 2 * margin);
        if (made) {
            band(made.brush, stencil, at, color, wide * ratio);
            brush.drawImage(made.canvas, mask.left * sx - margin, mask.top * sy - margin);
        }
    }
}

/* What is drawn, so that nothing is drawn twice. */
interface Drawn {
    readonly guide: Guide | null;
    readonly selected: string;
    readonly hovered: string;
    readonly size: string;
}

export class Outlines {
    readonly #stores: Stores;
    readonly #canvas: HTMLCanvasElement;
    readonly #stops: (() => void)[] = [];
    #drawn: Drawn | null = null;

    constructor(stores: Stores, element: HTMLElement) {
        this.#stores = stores;
        this.#canvas = document.createElement("canvas");
        this.#canvas.className = "view-outlines";
        this.#canvas.setAttribute("aria-hidden", "true");
        this.#canvas.dataset.testid = "outlines";
        element.append(this.#canvas);
        const draw = (): void => this.#draw(element);
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

    /* Leaves below what is selected, and below what is hovered unless that is selected too. */
    #sets(): { selected: ReadonlySet<string>; hovered: ReadonlySet<string> } {
        const { document } = this.#stores.document.getState();
        const { selection, hovered, preferences, chromeHidden } = this.#stores.view.getState();
        const below = (id: string): readonly string[] =>
            document?.nodes.has(id) ? preorder(document, id) : [];
        const shown = preferences.outlines && !chromeHidden;
        const selected = new Set(shown ? selection.flatMap(below) : []);
        const other = shown && hovered !== null && !selection.includes(hovered);
        return { selected, hovered: new Set(other ? below(hovered) : []) };
    }

    #draw(element: HTMLElement): void {
        const ratio = window.devicePixelRatio;
        const width = Math.max(1, Math.round(element.clientWidth * ratio));
        const height = Math.max(1, Math.round(element.clientHeight * ratio));
        const guide = shownGuide(this.#stores.link.getState());
        this.#canvas.dataset.guide = guide ? "shown" : "";
        const { selected, hovered } = this.#sets();
        const next: Drawn = {
            guide: selected.size + hovered.size > 0 ? guide : null,
            selected: [...selected].join(" "),
            hovered: [...hovered].join(" "),
            size: `${width} ${height}`,
        };
        if (this.#drawn && sameDrawn(this.#drawn, next)) {
            return;
        }
        this.#drawn = next;
        this.#canvas.width = width; /* clears it */
        this.#canvas.height = height;
        const brush = this.#canvas.getContext("2d");
        if (brush && next.guide) {
            outline(brush, next.guide, hovered, HOVERED);
            outline(brush, next.guide, selected, SELECTED);
        }
        this.#canvas.dataset.selected = next.guide ? next.selected : "";
        this.#canvas.dataset.hovered = next.guide ? next.hovered : "";
    }
}

function sameDrawn(a: Drawn, b: Drawn): boolean {
    return (
        a.guide === b.guide &&
        a.selected === b.selected &&
        a.hovered === b.hovered &&
        a.size === b.size
    );
}

function looksDiffer(now: View, before: View): boolean {
    return (
        now.selection !== before.selection ||
        now.hovered !== before.hovered ||
        now.chromeHidden !== before.chromeHidden ||
        now.preferences.outlines !== before.preferences.outlines
    );
}
