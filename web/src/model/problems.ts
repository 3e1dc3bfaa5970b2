/* SPDX-License-Identifier: MIT */
/* What is wrong with a document, by place: edits that were refused, and code that does not compile
 * and stands there all the same, while the picture shows the last that did. */
import { findResource, type SceneDocument } from "./document.ts";
import type { Operation, Problem } from "./operation.ts";
import { cleanPlace, isWithin, nodeOfPlace, resourceOfPlace, resourcePlace } from "./places.ts";

/* Notices about code: it does not compile, that took too long or crashed, it is well again, or is
 * tried again; and a scene that is not drawn. */
export const COMPILE = "compile";
export const TOO_SLOW = "too_slow";
const CRASHED = "crashed";
export const LEFT_OUT = "scene_left_out";
const OVER = ["compiled", "retrying"];

/* By place; at most one each. */
export type Problems = ReadonlyMap<string, Problem>;

export const NO_PROBLEMS: Problems = new Map();

/* Does it stand until the server says that it is over? It is told again to whoever comes. */
export function isStanding({ code }: { readonly code: string }): boolean {
    return code === COMPILE || isGivenUp(code);
}

/* Is it not tried again before somebody asks for it? */
export function isGivenUp(code: string): boolean {
    return code === TOO_SLOW || code === CRASHED || code === LEFT_OUT;
}

/* Would more time help? */
export function isTooSlow({ code, reason }: Pick<Problem, "code" | "reason">): boolean {
    return (reason ?? code) === TOO_SLOW;
}

/* Does it say that what stood at its place has ended? */
export function isEnd(code: string): boolean {
    return OVER.includes(code);
}

export function addProblem(problems: Problems, problem: Problem): Problems {
    const place = cleanPlace(problem.place);
    return new Map(problems).set(place, { ...problem, place });
}

function without(problems: Problems, gone: (problem: Problem) => boolean): Problems {
    const left = [...problems].filter(([, problem]) => !gone(problem));
    return left.length < problems.size ? new Map(left) : problems;
}

/* Before everything that stands is told again. */
export function endProblems(problems: Problems): Problems {
    return without(problems, isStanding);
}

/* What stood at `place` is over. */
export function endProblem(problems: Problems, place: string): Problems {
    return without(problems, (one) => isStanding(one) && one.place === cleanPlace(place));
}

/* An edit that touches what an earlier one was refused for settles it. */
export function settleProblems(problems: Problems, ops: readonly Operation[]): Problems {
    const touched = ops.map((op) => ownerOf("at" in op ? op.at : op.into));
    return without(problems, (one) => !isStanding(one) && touched.includes(ownerOf(one.place)));
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

/* Is the node or resource of a place there? What has none always is. */
export function isThere(document: SceneDocument, place: string): boolean {
    const node = nodeOfPlace(place);
    const resource = resourceOfPlace(place);
    return (
        (node === null || document.nodes.has(node)) &&
        (resource === null || findResource(document, resource.list, resource.name) !== null)
    );
}

/* What is gone cannot be wrong. */
export function dropGone(problems: Problems, document: SceneDocument | null): Problems {
    return problems.size === 0 || document === null
        ? problems
        : without(problems, (one) => isStanding(one) && !isThere(document, one.place));
}

/* The first problem at a place or inside of it. */
export function problemIn(problems: Problems, place: string): Problem | null {
    for (const problem of problems.values()) {
        if (isWithin(problem.place, place)) {
            return problem;
        }
    }
    return null;
}

/* What stands in the way of the newest state; first a scene that is not drawn at all. */
export function foremost(problems: Problems): Problem | null {
    const standing = brokenCode(problems);
    return standing.find(({ code }) => code === LEFT_OUT) ?? standing[0] ?? null;
}

/* What cannot be drawn. */
export function brokenCode(problems: Problems): readonly Problem[] {
    return problems.size === 0 ? NONE : [...problems.values()].filter(isStanding);
}

const NONE: readonly Problem[] = [];
