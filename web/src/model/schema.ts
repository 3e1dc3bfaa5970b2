/* SPDX-License-Identifier: MIT */
/* The registry as the server describes it (`x-fieldcast` of schema.json): types, parameters,
 * defaults, limits, and the checks that a field makes before it sends a value. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "./json.ts";

export type ParamType =
    | "float"
    | "int"
    | "bool"
    | "vec3"
    | "bvec3"
    | "ivec3"
    | "color"
    | "enum"
    | "text"
    | "material";

export type Unit = "length" | "angle" | "degrees";

/* One value of a record: what stands at a place in a document. */
export type Value = number | boolean | string | readonly number[] | readonly boolean[];

/* The values of a record that are set; what is absent has its default. */
export interface Values {
    readonly [name: string]: Value;
}

export interface Param {
    readonly name: string;
    readonly type: ParamType;
    readonly unit: Unit | null;
    readonly default: Value;
    readonly min: number | null;
    readonly max: number | null;
    readonly aboveMin: boolean;
    readonly nonzero: boolean;
    /* One number may stand for three equal ones. */
    readonly uniform: boolean;
    /* Any length but 0. */
    readonly direction: boolean;
    readonly step: number | null;
    readonly choices: readonly string[];
    readonly main: boolean;
    readonly doc: string;
}

export interface TypeRow {
    readonly type: string;
    readonly doc: string;
    readonly params: readonly Param[];
}

export interface NodeType extends TypeRow {
    readonly group: string;
    readonly exactness: string;
    readonly words: string;
    readonly children: "none" | "one" | "many";
}

export interface Limit {
    readonly name: string;
    readonly value: number;
    readonly unit: string;
    readonly doc: string;
}

export interface Schema {
    readonly nodes: readonly NodeType[];
    readonly lights: readonly TypeRow[];
    readonly shaders: readonly TypeRow[];
    readonly node: readonly Param[];
    readonly transform: readonly Param[];
    readonly camera: readonly Param[];
    readonly environment: readonly Param[];
    readonly render: readonly Param[];
    readonly limits: readonly Limit[];
}

const COMPONENTS: Record<ParamType, number> = {
    float: 1,
    int: 1,
    bool: 1,
    vec3: 3,
    bvec3: 3,
    ivec3: 3,
    color: 3,
    enum: 1,
    text: 0,
    material: 0,
};

/* Numbers in one value of this type: 1, 3, or 0 for text. */
export function components(type: ParamType): number {
    return COMPONENTS[type];
}

const ZERO: Record<ParamType, Value> = {
    float: 0,
    int: 0,
    bool: false,
    vec3: [0, 0, 0],
    bvec3: [false, false, false],
    ivec3: [0, 0, 0],
    color: [0, 0, 0],
    enum: "",
    text: "",
    material: "",
};

function readParam(json: JsonObject): Param {
    const type = textOf(json.type, "float") as ParamType;
    return {
        name: textOf(json.name),
        type,
        unit: typeof json.unit === "string" ? (json.unit as Unit) : null,
        default: (json.default as Value | undefined) ?? ZERO[type] ?? 0,
        min: typeof json.min === "number" ? json.min : null,
        max: typeof json.max === "number" ? json.max : null,
        aboveMin: json.above_min === true,
        nonzero: json.nonzero === true,
        uniform: json.uniform === true,
        direction: json.direction === true,
        step: typeof json.step === "number" && json.step > 0 ? json.step : null,
        choices: listOf(json.choices).map((choice) => textOf(choice)),
        main: json.main === true,
        doc: textOf(json.doc),
    };
}

function readParams(json: Json | undefined): Param[] {
    return listOf(json).filter(isObject).map(readParam);
}

function readRow(json: JsonObject): TypeRow {
    return {
        type: textOf(json.type),
        doc: textOf(json.doc),
        params: readParams(json.params),
    };
}

function readWords(json: Json | undefined): string {
    return Array.isArray(json) ? json.map((word) => textOf(word)).join(" ") : textOf(json);
}

function readNodeType(json: JsonObject): NodeType {
    return {
        ...readRow(json),
        group: textOf(json.group),
        exactness: textOf(json.exactness),
        words: readWords(json.words),
        children: textOf(json.children, "many") as NodeType["children"],
    };
}

/* Reads schema.json, or its `x-fieldcast` member alone. */
export function readSchema(json: Json): Schema {
    const whole = isObject(json) ? json : {};
    const inner = whole["x-fieldcast"];
    const tables = isObject(inner) ? inner : whole;
    return {
        nodes: listOf(tables.nodes).filter(isObject).map(readNodeType),
        lights: listOf(tables.lights).filter(isObject).map(readRow),
        shaders: listOf(tables.shaders).filter(isObject).map(readRow),
        node: readParams(tables.node),
        transform: readParams(tables.transform),
        camera: readParams(tables.camera),
        environment: readParams(tables.environment),
        render: readParams(tables.render),
        limits: listOf(tables.limits)
            .filter(isObject)
            .map((row) => ({
                name: textOf(row.name),
                value: numberOf(row.value),
                unit: textOf(row.unit),
                doc: textOf(row.doc),
            })),
    };
}

export const EMPTY_SCHEMA: Schema = readSchema({});

export function nodeType(schema: Schema, type: string): NodeType | null {
    return schema.nodes.find((row) => row.type === type) ?? null;
}

export function lightType(schema: Schema, type: string): TypeRow | null {
    return schema.lights.find((row) => row.type === type) ?? null;
}

export function shaderType(schema: Schema, type: string): TypeRow | null {
    return schema.shaders.find((row) => row.type === type) ?? null;
}

export function findParam(params: readonly Param[], name: string): Param | null {
    return params.find((param) => param.name === name) ?? null;
}

export function limitOf(schema: Schema, name: string, fallback: number): number {
    return schema.limits.find((limit) => limit.name === name)?.value ?? fallback;
}

/* What holds at `param`: the set value or the default. */
export function valueIn(values: Values, param: Param): Value {
    return values[param.name] ?? param.default;
}

/* Numbers of a value; a single number where three are wanted stands for all three (scale). */
export function numbersOf(value: Value, count = 3): number[] {
    if (Array.isArray(value)) {
        return value.map(Number);
    }
    return new Array<number>(count).fill(Number(value));
}

function isNumberList(value: Value, count: number): value is readonly number[] {
    return (
        Array.isArray(value) &&
        value.length === count &&
        value.every((item) => typeof item === "number")
    );
}

function checkForm(param: Param, value: Value): string | null {
    switch (param.type) {
        case "float":
        case "int":
            return typeof value === "number" ? null : "a number is expected";
        case "bool":
            return typeof value === "boolean" ? null : "true or false is expected";
        case "vec3":
            return (param.uniform && typeof value === "number") || isNumberList(value, 3)
                ? null
                : "three numbers are expected";
        case "ivec3":
        case "color":
            return isNumberList(value, 3) ? null : "three numbers are expected";
        case "bvec3":
            return Array.isArray(value) &&
                value.length === 3 &&
                value.every((item) => typeof item === "boolean")
                ? null
                : "three times true or false is expected";
        case "enum":
            return typeof value === "string" && param.choices.includes(value)
                ? null
                : `one of ${param.choices.join(", ")} is expected`;
        case "text":
        case "material":
            return typeof value === "string" ? null : "text is expected";
        default:
            return null;
    }
}

/* Largest magnitude of any number in a document, where the parameter has no limit of its own. */
const COORDINATE = 1e6;

function checkNumber(param: Param, x: number): string | null {
    if (!Number.isFinite(x)) {
        return `${x} is not a finite number`;
    }
    if ((param.type === "int" || param.type === "ivec3") && !Number.isInteger(x)) {
        return `${x} is not a whole number`;
    }
    const min = param.min ?? (param.type === "color" ? 0 : -COORDINATE);
    const max = param.max ?? COORDINATE;
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

/* Why `value` cannot stand at `param`, or null where it can. */
export function checkValue(param: Param, value: Value): string | null {
    const form = checkForm(param, value);
    if (form !== null) {
        return form;
    }
    if (typeof value === "number") {
        return checkNumber(param, value);
    }
    if (isNumberList(value, 3)) {
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

/* The nearest number that is allowed, for scrubbing: 0 is stepped over where it is refused. */
export function clampNumber(param: Param, x: number): number {
    const min = param.min ?? (param.type === "color" ? 0 : -COORDINATE);
    const max = param.max ?? COORDINATE;
    let clamped = Math.min(max, Math.max(min, x));
    if (param.aboveMin && clamped <= min) {
        clamped = min + 1e-3 * Math.max(1, Math.abs(min));
    }
    if (param.nonzero && clamped === 0) {
        clamped = 1e-3;
    }
    return param.type === "int" || param.type === "ivec3" ? Math.round(clamped) : clamped;
}

/* Node types that match a palette search, best first: name, then synonyms, then description. */
export function searchNodeTypes(schema: Schema, query: string): NodeType[] {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    const score = (row: NodeType): number => {
        const name = row.type.replaceAll("_", " ");
        let total = 0;
        for (const word of words) {
            const points = name.startsWith(word)
                ? 8
                : name.includes(word)
                  ? 6
                  : row.words
                          .toLowerCase()
                          .split(/\s+/)
                          .some((w) => w.startsWith(word))
                    ? 4
                    : row.group.includes(word)
                      ? 2
                      : row.doc.toLowerCase().includes(word)
                        ? 1
                        : 0;
            if (points === 0) {
                return 0;
            }
            total += points;
        }
        return total;
    };
    if (words.length === 0) {
        return [...schema.nodes];
    }
    return schema.nodes
        .map((row) => ({ row, points: score(row) }))
        .filter(({ points }) => points > 0)
        .sort((a, b) => b.points - a.points)
        .map(({ row }) => row);
}
