/* SPDX-License-Identifier: MIT */
/* The parametric surface that an equation was found for, and the ranges that its letters start
 * with. */
import { isObject, type JsonObject, textOf } from "./json.ts";

export const PARTS = ["x", "y", "z"] as const;
export const LETTERS = ["s", "t", "u", "v"] as const;

/* Expressions in two parameters. */
export interface PartTexts {
    readonly x: string;
    readonly y: string;
    readonly z: string;
}

export type SurfaceRange = readonly [number, number];

/* As it stands in a document; {}: none. */
export interface SurfaceValue extends JsonObject {
    readonly x?: string;
    readonly y?: string;
    readonly z?: string;
    readonly s?: SurfaceRange;
    readonly t?: SurfaceRange;
    readonly u?: SurfaceRange;
    readonly v?: SurfaceRange;
}

export interface Surface {
    readonly texts: PartTexts;
    readonly ranges: Readonly<Record<string, SurfaceRange>>;
}

const isRange = (value: unknown): value is SurfaceRange =>
    Array.isArray(value) && value.length === 2 && value.every((x) => typeof x === "number");

/* null: there is none. */
export function readSurface(value: unknown): Surface | null {
    if (!isObject(value) || typeof value.x !== "string") {
        return null;
    }
    const { x, y, z } = value;
    const ranges = LETTERS.flatMap((letter) => {
        const range = value[letter];
        return isRange(range) ? [[letter, range] as const] : [];
    });
    return { texts: { x, y: textOf(y), z: textOf(z) }, ranges: Object.fromEntries(ranges) };
}

/* Once around, for an angle; else about 0. */
const TURN: SurfaceRange = [0, 6.283185];
const AROUND: SurfaceRange = [-1, 1];

export function firstRange(texts: PartTexts, letter: string): SurfaceRange {
    const angle = new RegExp(`\\b(sin|cos|tan)\\([^()]*${letter}`);
    return PARTS.some((part) => angle.test(texts[part])) ? TURN : AROUND;
}

/* Its value with the ranges of these letters. */
export function surfaceValue({ texts, ranges }: Surface, letters: readonly string[]): SurfaceValue {
    const chosen = letters.map((letter) => [letter, ranges[letter] ?? firstRange(texts, letter)]);
    return { ...texts, ...Object.fromEntries(chosen) };
}
