/* SPDX-License-Identifier: MIT */
/* What a row accepts: the checks that a field makes before it sends a value, and the nearest
 * number that passes them. */
import { declaredParams, whyNotRows } from "./declaredParams.ts";
import { isObject } from "./json.ts";
import { bytesOf } from "./jsonText.ts";
import {
    components,
    limitOf,
    type Param,
    type ParamType,
    type Schema,
    type Value,
} from "./schema.ts";

/* Numbers of a value; a single number where several are wanted stands for all (scale). */
export function numbersOf(value: Value, count = 3): number[] {
    if (Array.isArray(value)) {
        return value.map(Number);
    }
    return new Array<number>(count).fill(Number(value));
}

/* Points of the plane; what is none is left out. */
export function pointsOf(value: Value): [number, number][] {
    return Array.isArray(value)
        ? value
              .filter((point) => isNumberList(point, 2))
              .map((point): [number, number] => [point[0] ?? 0, point[1] ?? 0])
        : [];
}

export function isWhole(type: ParamType): boolean {
    return type === "int" || type.startsWith("ivec");
}

function isNumberList(value: unknown, count: number): value is readonly number[] {
    return (
        Array.isArray(value) &&
        value.length === count &&
        value.every((item) => typeof item === "number")
    );
}

const COUNTS = ["no", "one", "two", "three", "four"];

function checkForm(param: Param, value: Value): string | null {
    const expected = (what: string, holds: boolean) => (holds ? null : `${what} expected`);
    switch (param.type) {
        case "float":
        case "int":
            return expected("a number is", typeof value === "number");
        case "bool":
            return expected("true or false is", typeof value === "boolean");
        case "vec2":
        case "vec3":
        case "vec4":
        case "ivec2":
        case "ivec3":
        case "ivec4":
        case "color": {
            const count = components(param.type);
            const one = param.uniform && typeof value === "number";
            return expected(`${COUNTS[count]} numbers are`, one || isNumberList(value, count));
        }
        case "bvec3": {
            const flags = Array.isArray(value) && value.length === 3;
            const all = flags && value.every((item) => typeof item === "boolean");
            return expected("three times true or false is", all);
        }
        case "enum": {
            const known = typeof value === "string" && param.choices.includes(value);
            return expected(`one of ${param.choices.join(", ")} is`, known);
        }
        case "points": {
            const all = Array.isArray(value) && value.every((item) => isNumberList(item, 2));
            return expected("a list of points is", all);
        }
        case "rows":
            return expected("a list of parameters is", Array.isArray(value));
        case "surface":
            return expected("a parametric surface is", isObject(value));
        case "text":
        case "material":
        case "code":
        case "equation":
        case "model":
        case "function":
        case "asset":
            return expected("text is", typeof value === "string");
        default:
            return null;
    }
}

/* Largest magnitude of any number in a document, where the parameter has no limit of its own. */
export const COORDINATE = 1e6;

function rangeOf(param: Param): readonly [number, number] {
    const least = param.type === "color" ? 0 : -COORDINATE;
    return [param.min ?? least, param.max ?? COORDINATE];
}

/* Why `x` cannot be a number of this row, or null where it can. */
export function checkNumber(param: Param, x: number): string | null {
    const [min, max] = rangeOf(param);
    if (!Number.isFinite(x)) {
        return `${x} is not a finite number`;
    }
    if (isWhole(param.type) && !Number.isInteger(x)) {
        return `${x} is not a whole number`;
    }
    if (x < min) {
        return `${x} is below the minimum ${min}`;
    }
    if (param.aboveMin && x <= min) {
        return `${x} is not above ${min}`;
    }
    if (x > max) {
        return `${x} is above the maximum ${max}`;
    }
    return param.nonzero && x === 0 ? "0 is not allowed" : null;
}

function checkPoints(param: Param, points: readonly (readonly number[])[]): string | null {
    const [min, max] = [param.min ?? 0, param.max ?? Number.POSITIVE_INFINITY];
    if (points.length < min) {
        return `${points.length} points are below the minimum ${min}`;
    }
    if (points.length > max) {
        return `${points.length} points are above the maximum ${max}`;
    }
    const far = points.flat().find((x) => !(Math.abs(x) <= COORDINATE));
    return far === undefined ? null : `${far} is beyond ±${COORDINATE}`;
}

/* Why `value` cannot stand at `param`, or null where it can. */
export function checkValue(param: Param, value: Value): string | null {
    const form = checkForm(param, value);
    if (form !== null) {
        return form;
    }
    if (param.type === "points") {
        return checkPoints(param, value as readonly (readonly number[])[]);
    }
    if (param.type === "rows") {
        return whyNotRows(value) ?? checkDefaults(declaredParams(value));
    }
    if (typeof value === "number") {
        return checkNumber(param, value);
    }
    if (isNumberList(value, components(param.type))) {
        for (const x of value) {
            const problem = checkNumber(param, x);
            if (problem !== null) {
                return problem;
            }
        }
        return param.direction && value.every((x) => x === 0) ? "a direction is not 0 0 0" : null;
    }
    return null;
}

/* How many bytes texts may have, by the names of the limits, and which control characters. */
const TEXTS: Partial<Record<ParamType, { limit: string; allowed: string }>> = {
    text: { limit: "name_bytes", allowed: "" },
    code: { limit: "code_bytes", allowed: "\t\n" },
    equation: { limit: "equation_bytes", allowed: "\t\n" },
};

/* Why a text cannot stand at `param`, or null where it can. What it says is the server's matter. */
export function checkText(schema: Schema, { type }: Param, value: Value): string | null {
    const rule = TEXTS[type];
    if (rule === undefined || typeof value !== "string") {
        return null;
    }
    const most = limitOf(schema, rule.limit, Number.POSITIVE_INFINITY);
    const bytes = bytesOf(value);
    if (bytes > most) {
        return `${bytes} bytes are above the maximum ${most}`;
    }
    const strange = [...value].find((one) => isControl(one) && !rule.allowed.includes(one));
    return strange === undefined
        ? null
        : `control character ${strange.codePointAt(0)} is not allowed`;
}

function isControl(character: string): boolean {
    return character < " " || character === "\x7f";
}

/* The beginning of a text, of as many whole characters as `most` bytes hold. */
export function cutToBytes(text: string, most: number): string {
    let bytes = 0;
    let length = 0;
    for (const character of text) {
        bytes += bytesOf(character);
        if (bytes > most) {
            return text.slice(0, length);
        }
        length += character.length;
    }
    return text;
}

function checkDefaults(params: readonly Param[]): string | null {
    for (const param of params) {
        const problem = checkValue(param, param.default);
        if (problem !== null) {
            return `the default of ${param.name}: ${problem}`;
        }
    }
    return null;
}

/* The nearest number that is allowed, for scrubbing: 0 is stepped over where it is refused. */
export function clampNumber(param: Param, x: number): number {
    const [min, max] = rangeOf(param);
    let clamped = Math.min(max, Math.max(min, x));
    if (param.aboveMin && clamped <= min) {
        clamped = min + 1e-3 * Math.max(1, Math.abs(min));
    }
    if (param.nonzero && clamped === 0) {
        clamped = 1e-3;
    }
    return isWhole(param.type) ? Math.round(clamped) : clamped;
}
