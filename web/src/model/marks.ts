/* SPDX-License-Identifier: MIT */
/* What stands in the scene and is not seen in its picture: lights and volumes with a place, and the
 * document's camera. */
import { type Camera, cameraOf } from "./camera.ts";
import { resourceParams, type SceneDocument } from "./document.ts";
import type { ListName } from "./places.ts";
import { findParam, type Schema, valueIn } from "./schema.ts";
import { length, subtract, type Vector, vectorOf } from "./transform.ts";
import { numbersOf } from "./values.ts";

export interface Mark {
    readonly key: string;
    /* Null: the camera. */
    readonly list: ListName | null;
    readonly name: string;
    readonly type: string;
    readonly at: Vector;
}

/* Scene units within which the page's camera is the document's. */
const SAME = 1e-3;

export function looksThrough(document: SceneDocument, seen: Camera): boolean {
    return length(subtract(cameraOf(document.camera).position, seen.position)) < SAME;
}

export function marksOf(schema: Schema, document: SceneDocument, seen: Camera): readonly Mark[] {
    const marks: Mark[] = (["lights", "volumes"] as const).flatMap((list) =>
        document[list].flatMap(({ name, type, values }) => {
            const param = findParam(resourceParams(schema, document, list, type), "position");
            return param
                ? [
                      {
                          key: `${list}/${name}`,
                          list,
                          name,
                          type,
                          at: vectorOf(numbersOf(valueIn(values, param))),
                      },
                  ]
                : [];
        }),
    );
    const { position } = cameraOf(document.camera);
    return looksThrough(document, seen)
        ? marks
        : [...marks, { key: "camera", list: null, name: "", type: "", at: position }];
}
