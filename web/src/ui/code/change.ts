/* SPDX-License-Identifier: MIT */
import { rising } from "../../model/rising.ts";

export interface Change {
    readonly from: number;
    readonly to: number;
    readonly insert: string;
}

/* What of `after` differs from `before`: one change from the first to the last difference. */
export function changeBetween(before: string, after: string): Change {
    const least = Math.min(before.length, after.length);
    let from = 0;
    while (from < least && before[from] === after[from]) {
        from++;
    }
    let end = 0;
    while (
        end < least - from &&
        before[before.length - 1 - end] === after[after.length - 1 - end]
    ) {
        end++;
    }
    return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
}

/* The same in as many changes as lines that both have tell apart, so that a cursor between two of
 * them stays where it is. */
export function changesBetween(before: string, after: string): readonly Change[] {
    const [old, now] = [linesOf(before), linesOf(after)];
    const changes: Change[] = [];
    let [i, j, at] = [0, 0, 0];
    for (const [nextOld, nextNow] of [
        ...commonLines(old, now),
        [old.length, now.length] as const,
    ]) {
        const gone = old.slice(i, nextOld);
        changes.push(...changesOfLines(gone, now.slice(j, nextNow), at));
        at += lengthOf(gone) + (old[nextOld]?.length ?? 0);
        [i, j] = [nextOld + 1, nextNow + 1];
    }
    return changes;
}

/* Each with its end. */
const linesOf = (text: string): readonly string[] => text.match(/[^\n]*\n|[^\n]+/g) ?? [];
const lengthOf = (lines: readonly string[]) => lines.reduce((sum, line) => sum + line.length, 0);

/* As many lines as before change one by one. */
function changesOfLines(old: readonly string[], now: readonly string[], at: number): Change[] {
    const pairs =
        old.length === now.length
            ? old.map((line, i) => [line, now[i] ?? ""] as const)
            : [[old.join(""), now.join("")] as const];
    const changes: Change[] = [];
    let start = at;
    for (const [before, after] of pairs) {
        const { from, to, insert } = changeBetween(before, after);
        if (from < to || insert !== "") {
            changes.push({ from: start + from, to: start + to, insert });
        }
        start += before.length;
    }
    return changes;
}

/* Pairs of equal lines, by index and rising: those at both ends, and between them those that each
 * text has once. */
function commonLines(
    old: readonly string[],
    now: readonly string[],
): readonly (readonly [number, number])[] {
    const least = Math.min(old.length, now.length);
    let head = 0;
    while (head < least && old[head] === now[head]) {
        head++;
    }
    let tail = 0;
    while (tail < least - head && old.at(-1 - tail) === now.at(-1 - tail)) {
        tail++;
    }
    const once = (lines: readonly string[]): ReadonlyMap<string, number> => {
        const found = new Map<string, number>();
        for (let i = head; i < lines.length - tail; i++) {
            const line = lines[i] ?? "";
            found.set(line, found.has(line) ? -1 : i);
        }
        return found;
    };
    const places = once(now);
    const pairs = [...once(old)]
        .map(([line, i]) => [i, places.get(line) ?? -1] as const)
        .filter(([i, j]) => i >= 0 && j >= 0)
        .sort(([a], [b]) => a - b);
    const middle = rising(pairs.map(([, j]) => j)).map((i) => pairs[i] ?? ([0, 0] as const));
    const same = (count: number, a: number, b: number) =>
        Array.from({ length: count }, (_, i) => [a + i, b + i] as const);
    return [...same(head, 0, 0), ...middle, ...same(tail, old.length - tail, now.length - tail)];
}
