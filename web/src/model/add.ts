/* SPDX-License-Identifier: MIT */
/* Putting something new into the tree: where it goes, and what goes around what. */
import { nodeLabel, pathTo, type SceneDocument, type SceneNode, siblingAfter } from "./document.ts";
import { type Edit, freshIds, movable, type Spot, wrap } from "./edits.ts";
import type { JsonObject } from "./json.ts";
import { type NodeType, nodeType, type ParamType, type Schema } from "./schema.ts";
import { NEW_NODE_CODE } from "./templates.ts";
import type { Vector } from "./transform.ts";
import { tidy } from "./units.ts";

/* What a palette offers: a type, or an instance of something of the document. */
export interface Addition {
    readonly type: string;
    /* A model or a distance function. */
    readonly named?: string;
}

/* What makes solids of shapes of the plane; the first is taken where none is above. */
const SOLID_MAKERS = ["extrude", "revolve"];

const wordsOf = (type: string): string => type.replaceAll("_", " ");

/* The type whose nodes name a model, or a distance function. */
export function typeNaming(schema: Schema, what: "model" | "function"): NodeType | null {
    return schema.nodes.find((row) => names(row, what)) ?? null;
}

function names(row: NodeType, ...what: ParamType[]): boolean {
    return row.params.some((param) => what.includes(param.type));
}

/* Is a type made to have others below it? */
export function isContainer(row: NodeType): boolean {
    return row.children !== "none" && row.group !== "shape" && !names(row, "model", "function");
}

function mayTake(active: SceneNode, row: NodeType, added: NodeType | null): boolean {
    if (!isContainer(row)) {
        return false;
    }
    const flat = added?.group === "shape" && SOLID_MAKERS.includes(row.type);
    return row.children === "many" || active.children.length === 0 || flat;
}

/* Next to the active node: inside where it is made for that, else behind it. */
export function spotFor(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    added: NodeType | null = null,
): Spot {
    const active = document.nodes.get(selection.at(-1) ?? "");
    if (!active) {
        return { into: document.root, before: null };
    }
    const row = nodeType(schema, active.type);
    if (active.parent === null || (row && mayTake(active, row, added))) {
        return { into: active.id, before: null };
    }
    return { into: active.parent, before: siblingAfter(document, active.id) };
}

/* Params that a new node starts with. */
function paramsOf(row: NodeType | null, named: string | undefined): JsonObject {
    for (const param of row?.params ?? []) {
        if (named !== undefined && (param.type === "model" || param.type === "function")) {
            return { [param.name]: named };
        }
        if (param.type === "code") {
            return { [param.name]: NEW_NODE_CODE };
        }
    }
    return {};
}

/* Does a shape of the plane need something around it to become a solid here? */
function needsSolid(document: SceneDocument, schema: Schema, row: NodeType | null, into: string) {
    const above = pathTo(document, into).some((node) => SOLID_MAKERS.includes(node.type));
    const maker = SOLID_MAKERS.find((type) => nodeType(schema, type) !== null);
    return row?.group === "shape" && !above ? (maker ?? null) : null;
}

/* A new node. What combines or changes others goes around the selection, if any. A shape of the
 * plane comes with what makes it a solid. `at` is a point in the parent's space. */
export function addNode(
    document: SceneDocument,
    schema: Schema,
    { type, named }: Addition,
    selection: readonly string[],
    at?: Vector,
): Edit {
    const row = nodeType(schema, type);
    const around = movable(document, selection);
    if (row && isContainer(row) && around.length > 0) {
        return wrap(document, around, type);
    }
    const spot = spotFor(document, schema, selection, row);
    const fresh = freshIds(document);
    const id = fresh(named ?? type);
    const params = paramsOf(row, named);
    const transform = at ? { transform: { translation: at.map(tidy) } } : {};
    const node: JsonObject = {
        id,
        type,
        ...(Object.keys(params).length > 0 ? { params } : {}),
    };
    const maker = needsSolid(document, schema, row, spot.into);
    const value = maker
        ? { id: fresh(maker), type: maker, ...transform, children: [node] }
        : { ...node, ...transform };
    return {
        ops: [{ op: "insert", into: `/nodes/${spot.into}`, before: spot.before, value }],
        label: `add ${named ?? wordsOf(type)}`,
        select: [id],
    };
}

/* What adding something would do, in words: for the palette's last line. */
export function whatAdding(
    document: SceneDocument,
    schema: Schema,
    { type }: Addition,
    selection: readonly string[],
): string | null {
    const row = nodeType(schema, type);
    const around = movable(document, selection);
    const [first] = around;
    if (row && isContainer(row) && first !== undefined) {
        const node = document.nodes.get(first);
        const what = around.length > 1 ? `${around.length} nodes` : node ? nodeLabel(node) : first;
        return `Goes around ${what}.`;
    }
    const maker = needsSolid(document, schema, row, spotFor(document, schema, selection, row).into);
    return maker === null ? null : `Comes with ${wordsOf(maker)} around it.`;
}
