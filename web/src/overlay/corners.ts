/* SPDX-License-Identifier: MIT */
/* Corners of flat shapes in the picture: one of them is chosen by a click and taken away by Delete; a
 * double click on an edge puts one there. Dragging is that of any handle. */
import {
    type CornerEdit,
    dropCorner,
    type EdgeSpot,
    edgeAt,
    isCorner,
    putCorner,
} from "../model/corners.ts";
import { type Handle, handleAt } from "../model/handles.ts";
import type { Projection, Spot } from "../model/projection.ts";
import type { Step } from "./hold.ts";
import { type Brush, paintLabel, paintSpare, ringAt } from "./paint.ts";

export interface CornersPage {
    /* Begins one undo step: "move", "change radius of". */
    begin(what: string): Step;
    /* Says how many points there may be. */
    refuse(limit: Exclude<CornerEdit, { op: string }>): void;
    /* What a double click does on an edge. */
    readonly edgeHint: string;
}

export class Corners {
    readonly #page: CornersPage;
    /* The key of its handle. */
    #chosen: string | null = null;
    #edge: EdgeSpot | null = null;

    constructor(page: CornersPage) {
        this.#page = page;
    }

    choose(key: string | null): void {
        this.#chosen = key;
        this.#edge = null;
    }

    hover(handles: readonly Handle[], at: Spot, slop: number): void {
        this.#edge = edgeAt(handles, at, slop);
    }

    /* True: it was on a corner or an edge. */
    click(handles: readonly Handle[], at: Spot, slop: number): boolean {
        const corner = handleAt(handles.filter(isCorner), at, slop);
        this.choose(corner?.key ?? null);
        return corner !== null || edgeAt(handles, at, slop) !== null;
    }

    double(handles: readonly Handle[], projection: Projection, at: Spot, slop: number): boolean {
        if (handleAt(handles.filter(isCorner), at, slop)) {
            return true;
        }
        const edge = edgeAt(handles, at, slop);
        const edit = edge && putCorner(edge, projection);
        if (edge && edit && this.#apply("add a point to", edit)) {
            this.choose(`${edge.handle.param.name}.${(edge.handle.component ?? 0) + 1}`);
        }
        return edge !== null;
    }

    /* Delete takes away what is chosen, Esc lets it go. */
    key(handles: readonly Handle[], event: KeyboardEvent): boolean {
        const corner = handles.find(({ key }) => key === this.#chosen);
        if (!corner || event.ctrlKey || event.metaKey || event.altKey) {
            return false;
        }
        if (event.key === "Escape") {
            this.choose(null);
            return true;
        }
        if (event.key !== "Delete" && event.key !== "Backspace") {
            return false;
        }
        if (this.#apply("remove a point of", dropCorner(corner))) {
            this.choose(`${corner.param.name}.${Math.max(0, (corner.component ?? 0) - 1)}`);
        }
        return true;
    }

    paint(brush: Brush, handles: readonly Handle[], width: number): void {
        const chosen = handles.find(({ key }) => key === this.#chosen);
        if (chosen) {
            ringAt(brush, chosen.spot);
        }
        if (this.#edge && handles.some(isCorner)) {
            paintSpare(brush, this.#edge.spot);
            paintLabel(brush, this.#page.edgeHint, this.#edge.spot, width);
        }
    }

    #apply(what: string, edit: CornerEdit): boolean {
        if (!("op" in edit)) {
            this.#page.refuse(edit);
            return false;
        }
        const step = this.#page.begin(what);
        const done = step.edit([edit]);
        step.end();
        return done;
    }
}
