/* SPDX-License-Identifier: MIT */
/* Where something new begins that at the origin would leave nothing of what it cuts, be hidden in
 * what it blends with, or lie in the middle of what it is to lie under. */
import type { Addition } from "./add.ts";
import type { Box } from "./camera.ts";
import { isShown, pathTo, preorder, type SceneDocument } from "./document.ts";
import type { Ground } from "./landing.ts";
import { isContainer, placing, takesAway, WAYS, type Way } from "./placing.ts";
import { isEndless, nodeType, type Schema } from "./schema.ts";
import { transformOf, type Vector } from "./transform.ts";
import { tidy } from "./units.ts";

/* Of what it cuts: the width of a tool, and how far above the middle it is, so that it is open. */
const WIDTH = 0.8;
const LIFT = 0.2;
const UP: Vector = [0, 1, 0];

/* What is below what: nodes in whose box it depends where the new one begins. */
export interface Seat {
    readonly of: readonly string[];
    readonly above: string;
    readonly as: "tool" | "side" | "floor";
}

/* Null: it begins where its own numbers say. */
export function seatOf(
    document: SceneDocument,
    schema: Schema,
    { type }: Addition,
    selection: readonly string[],
    way: Way,
): Seat | null {
    const row = nodeType(schema, type);
    if (row === null || isContainer(row)) {
        return null;
    }
    const place = placing(document, schema, selection, row, way);
    const into = document.nodes.get(place.spot.into);
    const base = into ? into.children[0] : selection.at(-1);
    if (takesAway(into?.type ?? WAYS[way])) {
        return base === undefined ? null : { of: [base], above: place.above, as: "tool" };
    }
    const active = selection.at(-1);
    if (place.way === "blend" && active !== undefined && !isEndless(row)) {
        return { of: [active], above: place.above, as: "side" };
    }
    const standing = isEndless(row) ? shapesOf(document, schema) : [];
    return standing.length > 0 ? { of: standing, above: place.above, as: "floor" } : null;
}

/* Those with an end. The box of what blends them has room for what it adds. */
function shapesOf(document: SceneDocument, schema: Schema): readonly string[] {
    return preorder(document, document.root).filter((id) => {
        const row = nodeType(schema, document.nodes.get(id)?.type ?? "");
        return row?.children === "none" && !isEndless(row) && isShown(document, id);
    });
}

export function groundIn(document: SceneDocument, seat: Seat, { low, high }: Box): Ground {
    if (seat.as === "floor") {
        return { at: [0, tidy(low[1]), 0], normal: UP };
    }
    const [x, y, z] = [0, 1, 2].map((i) => ((low[i] ?? 0) + (high[i] ?? 0)) / 2);
    if (seat.as === "side") {
        return { at: [tidy(high[0]), y ?? 0, z ?? 0], normal: UP };
    }
    const sides = [high[0] - low[0], high[2] - low[2]];
    const around = pathTo(document, seat.above).map((node) => transformOf(node).scale[0]);
    const size = (WIDTH * Math.min(...sides)) / around.reduce((all, one) => all * one, 1);
    return {
        at: [x ?? 0, (y ?? 0) + LIFT * (high[1] - low[1]), z ?? 0],
        normal: UP,
        size: Number(size.toPrecision(3)),
    };
}
