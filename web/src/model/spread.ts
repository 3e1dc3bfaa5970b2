/* SPDX-License-Identifier: MIT */
/* One change for all selected nodes: places and angles change by as much, scales by the same
 * factor, everything else becomes the same. */
import type { SceneDocument } from "./document.ts";
import { paramAt } from "./document.ts";
import type { Json } from "./json.ts";
import type { Operation } from "./operation.ts";
import { parsePlace } from "./places.ts";
import type { Schema, Value } from "./schema.ts";
import { valueIn } from "./schema.ts";
import { tidy } from "./units.ts";
import { checkValue, numbersOf } from "./values.ts";

/* How a transform's value follows the change of another from `from` to `to`. */
const FOLLOW: Record<string, (own: number, from: number, to: number) => number> = {
    translation: (own, from, to) => own + to - from,
    rotation: (own, from, to) => own + to - from,
    scale: (own, from, to) => (from === 0 ? to : (own * to) / from),
};

function follow(name: string, own: Value, from: Value, to: Value): Value {
    const step = FOLLOW[name];
    if (step === undefined) {
        return to;
    }
    const [start, end] = [numbersOf(from), numbersOf(to)];
    return numbersOf(own).map((x, i) => tidy(step(x, start[i] ?? 0, end[i] ?? 0)));
}

/* The place of the same value in another node. */
function placeIn(at: string, id: string): string {
    return at.replace(/^\/nodes\/[^/]+/, `/nodes/${id}`);
}

/* `start`: the document before the change, so that a drag adds up to what its end says. */
export function spread(
    schema: Schema,
    start: SceneDocument,
    selection: readonly string[],
    at: string,
    value: Value | null,
): Operation[] {
    const place = parsePlace(at);
    const one: Operation = { op: "set", at, value: value as Json };
    const active = place !== null && "id" in place && "name" in place ? place.id : null;
    const found = paramAt(schema, start, at);
    if (active === null || !found || !selection.includes(active)) {
        return [one];
    }
    const from = valueIn(found.values, found.param);
    const others = selection.flatMap((id): Operation[] => {
        const there = id === active ? null : paramAt(schema, start, placeIn(at, id));
        if (there?.param.type !== found.param.type) {
            return [];
        }
        const own = valueIn(there.values, there.param);
        const next =
            value !== null && place?.kind === "transform"
                ? follow(there.param.name, own, from, value)
                : value;
        const fits = next === null || checkValue(there.param, next) === null;
        return fits ? [{ op: "set", at: placeIn(at, id), value: next as Json }] : [];
    });
    return [one, ...others];
}
