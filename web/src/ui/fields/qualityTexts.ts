/* SPDX-License-Identifier: MIT */
/* What the badge of an equation's quality says; loaded with it. */
import type { Quality } from "../../link/qualityRest.ts";

const WORDS = {
    polynomial: "Exact polynomial of degree {degree}",
    safe: "Safe",
    pole: "Unsafe: pole at ({at})",
    jump: "Unsafe: jump at ({at})",
    unresolved: "{share} unresolved",
} as const;

const DOCS = {
    polynomial:
        "The equation is a polynomial. Its coefficients bound each distance, so no ray steps over the surface.",
    safe: "Intervals of value and slope bound each distance, so no ray steps over the surface. No pole and no jump was found on 192 lines through the clip.",
    pole: "At this point of the node the value goes from one sign to the other through infinity, not through 0. A wall is drawn there that is no part of the surface. Multiply both sides by the denominator, or make the clip smaller.",
    jump: "At this point of the node the value jumps from one sign to the other. A wall is drawn there that is no part of the surface.",
    unresolved:
        "{unresolved} of {rays} rays through the clip end where the equation keeps its sign, as at a double root, or where its slope has no bound. What is seen there may be no surface. The mode “sheet” draws double roots.",
} as const;

function fill(text: string, values: Readonly<Record<string, string | number>>): string {
    return text.replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ""));
}

type Kind = "polynomial" | "safe" | "pole" | "jump";

function kindOf({ quality, breaks }: Quality): Kind {
    return quality === "exact polynomial" ? "polynomial" : (breaks ?? "safe");
}

function shareOf({ unresolved, rays }: Quality): string {
    const percent = (100 * unresolved) / rays;
    return percent < 1 ? "below 1 %" : `${Math.round(percent)} %`;
}

function numberText(value: number): string {
    return String(Number(value.toPrecision(3))).replace("-", "−");
}

export interface QualityTexts {
    /* On the badge; what it means; what unresolved rays mean. */
    readonly words: string;
    readonly doc: string;
    readonly note: string | undefined;
}

export function qualityTexts(quality: Quality): QualityTexts {
    const kind = kindOf(quality);
    const open = quality.unresolved > 0;
    const { degree, unresolved, rays, at } = quality;
    const words = fill(WORDS[kind], { degree, at: at.map(numberText).join(", ") });
    const share = open ? `, ${fill(WORDS.unresolved, { share: shareOf(quality) })}` : "";
    return {
        words: words + share,
        doc: DOCS[kind],
        note: open ? fill(DOCS.unresolved, { unresolved, rays }) : undefined,
    };
}
