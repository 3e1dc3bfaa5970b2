/* SPDX-License-Identifier: MIT */

/* The indices of a longest rising row among different numbers. */
export function rising(numbers: readonly number[]): readonly number[] {
    /* By length less 1: where a row of that length ends, at the least number. */
    const ends: number[] = [];
    const previous: number[] = [];
    for (const [i, number] of numbers.entries()) {
        let [low, high] = [0, ends.length];
        while (low < high) {
            const middle = (low + high) >> 1;
            const less = (numbers[ends[middle] ?? 0] ?? 0) < number;
            [low, high] = less ? [middle + 1, high] : [low, middle];
        }
        previous[i] = ends[low - 1] ?? -1;
        ends[low] = i;
    }
    const found: number[] = [];
    for (let i = ends.at(-1) ?? -1; i >= 0; i = previous[i] ?? -1) {
        found.unshift(i);
    }
    return found;
}
