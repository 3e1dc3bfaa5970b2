/* SPDX-License-Identifier: MIT */
/* Edits: apply and inverse of set, insert, remove and move, as protocol/README.md states them.
 * Pure: documents share what did not change. Ranges are the schema's matter (checkValue). */
import type { SceneDocument } from "./document.ts";
import { DocumentDraft } from "./documentDraft.ts";
import { insert, move, remove } from "./lists.ts";
import { type Operation, type Problem, Refusal } from "./operation.ts";
import { parsePlace } from "./places.ts";
import type { Schema } from "./schema.ts";
import { set } from "./set.ts";

export type Applied =
    | {
          readonly ok: true;
          readonly document: SceneDocument;
          readonly inverse: readonly Operation[];
      }
    | { readonly ok: false; readonly problem: Problem };

export function applyOne(draft: DocumentDraft, operation: Operation): Operation[] {
    switch (operation.op) {
        case "set":
            return set(draft, operation.at, operation.value);
        case "insert":
            return insert(draft, operation);
        case "remove":
            return remove(draft, operation.at);
        case "move":
            return move(draft, operation);
    }
}

/* Applies all operations or none. The inverse undoes them when applied to the result. */
export function apply(
    document: SceneDocument,
    operations: readonly Operation[],
    schema: Schema,
): Applied {
    const draft = new DocumentDraft(document, schema);
    const inverse: Operation[][] = [];
    try {
        for (const operation of operations) {
            inverse.unshift(applyOne(draft, operation));
        }
    } catch (error) {
        if (error instanceof Refusal) {
            return { ok: false, problem: error.problem };
        }
        throw error;
    }
    return { ok: true, document: draft.document, inverse: inverse.flat() };
}

/* --- joining --- */

/* Does a value of this name decide what other values there are, or what may be named? */
function rules(schema: Schema, name: string): boolean {
    const types = ["function", "model", "rows"];
    const all = [
        ...schema.nodes.flatMap(({ params }) => params),
        ...schema.primitive,
        ...schema.shader,
        ...schema.model,
    ];
    return all.some((param) => param.name === name && types.includes(param.type));
}

/* A set whose effect is independent of other such sets: no type, no whole record. */
function isPlainSet(
    schema: Schema,
    operation: Operation,
): operation is Extract<Operation, { op: "set" }> {
    const place = operation.op === "set" ? parsePlace(operation.at) : null;
    return (
        place !== null &&
        place.kind !== "node-type" &&
        place.kind !== "resource-type" &&
        "name" in place &&
        place.name !== null &&
        !rules(schema, place.name)
    );
}

/* One list that does what `first` and then `second` do: of several plain sets of one place only
 * the newest stays, so that a drag sends one value per frame. */
export function join(
    schema: Schema,
    first: readonly Operation[],
    second: readonly Operation[],
): Operation[] {
    const plain = (operation: Operation) => isPlainSet(schema, operation);
    const joined = [...first];
    for (const operation of second) {
        if (joined.every(plain) && plain(operation)) {
            const index = joined.findIndex((old) => samePlace(old, operation));
            joined.splice(index < 0 ? joined.length : index, index < 0 ? 0 : 1, operation);
        } else {
            joined.push(operation);
        }
    }
    return joined;
}

function samePlace(a: Operation, b: Operation): boolean {
    return a.op === "set" && b.op === "set" && a.at === b.at;
}
