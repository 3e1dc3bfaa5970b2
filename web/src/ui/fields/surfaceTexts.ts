/* SPDX-License-Identifier: MIT */
/* What the fields of parametric surfaces say; loaded with them. */
import type { Coverage } from "../../link/surfaceRest.ts";
import { fillText, withUnits } from "../texts.ts";

const texts = {
    open: "From a parametric surface …",
    title: "Equation of a parametric surface",
    doc: "Expressions in two of the letters s, t, u, v: polynomials and fractions. A letter may stand in sin, cos, tan alone, or in exp, sinh, cosh, tanh alone.",
    equation: "Equation",
    busy: "Looking for the equation …",
    step: "{text} ({seconds} s)",
    cancel: "Cancel",
    cancelled: "Cancelled.",
    found: "Degree {degree}, {terms} terms; proved to be exact.",
    large: "An equation of this size cannot be drawn: {why}.",
    take: "Use this equation",
    from: "{letter} from",
    to: "{letter} to",
    range: "{letter} has to end above its start.",
    change: "Change …",
    none: "No equation: {reason} The sampled surface stays.",
    make: "Make implicit",
    makeEdit: "equation instead of the sampled surface",
    part: "{label} {part}",
    edit: "equation of a parametric surface",
    trim: "Keep only the patch",
    trimEdit: "the patch alone",
    "proof.busy": "Being checked …",
    "proof.verified": "Verified: {reason}",
    "proof.unverified": "Not verified: {reason}",
} as const;

export function surfaceText(
    key: keyof typeof texts,
    values: Readonly<Record<string, string | number>> = {},
): string {
    return fillText(texts[key], values);
}

/* As the server says it, as a sentence. */
export function coverageSentence({ text }: Coverage): string {
    return withUnits(`${text.slice(0, 1).toUpperCase()}${text.slice(1)}.`);
}
