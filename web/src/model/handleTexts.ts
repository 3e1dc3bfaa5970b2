/* SPDX-License-Identifier: MIT */
/* Where a handle is, as its row says it (`handle` of the registry): expressions of a record's numbers
 * and of a point of the surface. */
import { components, type Param, type Values, valueIn } from "./schema.ts";
import { type Vector, vectorOf } from "./transform.ts";
import { evaluateNamed, type Names } from "./units.ts";
import { numbersOf } from "./values.ts";

/* A point of a surface, and the unit vector out of it there. */
export interface Skin {
    readonly at: Vector;
    readonly out: Vector;
}

const UNKNOWN: Vector = [Number.NaN, Number.NaN, Number.NaN];
export const NO_SKIN = (): Skin => ({ at: UNKNOWN, out: UNKNOWN });

export const namesSkin = ({ handle }: Param): boolean => /\bskin\b/.test(handle);

type Texts = readonly string[];

const textsOf = (point: string): Texts => point.split(",").map((text) => text.trim());

/* The texts of three coordinates for each point. */
export function pointsIn({ handle }: Param): readonly [Texts, ...Texts[]] {
    const [first = "", ...more] = handle.split(";");
    return [textsOf(first), ...more.map(textsOf)];
}

/* A record, and the skin that its handles name. */
export interface Numbers {
    readonly params: readonly Param[];
    readonly values: Values;
    readonly skin: () => Skin;
}

const LETTERS = "xyzw";

/* The name of a number in expressions: "radius", "size.x". */
export const numberName = (name: string, count: number, component: number | null): string =>
    count > 1 && component !== null ? `${name}.${LETTERS[component]}` : name;

export function namesOf({ params, values, skin }: Numbers): Names {
    return (name) => {
        const [first, letter] = name.split(".");
        const part = letter === undefined ? 0 : LETTERS.indexOf(letter);
        if (first === "skin" || first === "out") {
            return skin()[first === "skin" ? "at" : "out"][part] ?? Number.NaN;
        }
        const param = params.find((row) => row.name === first);
        const numbers = param ? numbersOf(valueIn(values, param), components(param.type)) : [];
        return numbers[part] ?? Number.NaN;
    };
}

/* The same with one number replaced. */
export const namesWith =
    (names: Names, key: string, value: number): Names =>
    (name) =>
        name === key ? value : names(name);

export const evaluatePoint = (texts: Texts, names: Names): Vector =>
    vectorOf(texts.map((text) => evaluateNamed(text, names)));
