/* SPDX-License-Identifier: MIT */
/* Numbers as people write them: expressions, degrees, colours; and back with few digits. */
import type { Unit } from "./schema.ts";
import type { Vector } from "./transform.ts";

/* --- numbers --- */

const DIGITS = 6;

/* `x` with at most six significant digits: what documents get, so that they stay readable. */
export function tidy(x: number): number {
    const rounded = Number(x.toPrecision(DIGITS));
    return Object.is(rounded, -0) ? 0 : rounded;
}

const FUNCTIONS = [
    "sqrt",
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "log",
    "abs",
] as const;

/* What names in an expression stand for; NaN: nothing. */
export type Names = (name: string) => number;

/* Recursive descent over one line of arithmetic. */
class Expression {
    readonly #text: string;
    readonly #names: Names;
    #at = 0;

    constructor(text: string, names: Names = () => Number.NaN) {
        this.#text = text;
        this.#names = names;
    }

    #skip(): void {
        while (this.#text[this.#at] === " ") {
            this.#at++;
        }
    }

    #take(token: string): boolean {
        this.#skip();
        if (!this.#text.startsWith(token, this.#at)) {
            return false;
        }
        this.#at += token.length;
        return true;
    }

    #match(pattern: RegExp): string | null {
        this.#skip();
        const found = pattern.exec(this.#text.slice(this.#at));
        this.#at += found?.[0].length ?? 0;
        return found?.[0] ?? null;
    }

    #atom(): number {
        if (this.#take("(")) {
            const inner = this.#sum();
            return this.#take(")") ? inner : Number.NaN;
        }
        const number = this.#match(/^(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i);
        if (number !== null) {
            return Number(number);
        }
        const word = this.#match(/^[a-zπ][\w.]*/i)?.toLowerCase() ?? "";
        switch (word) {
            case "pi":
            case "π":
                return Math.PI;
            default: {
                const known = FUNCTIONS.find((name) => name === word);
                return known ? Math[known](this.#atom()) : this.#names(word);
            }
        }
    }

    #power(): number {
        if (this.#take("-")) {
            return -this.#power();
        }
        if (this.#take("+")) {
            return this.#power();
        }
        const base = this.#atom();
        return this.#take("^") ? base ** this.#power() : base;
    }

    #product(): number {
        let value = this.#power();
        for (;;) {
            if (this.#take("*")) {
                value *= this.#power();
            } else if (this.#take("/")) {
                value /= this.#power();
            } else {
                return value;
            }
        }
    }

    #sum(): number {
        let value = this.#product();
        for (;;) {
            if (this.#take("+")) {
                value += this.#product();
            } else if (this.#take("-")) {
                value -= this.#product();
            } else {
                return value;
            }
        }
    }

    value(): number {
        const value = this.#sum();
        this.#skip();
        return this.#at === this.#text.length ? value : Number.NaN;
    }
}

/* One line of arithmetic with names, such as a handle of the registry; NaN where it has no value. */
export function evaluateNamed(text: string, names: Names): number {
    return new Expression(text, names).value();
}

/* A comma between digits is a decimal point: people type what their keyboard has. */
function evaluate(text: string): number | null {
    const value = new Expression(text.trim().replace(/(\d),(\d)/g, "$1.$2")).value();
    return Number.isFinite(value) ? value : null;
}

/* What was typed, in the unit shown: `1/3`, `pi/4`; `+=0.1`, `-=`, `*2`, `/2`, `*=`, `/=` start
 * from `current`. Null where it means nothing. */
export function parseNumber(text: string, current: number): number | null {
    const relative = /^\s*(\+=|-=|\*=|\/=|\*|\/)(.*)$/.exec(text);
    const value = evaluate(relative?.[2] ?? text);
    if (value === null || !relative) {
        return value;
    }
    const results: Record<string, number> = {
        "+": current + value,
        "-": current - value,
        "*": current * value,
        "/": current / value,
    };
    const result = results[relative[1]?.[0] ?? ""];
    return result !== undefined && Number.isFinite(result) ? result : null;
}

export function printNumber(x: number): string {
    return String(tidy(x));
}

const SHORT_DIGITS = 4;

/* For people, beside a picture. */
export function shortNumber(x: number): string {
    return printNumber(Number(x.toPrecision(SHORT_DIGITS)));
}

/* --- units --- */

const DEGREE = Math.PI / 180;
/* In degrees: far more than arithmetic adds, far less than anybody types. */
const ANGLE_NOISE = 1e-9;
const FULL_DIGITS = 12;

/* An angle stands in radians in the document and is shown in degrees; `degrees` already are. */
export function isAngle(unit: Unit | null): boolean {
    return unit === "angle" || unit === "degrees";
}

/* From the document's number to the one shown, and back. */
export function toShown(x: number, unit: Unit | null): number {
    return unit === "angle" ? x / DEGREE : x;
}

export function fromShown(x: number, unit: Unit | null): number {
    return unit === "angle" ? x * DEGREE : x;
}

/* An angle in radians without the noise of its arithmetic: whole degrees and such to the last bit,
 * so that they are shown as they were typed. */
export function tidyAngle(x: number): number {
    const degrees = x / DEGREE;
    if (Math.abs(degrees) < ANGLE_NOISE) {
        return 0;
    }
    const near = tidy(degrees);
    const isNear = Math.abs(near - degrees) <= ANGLE_NOISE * Math.max(1, Math.abs(degrees));
    return isNear ? near * DEGREE : Number(x.toPrecision(FULL_DIGITS));
}

/* A typed value in the document's unit. Bare numbers in an angle are degrees; `0.26rad` and what
 * mentions pi are radians; `deg` and `°` say so themselves. */
export function parseInUnit(text: string, unit: Unit | null, current: number): number | null {
    if (!isAngle(unit)) {
        return parseNumber(text, current);
    }
    const radians = unit === "angle" ? current : current * DEGREE;
    const bare = text.replace(/(rad|deg|°)\s*$/i, "");
    const inRadians = /rad\s*$/i.test(text) || (/pi|π/i.test(bare) && bare === text);
    const scaling = /^\s*[*/]/.test(bare);
    let value: number | null;
    if (inRadians || scaling) {
        value = parseNumber(bare, radians);
    } else {
        const shown = parseNumber(bare, radians / DEGREE);
        value = shown === null ? null : shown * DEGREE;
    }
    return value === null || unit === "angle" ? value : value / DEGREE;
}

/* "0.5", "15°": what a field shows. */
export function printInUnit(x: number, unit: Unit | null): string {
    return isAngle(unit) ? `${printNumber(toShown(x, unit))}°` : printNumber(x);
}

/* The same with up to 12 digits: what a tip shows where a field has fewer. */
export function fullInUnit(x: number, unit: Unit | null): string {
    const digits = Number(toShown(x, unit).toPrecision(FULL_DIGITS));
    return isAngle(unit) ? `${digits}°` : String(digits);
}

/* Numbers pasted as "1 2 3", "1, 2, 3" or "[1,2,3]", each as `parse` reads it; null where there are
 * not `count`. */
export function parseVector(
    text: string,
    count = 3,
    parse: (part: string) => number | null = evaluate,
): readonly number[] | null {
    const inner = text
        .trim()
        .replace(/^[[(]|[\])]$/g, "")
        .trim()
        .replace(/\s+(?=(rad|deg|°)(?![a-z]))/gi, "");
    const parts = /[;\s]/.test(inner) ? inner.split(/[;,]?\s+|;/) : inner.split(",");
    const numbers = parts.map((part) => parse(part)).filter((x) => x !== null);
    return parts.length === count && numbers.length === count ? numbers : null;
}

/* How much one pixel of scrubbing changes `x`: a hundredth of its decade. */
export function scrubStep(x: number): number {
    return 10 ** Math.floor(Math.log10(Math.max(Math.abs(x), 0.1))) / 100;
}

/* The nearest multiple of `step`, without the noise of division. */
export function snap(x: number, step: number): number {
    return step > 0 ? tidy(Math.round(x / step) * step) : x;
}

/* --- colours: documents hold linear RGB, screens and people sRGB (IEC 61966-2-1) --- */

export function toSrgb(x: number): number {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

export function fromSrgb(x: number): number {
    return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

/* Colours brighter than white are a hue up to 1 times a strength. */
export function splitStrength(color: Vector): { base: Vector; strength: number } {
    const strength = Math.max(1, ...color);
    return { base: [color[0] / strength, color[1] / strength, color[2] / strength], strength };
}

/* "#rrggbb" of a linear colour; what exceeds 1 is shown at 1. */
export function toHex(color: Vector): string {
    const byte = (x: number): string =>
        Math.round(255 * Math.min(1, Math.max(0, toSrgb(Math.max(0, x)))))
            .toString(16)
            .padStart(2, "0");
    return `#${color.map(byte).join("")}`;
}

/* A linear colour from "#rgb", "#rrggbb" or the same without "#"; null where it is none. */
export function fromHex(text: string): Vector | null {
    const digits = text.trim().replace(/^#/, "");
    const full = digits.length === 3 ? digits.replace(/./g, "$&$&") : digits;
    if (!/^[0-9a-f]{6}$/i.test(full)) {
        return null;
    }
    const channel = (i: number): number =>
        tidy(fromSrgb(Number.parseInt(full.slice(2 * i, 2 * i + 2), 16) / 255));
    return [channel(0), channel(1), channel(2)];
}
