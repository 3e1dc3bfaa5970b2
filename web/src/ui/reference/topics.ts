/* SPDX-License-Identifier: MIT */
/* What the reference tells: every row of the schema's tables, and how a parameter is put in words. */
import type { Param, Schema, TypeRow, Value } from "../../model/schema.ts";
import { isAngle, printInUnit } from "../../model/units.ts";
import { typeTitle, words } from "../names.ts";
import { groupTitle } from "../palettes/additions.ts";
import { type TextKey, t } from "../texts.ts";

export interface Topic {
    /* Names it among all topics; a node's is its type. */
    key: string;
    title: string;
    group: string;
    doc: string;
    words: string;
    params: readonly Param[];
    /* Of nodes. */
    exactness: string | null;
    source: string;
    /* There is a picture of it, and it can be added. */
    node: boolean;
}

function topic(row: TypeRow, prefix: string, group: string): Topic {
    return {
        key: `${prefix}/${row.type}`,
        title: typeTitle(row.type),
        group,
        doc: row.doc,
        words: "",
        params: row.params,
        exactness: null,
        source: "",
        node: false,
    };
}

const RECORDS = ["camera", "environment", "render", "transform"] as const;

export function topicsOf(schema: Schema): readonly Topic[] {
    const record = (name: (typeof RECORDS)[number]): Topic => {
        const row = { type: name, doc: t(`reference.${name}`), params: schema[name] };
        return topic(row, "record", t("reference.records"));
    };
    return [
        ...schema.nodes.map(
            (row): Topic => ({
                ...topic(row, "node", groupTitle(row.group)),
                key: row.type,
                words: row.words,
                exactness: row.exactness,
                source: row.source,
                node: true,
            }),
        ),
        ...schema.lights.map((row) => topic(row, "light", t("lights.title"))),
        ...schema.volumes.map((row) => topic(row, "volume", t("volumes.title"))),
        ...schema.shaders.map((row) => topic(row, "shader", t("shaders.title"))),
        ...RECORDS.map(record),
    ];
}

/* --- parameters in words --- */

function printValue(value: Value, param: Param): string {
    if (Array.isArray(value)) {
        if (param.type === "points" || param.type === "rows") {
            return t("reference.count", { count: value.length });
        }
        return value.map((part) => printValue(part as Value, param)).join(", ");
    }
    if (typeof value === "number") {
        return printInUnit(value, param.unit);
    }
    if (typeof value === "boolean") {
        return t(value ? "reference.yes" : "reference.no");
    }
    return typeof value === "string" && value !== "" ? value.replaceAll("_", " ") : "–";
}

export function defaultOf(param: Param): string {
    return printValue(param.default, param);
}

/* "float · length". */
export function typeOf(param: Param): string {
    const known = `unit.${param.unit}` as TextKey;
    const unit = param.unit === null ? "" : ` · ${t(known)}`;
    return `${t(`type.${param.type}` as TextKey)}${unit}`;
}

/* Wider than this is no range that anybody meets. */
const OPEN = 1e6;

/* "above 0", "0 to 1", or what the value can be. */
export function rangeOf(param: Param): string {
    if (param.choices.length > 0) {
        return param.choices.map((choice) => choice.replaceAll("_", " ")).join(", ");
    }
    const print = (x: number): string =>
        isAngle(param.unit) ? printInUnit(x, param.unit) : printInUnit(x, null);
    const least = param.min !== null && param.min > -OPEN ? param.min : null;
    const most = param.max !== null && param.max < OPEN ? param.max : null;
    if (param.type === "points") {
        return t("reference.points", { min: least ?? 0, max: most ?? "" });
    }
    const parts = [
        least !== null && most !== null
            ? t("reference.fromTo", { min: print(least), max: print(most) })
            : least !== null
              ? t(param.aboveMin ? "reference.above" : "reference.from", { min: print(least) })
              : most !== null
                ? t("reference.upTo", { max: print(most) })
                : "",
        least !== null && most !== null && param.aboveMin
            ? t("reference.above", { min: print(least) })
            : "",
        param.nonzero ? t("reference.nonzero") : "",
        param.direction ? t("reference.direction") : "",
    ];
    return parts.filter(Boolean).join(", ");
}

const TESTS = { "=": "reference.is", "!=": "reference.isNot", "~": "reference.has" } as const;

/* When a row matters: "type is sky"; "" where it always does. */
export function conditionOf({ when }: Param): string {
    if (when === null) {
        return "";
    }
    const { name, value, test } = when;
    const what = typeof value === "boolean" ? t(`reference.${value ? "yes" : "no"}`) : value;
    return t(TESTS[test], { name: words(name), value: String(what) });
}
