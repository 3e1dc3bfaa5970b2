/* SPDX-License-Identifier: MIT */
/* A point of the surface that a node has or changes, and the way out of it: where lengths without a
 * place of their own are seen, such as how thick a sheet is or how far a shape grows. The page knows no
 * distance, but handles of shapes lie on their surface. */
import { ballIn } from "./bounds.ts";
import {
    isVisible,
    modelNamed,
    nodeParams,
    type SceneDocument,
    type SceneNode,
} from "./document.ts";
import {
    evaluatePoint,
    NO_SKIN,
    namesOf,
    namesSkin,
    namesWith,
    numberName,
    pointsIn,
    type Skin,
} from "./handleTexts.ts";
import { type Reading, readingOf } from "./modelParams.ts";
import { components, type Param, type Schema, valueIn } from "./schema.ts";
import { lettersOf, PARTS, rangesOf, readSurface, type SurfaceRange } from "./surface.ts";
import {
    add,
    cross,
    length,
    normalize,
    outOf,
    scale,
    subtract,
    type Vector,
    vectorOf,
} from "./transform.ts";
import { numbersOf, pointsOf } from "./values.ts";

const NUDGE = 1e-4;
const ORIGIN: Vector = [0, 0, 0];
const OUTWARDS: Vector = [1, 0, 0];
const isKnown = (point: Vector): boolean => point.every(Number.isFinite);

/* Where a product has no sign: "2s", "(1 + s)(1 - t)". */
const UNSIGNED = /(\d|\))\s*(?=[a-z(])/gi;

class Skins {
    readonly #document: SceneDocument;
    readonly #schema: Schema;

    constructor(document: SceneDocument, schema: Schema) {
        this.#document = document;
        this.#schema = schema;
    }

    /* In the node's own space, before the node changes it; null: the page knows none. */
    of(node: SceneNode, reading: Reading): Skin | null {
        const params = nodeParams(this.#schema, this.#document, node);
        return (
            this.#ofSurface(params, node) ??
            this.#below(node, reading) ??
            ofLength(params, node) ??
            ofPlaces(params, node)
        );
    }

    /* The same after it. */
    #changed(node: SceneNode, reading: Reading): Skin | null {
        const before = this.of(node, reading);
        const params = nodeParams(this.#schema, this.#document, node);
        const row = params.find((param) => namesSkin(param) && components(param.type) === 1);
        if (before === null || !row) {
            return before;
        }
        const names = namesOf({ params, values: node.params, skin: () => before });
        const at = evaluatePoint(pointsIn(row)[0], names);
        return isKnown(at) ? { ...before, at } : before;
    }

    /* That of the first child that is seen and has one. */
    #below(node: SceneNode, reading: Reading): Skin | null {
        const model = modelNamed(this.#schema, this.#document, node);
        const inside = model ? readingOf(this.#schema, this.#document, model, node) : reading;
        for (const id of model ? [model.root] : node.children) {
            const child = this.#document.nodes.get(id);
            const read = child && isVisible(child) ? inside(child) : null;
            const skin = read && this.#changed(read, inside);
            if (read && skin) {
                return moved([{ ...node, transform: {} }, read], skin);
            }
        }
        return null;
    }

    /* Where the page can read what it is: at three quarters of its two parameters, as the middle of many
     * is the origin, where the gizmo is. */
    #ofSurface(params: readonly Param[], node: SceneNode): Skin | null {
        const row = params.find(({ type }) => type === "surface");
        const surface = row ? readSurface(valueIn(node.params, row)) : null;
        if (surface === null) {
            return null;
        }
        const ranges = rangesOf(surface);
        const [s = "", t = ""] = lettersOf(surface);
        const own = namesOf({ params, values: node.params, skin: NO_SKIN });
        const at = (more: number, further: number): Vector => {
            const names = namesWith(own, s, aside(ranges[s]) + more);
            const texts = PARTS.map((part) => surface.texts[part].replace(UNSIGNED, "$1*"));
            return evaluatePoint(texts, namesWith(names, t, aside(ranges[t]) + further));
        };
        const point = at(0, 0);
        const out = cross(subtract(at(NUDGE, 0), point), subtract(at(0, NUDGE), point));
        return isKnown(point) && length(out) > 0 ? { at: point, out: normalize(out) } : null;
    }
}

const aside = ([low, high]: SurfaceRange = [0, 0]): number => low + (high - low) * 0.75;

/* From the space of the last node to that of the first. */
function moved(path: readonly SceneNode[], { at, out }: Skin): Skin {
    const there = outOf(path, at);
    const further = outOf(path, add(at, scale(out, NUDGE)));
    return { at: there, out: normalize(subtract(further, there), OUTWARDS) };
}

/* At the point of the first length that is no place, the way that it goes. */
function ofLength(params: readonly Param[], { params: values }: SceneNode): Skin | null {
    const names = namesOf({ params, values, skin: NO_SKIN });
    for (const param of params) {
        const points = pointsIn(param);
        const count = components(param.type);
        if (param.handle === "" || param.unit !== "length" || points.length !== count) {
            continue;
        }
        const number = numberName(param.name, count, 0);
        const at = evaluatePoint(points[0], names);
        const more = namesWith(names, number, names(number) + NUDGE);
        const way = subtract(evaluatePoint(points[0], more), at);
        if (isKnown(at) && isKnown(way) && length(way) > 0) {
            return { at, out: normalize(way) };
        }
    }
    return null;
}

/* At the first of its places or corners, away from the middle of them. */
function ofPlaces(params: readonly Param[], { params: values }: SceneNode): Skin | null {
    const places = params.flatMap((param): Vector[] => {
        const value = valueIn(values, param);
        return param.type === "points"
            ? pointsOf(value).map(([x, y]) => [x, y, 0])
            : components(param.type) > 1 && param.handle !== "" && pointsIn(param).length === 1
              ? [vectorOf(numbersOf(value))]
              : [];
    });
    const [first] = places;
    const sum = places.reduce(add, ORIGIN);
    return first
        ? { at: first, out: normalize(subtract(first, scale(sum, 1 / places.length)), OUTWARDS) }
        : null;
}

/* In the node's own space, before the node changes it: at the side of what the page takes for its size
 * where it knows no better. */
export function skinOf(
    document: SceneDocument,
    schema: Schema,
    node: SceneNode,
    reading: Reading = (one) => one,
): Skin {
    const skin = new Skins(document, schema).of(node, reading);
    const ball = skin ? null : ballIn(document, { ...node, transform: {} }, schema, reading);
    return skin ?? { at: add(ball?.center ?? ORIGIN, [ball?.radius ?? 0, 0, 0]), out: OUTWARDS };
}
