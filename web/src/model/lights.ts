/* SPDX-License-Identifier: MIT */
/* A new light, where it can be seen: beside what it is for, aimed at it, bright enough. */
import { ballWithin } from "./bounds.ts";
import type { Box } from "./camera.ts";
import { freeName, type SceneDocument, typesOf } from "./document.ts";
import type { JsonObject } from "./json.ts";
import { insertResource, type ResourceEdit } from "./resources.ts";
import { findParam, type Schema } from "./schema.ts";
import { add, length, normalize, scale, type Vector } from "./transform.ts";
import { tidy, tidyAngle } from "./units.ts";

/* From what is lit to the light. */
const FROM: Vector = normalize([2, 4, 3]);
/* Distance in radii of what is lit. */
const AWAY = 3;
const LEAST_AWAY = 3;
/* Where another light shines already, so that both together do not burn out what is bright. */
const BESIDE = 1 / 3;
/* A white matt surface is as bright as the colour where pi of it arrives (see the reference). */
const BRIGHT = Math.PI;
const CONE = Math.PI / 6;

/* What a type of light starts with; only what it has a row for. */
export function newLightValues(
    schema: Schema,
    type: string,
    lit: Box,
    others: boolean,
): JsonObject {
    const params = typesOf(schema, "lights").find((row) => row.type === type)?.params ?? [];
    const ball = ballWithin(lit);
    const away = scale(FROM, Math.max(LEAST_AWAY, AWAY * ball.radius));
    if (findParam(params, "position") === null) {
        return {};
    }
    const values: JsonObject = {
        position: add(ball.center, away).map((x) => Number(x.toPrecision(3))),
        direction: scale(FROM, -1).map((x) => Number(x.toPrecision(3))),
        angle: tidyAngle(CONE),
        intensity: tidy(Math.round(BRIGHT * (others ? BESIDE : 1) * length(away) ** 2)),
    };
    const known = ([name]: [string, unknown]): boolean => findParam(params, name) !== null;
    return Object.fromEntries(Object.entries(values).filter(known));
}

export function newLight(
    document: SceneDocument,
    schema: Schema,
    type: string,
    lit: Box,
): ResourceEdit {
    const name = freeName(document, "lights", type);
    const value = { type, ...newLightValues(schema, type, lit, document.lights.length > 0) };
    const ops = [insertResource("lights", name, value, null)];
    return { ops, label: `add ${name}`, select: [], name };
}
