/* SPDX-License-Identifier: MIT */
/* The parametric surface of a node, or that an equation was found for, and the ranges that its
 * letters start with. */
import { isObject, type JsonObject, textOf } from "./json.ts";
import { wordsIn } from "./schema.ts";

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

/* How the surface of another node follows. */
export type SurfaceRevision = (own: SurfaceValue) => SurfaceValue;

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

/* The two parameters: those that the texts are in, where they are in two; else as it was. */
export function lettersOf({ texts, ranges }: Surface): readonly string[] {
    const words = PARTS.flatMap((part) => wordsIn(texts[part]));
    const used = LETTERS.filter((letter) => words.includes(letter));
    const before = LETTERS.filter((letter) => letter in ranges);
    const both = [...new Set([...used, ...before, ...LETTERS])].slice(0, 2);
    return used.length > 2 && before.length === 2
        ? before
        : LETTERS.filter((letter) => both.includes(letter));
}

export const NO_SURFACE: Surface = { texts: { x: "", y: "", z: "" }, ranges: {} };

/* A surface's value with one part replaced; its parameters are those of the texts. */
export function withText(value: SurfaceValue, part: keyof PartTexts, text: string): SurfaceValue {
    const surface = readSurface(value) ?? NO_SURFACE;
    const next = { ...surface, texts: { ...surface.texts, [part]: text } };
    return surfaceValue(next, lettersOf(next));
}

/* A surface's value with another range of a parameter; as it was where it has no such parameter, or
 * where the range would end before its start. */
export function withRange(
    value: SurfaceValue,
    letter: string,
    change: (own: SurfaceRange) => SurfaceRange,
): SurfaceValue {
    const surface = readSurface(value) ?? NO_SURFACE;
    const own = rangesOf(surface)[letter];
    const range = own && change(own);
    if (range === undefined || range[0] >= range[1]) {
        return value;
    }
    const ranges = { ...surface.ranges, [letter]: range };
    return surfaceValue({ ...surface, ranges }, lettersOf(surface));
}

/* The ranges of its parameters, also of those that have none yet. */
export function rangesOf(surface: Surface): Readonly<Record<string, SurfaceRange>> {
    return readSurface(surfaceValue(surface, lettersOf(surface)))?.ranges ?? {};
}

/* As many digits as a number may have that is proved with. */
const EXACT_DIGITS = 15;
const exactText = (value: number): string => `${Number(value.toPrecision(EXACT_DIGITS))}`;

/* The texts with the values of the node's own letters in them: what is proved has none. */
export function withNumbers(
    texts: PartTexts,
    numbers: Readonly<Record<string, number>>,
): PartTexts {
    const put = (text: string): string =>
        text.replace(/[A-Za-z_]\w*/g, (word) => {
            const value = Object.hasOwn(numbers, word) ? numbers[word] : undefined;
            return value === undefined ? word : `(${exactText(value)})`;
        });
    return { x: put(texts.x), y: put(texts.y), z: put(texts.z) };
}
