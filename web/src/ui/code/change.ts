/* SPDX-License-Identifier: MIT */
/* What of `after` differs from `before`: one change from the first to the last difference. */
export function changeBetween(before: string, after: string) {
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
