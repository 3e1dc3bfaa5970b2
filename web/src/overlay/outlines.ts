/* SPDX-License-Identifier: MIT */
/* Outlines of what is selected and of what is under the pointer, while the picture
 * rests: its guide tells where they are, without a question. */
import { preorder } from "../model/document.ts";
import { contourOf, type Guide, shownGuide } from "../model/guide.ts";
import type { Stores } from "../model/stores.ts";
import type { View } from "../model/view.ts";
import { type Brush, stroke } from "./paint.ts";
import { drawOver } from "./shown.ts";

interface Look {
    readonly color: string;
    /* CSS pixels. */
    readonly width: number;
}

const SELECTED: Look = { color: "#ffb454", width: 2 };
const HOVERED: Look = { color: "#fff", width: 1.25 };

function outline(brush: Brush, guide: Guide, nodes: ReadonlySet<string>, look: Look): void {
    const segments = contourOf(guide, nodes);
    const ratio = window.devicePixelRatio;
    const scale = [
        brush.canvas.width / ratio / guide.width,
        brush.canvas.height / ratio / guide.height,
    ] as const;
    brush.setTransform(ratio, 0, 0, ratio, 0, 0);
    stroke(brush, look.color, look.width, () => {
        for (let i = 0; i < segments.length; i += 2) {
            const x = (segments[i] as number) * scale[0];
            const y = (segments[i + 1] as number) * scale[1];
            brush[i % 4 === 0 ? "moveTo" : "lineTo"](x, y);
        }
    });
}

interface Sets {
    readonly selected: ReadonlySet<string>;
    readonly hovered: ReadonlySet<string>;
}
const NOTHING: Sets = { selected: new Set(), hovered: new Set() };

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
    #sets(): Sets {
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
        const { selected, hovered } = guide ? this.#sets() : NOTHING;
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
