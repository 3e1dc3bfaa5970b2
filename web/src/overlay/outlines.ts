/* SPDX-License-Identifier: MIT */
/* Outlines of what is selected and of what is under the pointer, while the picture
 * rests: its guide tells where they are, without a question. What has no end, such as a plane, has
 * no outline: it would be that of all that stands on it. */
import type { Box } from "../model/camera.ts";
import { preorder } from "../model/document.ts";
import { contourOf, type Guide, isSeen, shownGuide } from "../model/guide.ts";
import { isEndless, nodeType } from "../model/schema.ts";
import type { Stores } from "../model/stores.ts";
import type { View } from "../model/view.ts";
import { type AskBox, Boxes, boxLines } from "./buried.ts";
import { type Brush, line, stroke } from "./paint.ts";
import { drawOver, shownCamera } from "./shown.ts";

interface Look {
    readonly color: string;
    /* CSS pixels. */
    readonly width: number;
}

const SELECTED: Look = { color: "#ffb454", width: 2 };
const HOVERED: Look = { color: "#fff", width: 1.25 };
const BURIED: Look = { color: "#ffb454", width: 1.5 };
const DASHES = [6, 5];

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
    /* Of a selection of which nothing is seen. */
    readonly box: Box | null;
}

export class Outlines {
    readonly #stores: Stores;
    readonly #canvas: HTMLCanvasElement;
    readonly #boxes: Boxes;
    readonly #stops: (() => void)[] = [];
    #drawn: Drawn | null = null;

    constructor(stores: Stores, element: HTMLElement, ask: AskBox) {
        this.#stores = stores;
        this.#canvas = document.createElement("canvas");
        this.#canvas.className = "view-outlines";
        this.#canvas.setAttribute("aria-hidden", "true");
        this.#canvas.dataset.testid = "outlines";
        element.append(this.#canvas);
        const draw = (): void => this.#draw(element);
        this.#boxes = new Boxes(stores, ask, draw);
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
        const { document, schema } = this.#stores.document.getState();
        const { selection, hovered, preferences, chromeHidden } = this.#stores.view.getState();
        const ends = (id: string): boolean =>
            !isEndless(nodeType(schema, document?.nodes.get(id)?.type ?? ""));
        const below = (id: string): readonly string[] =>
            document?.nodes.has(id) ? preorder(document, id).filter(ends) : [];
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
            box: guide ? this.#boxOf(guide, selected) : null,
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
            this.#drawBox(brush, next.box, element);
        }
        this.#canvas.dataset.selected = next.guide ? next.selected : "";
        this.#canvas.dataset.hovered = next.guide ? next.hovered : "";
        this.#canvas.dataset.boxed = String(next.box !== null);
    }

    #boxOf(guide: Guide, selected: ReadonlySet<string>): Box | null {
        const buried = selected.size > 0 && !isSeen(guide, selected);
        const { selection } = this.#stores.view.getState();
        return buried ? this.#boxes.boxOf(selection, guide.revision) : null;
    }

    #drawBox(brush: Brush, box: Box | null, element: HTMLElement): void {
        const camera = shownCamera(this.#stores);
        if (!box || !camera) {
            return;
        }
        const size = { width: element.clientWidth, height: element.clientHeight };
        brush.setLineDash(DASHES);
        stroke(brush, BURIED.color, BURIED.width, () => {
            for (const ends of boxLines(box, camera, size)) {
                line(brush, ends);
            }
        });
    }
}

function sameDrawn(a: Drawn, b: Drawn): boolean {
    return (
        a.guide === b.guide &&
        a.selected === b.selected &&
        a.hovered === b.hovered &&
        a.size === b.size &&
        a.box === b.box
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
