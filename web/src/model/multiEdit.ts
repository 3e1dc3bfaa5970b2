/* SPDX-License-Identifier: MIT */
/* One change for all selected nodes: a drag or a step changes each from where it is, a typed value
 * is the same for all; and where selected nodes differ. */
import type { SceneDocument } from "./document.ts";
import { paramAt } from "./document.ts";
import { equalJson, isObject, type Json } from "./json.ts";
import type { Operation } from "./operation.ts";
import { parsePlace } from "./places.ts";
import { components, type Param, type Schema, type Value, valueIn } from "./schema.ts";
import { LETTERS, PARTS } from "./surface.ts";
import { tidy, tidyAngle } from "./units.ts";
import { checkValue, clampNumber, numbersOf } from "./values.ts";

/* How a number changes, for others than the one that is changed; and which of several. */
export interface Change {
    readonly by: (own: number) => number;
    /* Null: all components. */
    readonly axis: number | null;
}

/* How a value of another kind changes, for others than the one that is changed. */
export type Revision = (own: Value) => Value;

/* Numbers that change one by one; a colour changes as a whole. */
function isNumbers({ type }: Param): boolean {
    return components(type) > 0 && /^(float|int|vec[234]|ivec3)$/.test(type);
}

function follow(param: Param, own: Value, { by, axis }: Change): Value {
    const round = param.unit === "angle" ? tidyAngle : tidy;
    const count = components(param.type);
    const next = numbersOf(own, count).map((x, i) =>
        axis === null || axis === i ? round(clampNumber(param, by(x))) : x,
    );
    return count === 1 ? (next[0] ?? 0) : next;
}

/* What another node gets. */
function valueAfter(param: Param, own: Value, value: Value, change: Change | Revision): Value {
    if (typeof change === "function") {
        return change(own);
    }
    return isNumbers(param) ? follow(param, own, change) : value;
}

/* The place of the same value in another node. */
function placeIn(at: string, id: string): string {
    return at.replace(/^\/nodes\/[^/]+/, `/nodes/${id}`);
}

/* The same row of another node, or null where it has none such. */
function sameIn(schema: Schema, document: SceneDocument, at: string, id: string, param: Param) {
    const found = paramAt(schema, document, placeIn(at, id));
    return found?.param.type === param.type ? found : null;
}

/* The selected nodes beside the one that a place is of; none where the place is of no such. */
function othersAt(at: string, selection: readonly string[]): readonly string[] {
    const place = parsePlace(at);
    const active = place !== null && "id" in place && "name" in place ? place.id : null;
    return active !== null && selection.includes(active)
        ? selection.filter((id) => id !== active)
        : [];
}

/* `start`: the document before the change, so that a drag adds up to what its end says. Without
 * `change`, all become `value`. */
export function multiEdit(
    schema: Schema,
    start: SceneDocument,
    selection: readonly string[],
    at: string,
    value: Value | null,
    change: Change | Revision | null = null,
): Operation[] {
    const one: Operation = { op: "set", at, value: value as Json };
    const found = paramAt(schema, start, at);
    if (!found) {
        return [one];
    }
    const others = othersAt(at, selection).flatMap((id): Operation[] => {
        const there = sameIn(schema, start, at, id, found.param);
        if (!there) {
            return [];
        }
        const own = valueIn(there.values, there.param);
        const follows = change !== null && value !== null;
        const next = follows ? valueAfter(there.param, own, value, change) : value;
        const fits = next === null || checkValue(there.param, next) === null;
        return fits ? [{ op: "set", at: placeIn(at, id), value: next as Json }] : [];
    });
    return [one, ...others];
}

/* What of a value may differ by itself. */
function partsOf(param: Param, value: Value): readonly Json[] {
    if (param.type === "surface" && isObject(value)) {
        return [...PARTS, ...LETTERS].map((name) => value[name] ?? null);
    }
    return isNumbers(param) ? numbersOf(value, components(param.type)) : [value as Json];
}

/* Where the selected nodes differ from the one that a place is of: a digit for each component (of a
 * surface: x, y, z, s, t, u, v), 1 where it is mixed; "" where all are the same. A text, as what is
 * the same draws nothing anew. */
export function mixedAt(
    schema: Schema,
    document: SceneDocument,
    selection: readonly string[],
    at: string,
): string {
    const found = selection.length < 2 ? null : paramAt(schema, document, at);
    if (!found) {
        return "";
    }
    const { param } = found;
    const own = partsOf(param, valueIn(found.values, param));
    const differs = own.map(() => false);
    for (const id of othersAt(at, selection)) {
        const there = sameIn(schema, document, at, id, param);
        const parts = there ? partsOf(param, valueIn(there.values, there.param)) : own;
        parts.forEach((part, i) => {
            differs[i] ||= !equalJson(part, own[i] ?? null);
        });
    }
    return differs.includes(true) ? differs.map(Number).join("") : "";
}
