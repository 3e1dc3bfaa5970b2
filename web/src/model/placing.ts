/* SPDX-License-Identifier: MIT */
/* Where something new goes, and how it combines with what is selected: as a union, a cut, or either
 * of them blended.
 * Nothing is ever combined otherwise than that says. */
import { nodeLabel, type SceneDocument, type SceneNode, siblingAfter } from "./document.ts";
import { freshIds, freshNames, moveTo, type Spot } from "./edits.ts";
import type { Operation } from "./operation.ts";
import { type NodeType, nodeType, type ParamType, type Schema } from "./schema.ts";

export type Way = "union" | "cut" | "blend" | "carve";

/* THE TABLE of ways: the operation that makes it. */
export const WAYS: Readonly<Record<Way, string>> = {
    union: "union",
    cut: "difference",
    blend: "smooth_union",
    carve: "smooth_difference",
};

/* Takes the other operands away from the first. */
export const takesAway = (type: string | undefined): boolean =>
    type?.endsWith("difference") === true;

export const WAY_NAMES = Object.keys(WAYS) as readonly Way[];

/* What makes solids of shapes of the plane; the first is taken where none is above. */
export const SOLID_MAKERS: readonly string[] = ["extrude", "revolve"];

export function names(row: NodeType, ...what: ParamType[]): boolean {
    return row.params.some((param) => what.includes(param.type));
}

/* Is a type made to have others below it? */
export function isContainer(row: NodeType): boolean {
    return row.children !== "none" && row.group !== "shape" && !names(row, "model", "function");
}

/* A place for something new, and what is done first to make it. */
export interface Placing {
    readonly ops: readonly Operation[];
    readonly spot: Spot;
    /* In words: "Beside Mug." */
    readonly words: string;
    /* The node below which the spot is now. */
    readonly above: string;
    /* Null: what is above decides how it combines, and there is no choice. */
    readonly way: Way | null;
}

/* What is below adds up: one more changes none of the others. */
function sums(row: NodeType | null): boolean {
    return (
        row !== null && isContainer(row) && (row.type === WAYS.union || row.group === "structure")
    );
}

/* How the children of a type combine, or null where in none of the ways. */
function wayOf(row: NodeType | null): Way | null {
    return sums(row) ? "union" : (WAY_NAMES.find((way) => WAYS[way] === row?.type) ?? null);
}

const inside = (node: SceneNode, way: Way | null, verb = "Into"): Placing => ({
    ops: [],
    spot: { into: node.id, before: null },
    words: `${verb} ${nodeLabel(node)}.`,
    above: node.id,
    way,
});

/* What is said where a place leaves no choice. */
const FORCED: Readonly<Record<Way, string>> = {
    union: "Into",
    cut: "Cuts",
    blend: "Blends into",
    carve: "Cuts",
};

function together(document: SceneDocument, active: SceneNode, parent: string, way: Way): Placing {
    const type = WAYS[way];
    const id = freshIds(document)(type);
    const name = freshNames(document)(type);
    const ops: Operation[] = [
        { op: "insert", into: `/nodes/${parent}`, before: active.id, value: { id, type, name } },
        moveTo(active.id, { into: id, before: null }),
    ];
    const verb = takesAway(WAYS[way]) ? "Cuts" : "With";
    return {
        ops,
        spot: { into: id, before: null },
        words: `${verb} ${nodeLabel(active)}, in a new ${type.replaceAll("_", " ")}.`,
        above: parent,
        way,
    };
}

/* With nothing or a root selected: last in it, combined as the root says. */
function atRoot(schema: Schema, root: SceneNode): Placing {
    const forced = wayOf(nodeType(schema, root.type));
    return forced === null
        ? inside(root, null, `Into the ${root.type.replaceAll("_", " ")}`)
        : { ...inside(root, forced, FORCED[forced]), way: null };
}

function besideOrTogether(
    document: SceneDocument,
    schema: Schema,
    active: SceneNode,
    parent: SceneNode,
    way: Way,
): Placing {
    const row = nodeType(schema, parent.type);
    /* What changes its children adds them up first. */
    const fits = wayOf(row) === way || (row?.group === "modifier" && way === "union");
    /* The first of a difference is what is cut; cutting a tool would make it smaller. */
    const base = !takesAway(WAYS[way]) || parent.children[0] === active.id;
    if (!fits || !base) {
        return together(document, active, parent.id, way);
    }
    return {
        ops: [],
        spot: { into: parent.id, before: siblingAfter(document, active.id) },
        words: takesAway(WAYS[way]) ? `Cuts ${nodeLabel(active)}.` : `Beside ${nodeLabel(active)}.`,
        above: parent.id,
        way,
    };
}

/* Is it made to take one more, whatever the way? */
function takes(active: SceneNode, row: NodeType | null): boolean {
    return row !== null && isContainer(row) && active.children.length === 0;
}

export function placing(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    added: NodeType | null,
    way: Way,
): Placing {
    const active = document.nodes.get(selection.at(-1) ?? document.root);
    const parent = document.nodes.get(active?.parent ?? "");
    const row = nodeType(schema, active?.type ?? "");
    if (!active || !parent) {
        const root = active ?? document.nodes.get(document.root);
        const nowhere = { into: document.root, before: null };
        return root
            ? atRoot(schema, root)
            : { ops: [], spot: nowhere, words: "", above: document.root, way: null };
    }
    if (takes(active, row)) {
        return inside(active, null);
    }
    const [only] = active.children;
    if (added?.group === "shape" && SOLID_MAKERS.includes(active.type) && only !== undefined) {
        return placing(document, schema, [only], added, way);
    }
    if (wayOf(row) === way) {
        return inside(active, way, takesAway(WAYS[way]) ? "Cuts" : "Into");
    }
    return besideOrTogether(document, schema, active, parent, way);
}
