/* SPDX-License-Identifier: MIT */
/* Parameters that a document declares for its distance functions and shaders: the list that stands
 * in the document, and the rows that make forms of it. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "./json.ts";
import {
    type DeclaredRow,
    numberParam,
    type Param,
    type ParamType,
    type Value,
    zeroOf,
} from "./schema.ts";

/* HLSL's spellings. */
const OTHER_NAMES: Record<string, ParamType> = {
    float2: "vec2",
    float3: "vec3",
    float4: "vec4",
    int2: "ivec2",
    int3: "ivec3",
    int4: "ivec4",
};

const IDENTIFIER = /^(?!gl_)(?!.*__)[A-Za-z_][A-Za-z0-9_]*$/;

/* Types that count along a range. */
const RANGED: readonly ParamType[] = [
    "float",
    "int",
    "vec2",
    "vec3",
    "vec4",
    "ivec2",
    "ivec3",
    "ivec4",
];

export function mayHaveRange(type: string): boolean {
    return RANGED.includes(typeOf(type));
}

function typeOf(name: string): ParamType {
    return OTHER_NAMES[name] ?? (name as ParamType);
}

/* The default where none is declared: 0, or what of the range is nearest to it. */
function plainDefault(type: ParamType, min: number | null, max: number | null): Value {
    const zero = zeroOf(type);
    const near = Math.min(max ?? 0, Math.max(min ?? 0, 0));
    if (near === 0 || typeof zero === "boolean") {
        return zero;
    }
    return Array.isArray(zero) ? zero.map(() => near) : near;
}

function paramOf(row: JsonObject): Param {
    const type = typeOf(textOf(row.type, "float"));
    const range = listOf(row.range);
    const [min, max] = range.length === 2 ? range.map((x) => numberOf(x)) : [null, null];
    return numberParam(textOf(row.name), {
        type,
        default: (row.default as Value | undefined) ?? plainDefault(type, min ?? null, max ?? null),
        min: min ?? null,
        max: max ?? null,
        doc: textOf(row.doc),
    });
}

const known = new WeakMap<object, readonly Param[]>();
const NONE: readonly Param[] = [];

/* The rows of a declaration; the same list for the same declaration, so that what is shown of it
 * need not be drawn anew. */
export function declaredParams(rows: Value | undefined): readonly Param[] {
    if (!Array.isArray(rows)) {
        return NONE;
    }
    let params = known.get(rows);
    if (params === undefined) {
        params = (rows as readonly Json[]).filter(isObject).map(paramOf);
        known.set(rows, params);
    }
    return params;
}

export function rowsOf(value: Value | undefined): readonly DeclaredRow[] {
    return Array.isArray(value) ? (value as readonly DeclaredRow[]) : [];
}

/* Why a parameter cannot have this name, or null. `taken`: what may not be used again. */
export function whyNotIdentifier(name: string, taken: readonly string[]): string | null {
    if (!IDENTIFIER.test(name) || name.length > 64) {
        return `"${name}" is not a name for code: letters, digits and _, no digit first`;
    }
    return taken.includes(name) ? `"${name}" is declared twice` : null;
}

function whyNotRange(row: DeclaredRow): string | null {
    if (row.range === undefined) {
        return null;
    }
    if (!mayHaveRange(row.type)) {
        return `${row.name}: a ${row.type} has no range`;
    }
    const [low, high] = row.range;
    return low < high ? null : `${row.name}: the range has to go from less to more`;
}

/* Why this cannot be declared, or null. */
export function whyNotRows(value: Value): string | null {
    const seen: string[] = [];
    for (const row of rowsOf(value)) {
        const reason = whyNotIdentifier(row.name, seen) ?? whyNotRange(row);
        if (reason !== null) {
            return reason;
        }
        seen.push(row.name);
    }
    return null;
}
