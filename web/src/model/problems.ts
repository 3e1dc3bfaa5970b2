/* SPDX-License-Identifier: MIT */
/* What is wrong with a document, by place: edits that were refused, and code that does not compile
 * and stands there all the same, while the picture shows the last that did. */
import { paramAt, type SceneDocument } from "./document.ts";
import type { Operation, Problem } from "./operation.ts";
import { cleanPlace, isWithin, nodeOfPlace, resourceOfPlace, resourcePlace } from "./places.ts";
import type { Schema, Value } from "./schema.ts";

/* The code of notices about code. */
export const COMPILE = "compile";
export const COMPILED = "compiled";

export interface Standing extends Problem {
    /* The document's revision, and the code, when it was told. */
    readonly since: number;
    readonly text: Value | null;
}

/* By place; at most one each. */
export type Problems = ReadonlyMap<string, Standing>;

export const NO_PROBLEMS: Problems = new Map();

function textAt(schema: Schema, document: SceneDocument | null, place: string): Value | null {
    const found = document && paramAt(schema, document, place);
    return found ? (found.values[found.param.name] ?? null) : null;
}

export function addProblem(
    problems: Problems,
    problem: Problem,
    now: { schema: Schema; document: SceneDocument | null; revision: number },
): Problems {
    const place = cleanPlace(problem.place);
    const text = textAt(now.schema, now.document, place);
    const standing = { ...problem, place, since: now.revision, text };
    return new Map(problems).set(place, standing);
}

function without(problems: Problems, gone: (problem: Standing) => boolean): Problems {
    const left = [...problems].filter(([, problem]) => !gone(problem));
    return left.length < problems.size ? new Map(left) : problems;
}

/* The code at `place` compiles again. */
export function endProblem(problems: Problems, place: string): Problems {
    return without(problems, (one) => one.code === COMPILE && one.place === cleanPlace(place));
}

/* An edit that touches what an earlier one was refused for settles it. */
export function settleProblems(problems: Problems, ops: readonly Operation[]): Problems {
    const touched = ops.map((op) => ownerOf("at" in op ? op.at : op.into));
    return without(problems, (one) => one.code !== COMPILE && touched.includes(ownerOf(one.place)));
}

/* The node or resource of a place, else the place itself. */
function ownerOf(place: string): string {
    const node = nodeOfPlace(place);
    const resource = resourceOfPlace(place);
    return node !== null
        ? `/nodes/${node}`
        : resource !== null
          ? resourcePlace(resource.list, resource.name)
          : place;
}

/* Code that is gone cannot be wrong. */
export function dropGone(
    problems: Problems,
    schema: Schema,
    document: SceneDocument | null,
): Problems {
    return problems.size === 0 || document === null
        ? problems
        : without(problems, (one) => one.code === COMPILE && !paramAt(schema, document, one.place));
}

/* A picture of a later revision is shown and nothing was said again of code that has changed. */
export function dropShown(
    problems: Problems,
    frame: { readonly revision: number; readonly stale: boolean },
    schema: Schema,
    document: SceneDocument | null,
): Problems {
    return frame.stale
        ? problems
        : without(
              problems,
              (one) =>
                  one.code === COMPILE &&
                  frame.revision > one.since &&
                  textAt(schema, document, one.place) !== one.text,
          );
}

/* The first problem at a place or inside of it. */
export function problemIn(problems: Problems, place: string): Standing | null {
    for (const problem of problems.values()) {
        if (isWithin(problem.place, place)) {
            return problem;
        }
    }
    return null;
}

/* Code that does not compile. */
export function brokenCode(problems: Problems): readonly Standing[] {
    return problems.size === 0
        ? NONE
        : [...problems.values()].filter(({ code }) => code === COMPILE);
}

const NONE: readonly Standing[] = [];
