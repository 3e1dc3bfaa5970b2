/* SPDX-License-Identifier: MIT */
/* What the badge of an equation's quality says; loaded with it. */
import type { Quality } from "../../link/qualityRest.ts";
import { fillText, withUnits } from "../texts.ts";

const WORDS = {
    polynomial: "Exact polynomial of degree {degree}",
    safe: "Safe",
    pole: "Unsafe: pole at ({at})",
    jump: "Unsafe: jump at ({at})",
    unresolved: "{share} unresolved",
    sampled: "Sampled: {patches} patches, off by {error}",
    thin: "Sampled too coarsely: off by {error}",
    leftOut: "{leftOut} left out",
} as const;

const DOCS = {
    polynomial:
        "The equation is a polynomial. Its coefficients bound each distance, so no ray steps over the surface.",
    safe: "Intervals of value and slope bound each distance, so no ray steps over the surface. No pole and no jump was found on 192 lines through the clip.",
    pole: "At this point of the node the value goes from one sign to the other through infinity, not through 0. A wall is drawn there that is no part of the surface. Multiply both sides by the denominator, or make the clip smaller.",
    jump: "At this point of the node the value jumps from one sign to the other. A wall is drawn there that is no part of the surface.",
    sampled:
        "The surface is drawn by bicubic patches through its points. The number is how far they are from it, at most, at four points of each: an estimate.",
    thin: "The patches are farther from the surface than half of its thickness. Choose more detail, or smaller ranges.",
    leftOut:
        "{leftOut} of {patches} patches have a point that is not finite. There the surface has a hole.",
    unresolved:
        "{unresolved} of {rays} rays through the clip end where the equation keeps its sign, as at a double root, or where its slope has no bound. What is seen there may be no surface. The mode “sheet” draws double roots.",
} as const;

type Kind = "polynomial" | "safe" | "pole" | "jump" | "sampled" | "thin";

function kindOf({ quality, breaks, thin }: Quality): Kind {
    const sampled = thin ? "thin" : "sampled";
    return quality === "sampled"
        ? sampled
        : quality === "exact polynomial"
          ? "polynomial"
          : (breaks ?? "safe");
}

function shareOf({ unresolved, rays }: Quality): string {
    const percent = (100 * unresolved) / rays;
    return withUnits(percent < 1 ? "below 1 %" : `${Math.round(percent)} %`);
}

function numberText(value: number): string {
    return String(Number(value.toPrecision(3))).replaceAll("-", "−");
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
    const { degree, unresolved, rays, at, patches, leftOut } = quality;
    const words = fillText(WORDS[kind], {
        degree,
        at: at.map(numberText).join(", "),
        patches,
        error: numberText(Number(quality.error.toPrecision(1))),
    });
    const share = open ? `, ${fillText(WORDS.unresolved, { share: shareOf(quality) })}` : "";
    const holes = leftOut > 0 ? `, ${fillText(WORDS.leftOut, { leftOut })}` : "";
    const note = leftOut > 0 ? DOCS.leftOut : DOCS.unresolved;
    return {
        words: words + share + holes,
        doc: DOCS[kind],
        note:
            open || leftOut > 0
                ? fillText(note, { unresolved, rays, leftOut, patches })
                : undefined,
    };
}
