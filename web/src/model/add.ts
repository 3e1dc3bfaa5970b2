/* SPDX-License-Identifier: MIT */
/* Putting something new into the tree: where it goes, and what goes around what. */
import { nodeLabel, pathTo, type SceneDocument } from "./document.ts";
import { type Edit, freshIds, freshNames, movable, wrap } from "./edits.ts";
import type { JsonObject } from "./json.ts";
import { type Ground, landingTransform } from "./landing.ts";
import { isContainer, names, placing, SOLID_MAKERS, type Way } from "./placing.ts";
import { type NodeType, nodeType, type Schema } from "./schema.ts";
import { NEW_EQUATION, NEW_NODE_CODE, NEW_SURFACE } from "./templates.ts";

/* What a palette offers: a type, or an instance of something of the document. */
export interface Addition {
    readonly type: string;
    /* A model or a distance function. */
    readonly named?: string;
}

const wordsOf = (type: string): string => type.replaceAll("_", " ");

/* The type whose nodes name a model, or a distance function. */
export function typeNaming(schema: Schema, what: "model" | "function"): NodeType | null {
    return schema.nodes.find((row) => names(row, what)) ?? null;
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
        if (param.type === "equation") {
            return { [param.name]: NEW_EQUATION };
        }
        if (param.type === "surface") {
            return { [param.name]: NEW_SURFACE };
        }
    }
    return {};
}

/* Does a shape of the plane need something around it to become a solid here? */
export function needsSolid(
    document: SceneDocument,
    schema: Schema,
    row: NodeType | null,
    into: string,
): string | null {
    const above = pathTo(document, into).some((node) => SOLID_MAKERS.includes(node.type));
    const maker = SOLID_MAKERS.find((type) => nodeType(schema, type) !== null);
    return row?.group === "shape" && !above ? (maker ?? null) : null;
}

/* The JSON of a new node below `above`, with what makes it a solid around it, if that is needed. */
function newNode(
    document: SceneDocument,
    schema: Schema,
    { type, named }: Addition,
    above: string,
    ground: Ground | null = null,
): { id: string; value: JsonObject } {
    const row = nodeType(schema, type);
    const fresh = freshIds(document);
    const name = freshNames(document);
    const id = fresh(named ?? type);
    const params = paramsOf(row, named);
    const place = ground ? { transform: landingTransform(document, above, ground) } : {};
    const node: JsonObject = {
        id,
        type,
        name: name(named ?? type),
        ...(Object.keys(params).length > 0 ? { params } : {}),
    };
    const maker = needsSolid(document, schema, row, above);
    const value = maker
        ? { id: fresh(maker), type: maker, name: name(maker), ...place, children: [node] }
        : { ...node, ...place };
    return { id, value };
}

/* A new node as the last input of `into`, whatever its type. */
export function addInput(
    document: SceneDocument,
    schema: Schema,
    addition: Addition,
    into: string,
): Edit {
    const { id, value } = newNode(document, schema, addition, into);
    return {
        ops: [{ op: "insert", into: `/nodes/${into}`, before: null, value }],
        label: `add ${addition.named ?? wordsOf(addition.type)}`,
        select: [id],
    };
}

/* A new node. What combines or changes others goes around the selection, if any; anything else is
 * combined with it in a `way`. A shape of the plane comes with what makes it a solid. */
export function addNode(
    document: SceneDocument,
    schema: Schema,
    addition: Addition,
    selection: readonly string[],
    way: Way = "union",
    ground: Ground | null = null,
): Edit {
    const { type, named } = addition;
    const row = nodeType(schema, type);
    const around = movable(document, selection);
    if (row && isContainer(row) && around.length > 0) {
        return wrap(document, around, type);
    }
    const { ops, spot, above } = placing(document, schema, selection, row, way);
    const { id, value } = newNode(document, schema, addition, above, ground);
    return {
        ops: [...ops, { op: "insert", into: `/nodes/${spot.into}`, before: spot.before, value }],
        label: `add ${named ?? wordsOf(type)}`,
        select: [id],
    };
}

/* What adding something would do, in words, and the way that can be chosen, if any: for the
 * palette's last line. */
export function whatAdding(
    document: SceneDocument,
    schema: Schema,
    { type }: Addition,
    selection: readonly string[],
    way: Way,
): { words: string; way: Way | null } {
    const row = nodeType(schema, type);
    const around = movable(document, selection);
    const [first] = around;
    if (row && isContainer(row) && first !== undefined) {
        const node = document.nodes.get(first);
        const what = around.length > 1 ? `${around.length} nodes` : node ? nodeLabel(node) : first;
        return { words: `Goes around ${what}.`, way: null };
    }
    const place = placing(document, schema, selection, row, way);
    const maker = needsSolid(document, schema, row, place.above);
    const solid = maker === null ? "" : ` Comes with ${wordsOf(maker)} around it.`;
    return { words: place.words + solid, way: place.way };
}
