/* SPDX-License-Identifier: MIT */
/* Names of the schema as people read them: smooth_union -> smooth union, fov -> field of view. */
import { nodeLabel, type SceneDocument } from "../model/document.ts";
import { nodeOfPlace, resourceOfPlace } from "../model/places.ts";
import type { Param } from "../model/schema.ts";
import type { RendererInfo } from "../model/stores.ts";
import { capitalised } from "../model/texts.ts";
import { t } from "./texts.ts";

const spoken: Record<string, string> = {
    fov: "field of view",
    ior: "refraction index",
    k: "smoothness",
    a: "point A",
    b: "point B",
    c: "point C",
    d: "point D",
    t: "share",
    params: "parameters",
    parametric: "parametric surface",
    lipschitz: "steepness",
    doc: "help",
    fog: "fog density",
    floor: "floor shown",
    shadow: "shadow kind",
};

/* Of equations; elsewhere they are points. */
const letters: Record<string, string> = { a: "a", b: "b", c: "c", d: "d" };

/* The texts of the page are British. */
export function words(name: string): string {
    return name
        .replaceAll("_", " ")
        .replace(/\bcolor(\d*)\b/, (_, number: string) => `colour ${number}`.trimEnd());
}

/* Of an equation. */
export const isLetter = (param: Param): boolean => param.when?.test === "~";

export function paramTitle(param: Param): string {
    if (isLetter(param)) {
        return param.name;
    }
    const letter = param.name.length === 1 && param.type === "float" && param.unit === null;
    return (letter ? letters[param.name] : undefined) ?? spoken[param.name] ?? words(param.name);
}

/* A place as people name it: "/nodes/ball/params/radius" -> "Ball · radius". */
export function placeTitle(document: SceneDocument | null, place: string): string {
    const node = document?.nodes.get(nodeOfPlace(place) ?? "");
    const record = RECORDS.find((one) => place.startsWith(`/${one}/`));
    const named = node ? nodeLabel(node) : resourceOfPlace(place)?.name;
    const owner = record ? t(`setup.${record}`) : named;
    if (owner === undefined) {
        return place;
    }
    const last = place.split("/").at(-1) ?? "";
    const ofAll = record === undefined && place.split("/").length === OWNER_PARTS;
    return ofAll ? owner : `${owner} · ${spoken[last] ?? words(last)}`;
}

const RECORDS = ["camera", "environment", "render"] as const;

/* "", "nodes", "ball" */
const OWNER_PARTS = 3;

/* Below a heading that says the first word already: "fog density" -> density. */
export function shortTitle(param: Param): string {
    const title = paramTitle(param);
    const start = `${words(param.group)} `;
    return title.startsWith(start) ? title.slice(start.length) : title;
}

const outputs: Record<string, string> = {
    normal: "Normals",
    id: "Node ids",
};

/* Of an output of the renderer. */
export function outputTitle(name: string): string {
    return outputs[name] ?? typeTitle(name);
}

/* With a capital: for headings and menus. */
export function typeTitle(type: string): string {
    return capitalised(words(type));
}

/* What draws: a device, or the processors where the engine uses none. */
export const drawnBy = ({ name, stage }: Pick<RendererInfo, "name" | "stage">): string =>
    stage === "engine" ? t("state.engine") : name;
