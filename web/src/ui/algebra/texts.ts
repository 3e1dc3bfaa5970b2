/* SPDX-License-Identifier: MIT */
/* The texts of the workbench, which is loaded with it. */
export const TEXTS = {
    title: "Groebner bases",
    generators: "Polynomials, one in each line",
    examples: "Examples",
    make: "Make the basis",
    cancel: "Cancel",
    steps: "Steps",
    basis: "Reduced basis",
    elimination: "Elimination ideal",
    principal: "One generator: the ideal is principal.",
    notPrincipal: "It has more than one generator.",
    nothing: "Only 0 is free of these letters.",
    quotients: "Quotients",
    rest: "Rest",
    scaled: "of {scale} times the polynomial",
    copy: "Copy the basis",
    copied: "Copied.",
    waiting: "Waits for its turn …",
    running: "{count} pairs left",
    done: "Done in {ms} ms of processor time.",
    cancelled: "Cancelled.",
    hidden: "{count} earlier steps",
    graph: "Pairs left after each step",
    empty: "Choose an example, or write polynomials. Each pair of elements will be a step here.",
    pair: "Pair",
    outcome: "Outcome",
    degree: "Degree",
    divisions: "Divisions",
    leading: "Leading monomial",
} as const;

export const OUTCOME_TEXTS = {
    added: "added",
    zero: "reduced to 0",
    coprime: "left out: coprime",
    chain: "left out: chain",
} as const;

export function fill(text: string, values: Readonly<Record<string, string | number>>): string {
    return text.replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ""));
}
