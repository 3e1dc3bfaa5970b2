/* SPDX-License-Identifier: MIT */
/* THE TABLE of materials to begin with. Colours are linear; those of metals are the mirror images of
 * measured ones (after physicallybased.info). */
import type { JsonObject } from "./json.ts";

export interface Preset {
    readonly name: string;
    readonly shader: string;
    readonly properties: JsonObject;
}

const standard = (name: string, properties: JsonObject): Preset => ({
    name,
    shader: "standard",
    properties,
});

export const PRESETS: readonly Preset[] = [
    standard("clay", { base_color: [0.6, 0.24, 0.13], roughness: 0.9 }),
    standard("plastic", { base_color: [0.75, 0.06, 0.05], roughness: 0.3 }),
    standard("ceramic", { base_color: [0.85, 0.85, 0.8], roughness: 0.12 }),
    standard("rubber", { base_color: [0.03, 0.03, 0.035], roughness: 0.75 }),
    standard("gold", { base_color: [1, 0.77, 0.34], metallic: 1, roughness: 0.2 }),
    standard("copper", { base_color: [0.95, 0.64, 0.54], metallic: 1, roughness: 0.25 }),
    standard("chrome", { base_color: [0.65, 0.69, 0.7], metallic: 1, roughness: 0.05 }),
    standard("glass", { base_color: [1, 1, 1], roughness: 0, transmission: 1, ior: 1.5 }),
    standard("water", {
        base_color: [1, 1, 1],
        roughness: 0,
        transmission: 1,
        ior: 1.33,
        attenuation_color: [0.55, 0.85, 0.9],
    }),
    standard("glow", { base_color: [0, 0, 0], emission: [4, 2.2, 0.8] }),
];
