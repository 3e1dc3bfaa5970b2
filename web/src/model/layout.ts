/* SPDX-License-Identifier: MIT */
/* Tidy drawing of a tree: leaves on the left, the root on the right, a column for each level.
 * Subtrees are placed below each other in their order, as close as their outlines let them
 * (E. Reingold, J. Tilford: Tidier Drawings of Trees, 1981), in O(n). Nothing is stored. */

/* The middle of a node's right side; lengths are CSS pixels at zoom 1, y points down. */
export interface Point {
    readonly x: number;
    readonly y: number;
}

export interface Tree {
    readonly root: string;
    /* In the order in which they are drawn; empty for leaves. */
    readonly childrenOf: (id: string) => readonly string[];
    readonly heightOf: (id: string) => number;
}

/* From one level to the next, and the least distance of two nodes of one level. */
export interface Spacing {
    readonly column: number;
    readonly gap: number;
}

/* One side of the outline of a subtree: a y for each level, the deepest level first, so that a
 * parent adds its own at the end. All of them are to be shifted by `shift`. */
interface Side {
    ys: number[];
    shift: number;
}

const at = ({ ys, shift }: Side, level: number): number => (ys[ys.length - 1 - level] ?? 0) + shift;

/* One side of two: `over` where it reaches, below that `under`. O(levels that they share). */
function cover(over: Side, under: Side): Side {
    const last = under.ys.length - 1;
    if (over.ys.length > last) {
        return over;
    }
    for (let level = 0; level < over.ys.length; level++) {
        under.ys[last - level] = at(over, level) - under.shift;
    }
    return under;
}

/* How far below the outline so far a subtree goes. */
function clearance(bottom: Side, top: Side, gap: number): number {
    let least = Number.NEGATIVE_INFINITY;
    for (let level = 0; level < Math.min(bottom.ys.length, top.ys.length); level++) {
        least = Math.max(least, at(bottom, level) - at(top, level) + gap);
    }
    return least;
}

/* Parents before their children. */
function order({ root, childrenOf }: Tree): string[] {
    const ids = [root];
    for (let i = 0; i < ids.length; i++) {
        for (const child of childrenOf(ids[i] ?? "")) {
            ids.push(child);
        }
    }
    return ids;
}

/* The spots of all nodes; that of the root is (0, 0). */
export function layoutTree(tree: Tree, { column, gap }: Spacing): Map<string, Point> {
    const ids = order(tree);
    const drawn = new Map<string, { top: Side; bottom: Side }>();
    /* Of a node from its parent. */
    const away = new Map<string, number>();
    for (const id of [...ids].reverse()) {
        let top: Side = { ys: [], shift: 0 };
        let bottom: Side = { ys: [], shift: 0 };
        const children = tree.childrenOf(id);
        for (const child of children) {
            const own = drawn.get(child) ?? { top, bottom };
            const down = bottom.ys.length === 0 ? 0 : clearance(bottom, own.top, gap);
            away.set(child, down);
            own.top.shift += down;
            own.bottom.shift += down;
            top = cover(top, own.top);
            bottom = cover(own.bottom, bottom);
        }
        const middle = (away.get(children.at(-1) ?? "") ?? 0) / 2;
        for (const child of children) {
            away.set(child, (away.get(child) ?? 0) - middle);
        }
        const half = tree.heightOf(id) / 2;
        top.shift -= middle;
        bottom.shift -= middle;
        top.ys.push(-half - top.shift);
        bottom.ys.push(half - bottom.shift);
        drawn.set(id, { top, bottom });
    }
    const spots = new Map<string, Point>([[tree.root, { x: 0, y: 0 }]]);
    for (const id of ids) {
        const { x, y } = spots.get(id) ?? { x: 0, y: 0 };
        for (const child of tree.childrenOf(id)) {
            spots.set(child, { x: x - column, y: y + (away.get(child) ?? 0) });
        }
    }
    return spots;
}
