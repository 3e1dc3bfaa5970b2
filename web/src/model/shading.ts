/* SPDX-License-Identifier: MIT */
/* Another shader for a material: what means the same in both is kept. What properties mean stands in
 * the schema's tables (`means`); here are only the formulas between two words for one thing. */
import { findResource, resourceParams, type SceneDocument } from "./document.ts";
import type { Operation } from "./operation.ts";
import { resourcePlace, valuesPlace } from "./places.ts";
import { findParam, type Param, type Schema, type Value } from "./schema.ts";
import { tidy } from "./units.ts";
import { clampNumber } from "./values.ts";

interface Conversion {
    readonly from: string;
    readonly to: string;
    readonly by: (x: number) => number;
}

/* Exponent n of a highlight and roughness r: r⁴ = 2 / (n + 2), after Karis, "Specular BRDF
 * Reference" (2013), with alpha = r². */
const CONVERSIONS: readonly Conversion[] = [
    { from: "gloss", to: "roughness", by: (n) => (2 / (n + 2)) ** 0.25 },
    { from: "roughness", to: "gloss", by: (r) => 2 / Math.max(r, 1e-3) ** 4 - 2 },
    { from: "opacity", to: "transmission", by: (x) => 1 - x },
    { from: "transmission", to: "opacity", by: (x) => 1 - x },
];

const same = (x: number): number => x;

/* The row of `params` that means what `row` means, and how numbers get there. */
function counterpart(row: Param, params: readonly Param[]) {
    const meaning = (word: string) => params.find((param) => param.means === word);
    const twin = row.means === "" ? undefined : meaning(row.means);
    if (twin) {
        return { param: twin, by: same };
    }
    const conversion = CONVERSIONS.find(({ from, to }) => from === row.means && meaning(to));
    const param = conversion && meaning(conversion.to);
    return param ? { param, by: conversion.by } : null;
}

function converted(value: Value, param: Param, by: (x: number) => number): Value {
    const one = (x: number): number => tidy(clampNumber(param, by(x)));
    return Array.isArray(value) ? value.map((x) => one(Number(x))) : one(Number(value));
}

/* Operations that give a material another shader, and the names of values that this has none for. */
export function changeShader(
    document: SceneDocument,
    schema: Schema,
    name: string,
    shader: string,
): { ops: Operation[]; lost: string[] } {
    const material = findResource(document, "materials", name);
    const from = resourceParams(schema, document, "materials", material?.type ?? "");
    const to = resourceParams(schema, document, "materials", shader);
    const place = `${resourcePlace("materials", name)}/shader`;
    const ops: Operation[] = [{ op: "set", at: place, value: shader }];
    const lost: string[] = [];
    for (const [key, value] of Object.entries(material?.values ?? {})) {
        const row = findParam(from, key);
        const found = row && counterpart(row, to);
        if (found && found.param.name !== key) {
            const at = `${valuesPlace("materials", name)}/${found.param.name}`;
            ops.push({ op: "set", at, value: converted(value, found.param, found.by) as never });
        } else if (!findParam(to, key)) {
            lost.push(key);
        }
    }
    return { ops, lost };
}
