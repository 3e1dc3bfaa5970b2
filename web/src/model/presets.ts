/* SPDX-License-Identifier: MIT */
/* THE TABLE of materials to begin with. Colours are linear; those of metals are the mirror images of
 * measured ones (after physicallybased.info). */
import type { JsonObject } from "./json.ts";

export interface Preset {
    readonly name: string;
    readonly group: PresetGroup;
    readonly shader: string;
    readonly properties: JsonObject;
    /* The shader, where it is none of the built-in ones. */
    readonly code?: JsonObject;
}

export const PRESET_GROUPS = ["earth", "soft", "metal", "clear", "light", "pattern"] as const;
export type PresetGroup = (typeof PRESET_GROUPS)[number];

type Rows = Readonly<Record<string, JsonObject>>;

const standard = (group: PresetGroup, rows: Rows): Preset[] =>
    Object.entries(rows).map(([name, properties]) => ({
        name,
        group,
        shader: "standard",
        properties,
    }));

const metal = (base_color: number[], roughness: number): JsonObject => ({
    base_color,
    metallic: 1,
    roughness,
});

/* Clear, and coloured by what light goes through: the colour after `distance`. */
const clear = (ior: number, attenuation_color: number[], distance = 1): JsonObject => ({
    base_color: [1, 1, 1],
    roughness: 0,
    transmission: 1,
    ior,
    attenuation_color,
    attenuation_distance: distance,
});

const glow = (emission: number[]): JsonObject => ({ base_color: [0, 0, 0], emission });

/* --- patterns, by code --- */

const color = (name: string, value: number[]): JsonObject => ({
    name,
    type: "color",
    default: value,
});
const SCALE: JsonObject = {
    name: "scale",
    type: "float",
    default: 1,
    range: [0.01, 100],
    doc: "Size of the pattern.",
};

interface Pattern {
    readonly doc: string;
    readonly light: number[];
    readonly dark: number[];
    /* From `p`, the place over `scale`: the share of `dark`, and the roughness. */
    readonly share: string;
    readonly roughness: string;
}

const shaderOf = ({ doc, light, dark, share, roughness }: Pattern): JsonObject => ({
    properties: [color("light", light), color("dark", dark), SCALE],
    code: `Surface shade(FragmentProperties properties)
{
    vec3 p = properties.object_position / scale;
${share}
    Surface s = Surface(mix(light, dark, clamp(share, 0.0, 1.0)));
    s.roughness = ${roughness};
    return s;
}
`,
    doc,
});

const PATTERNS: Readonly<Record<string, Pattern>> = {
    walnut: {
        doc: "Wood with rings around its Y axis.",
        light: [0.3, 0.13, 0.055],
        dark: [0.09, 0.034, 0.014],
        share: `    vec3 q = p + 0.06 * fbm(vec3(2.0, 0.7, 2.0) * p, 3);
    float ring = fract(7.0 * length(q.xz + vec2(0.35, 0.2)));
    float fibre = fbm(vec3(60.0, 3.0, 60.0) * p, 2);
    float share = smoothstep(0.1, 0.9, ring) * (1.0 - smoothstep(0.93, 1.0, ring)) + 0.18 * fibre;`,
        roughness: "0.35 + 0.1 * fibre",
    },
    pine: {
        doc: "Light wood with rings around its Y axis.",
        light: [0.62, 0.4, 0.19],
        dark: [0.4, 0.2, 0.075],
        share: `    vec3 q = p + 0.08 * fbm(vec3(1.5, 0.5, 1.5) * p, 3);
    float ring = fract(5.0 * length(q.xz + vec2(0.6, 0.1)));
    float share = pow(ring, 2.0) * (1.0 - smoothstep(0.94, 1.0, ring))
                + 0.12 * fbm(vec3(50.0, 2.5, 50.0) * p, 2);`,
        roughness: "0.5",
    },
    marble: {
        doc: "Polished stone with veins.",
        light: [0.82, 0.8, 0.76],
        dark: [0.16, 0.17, 0.2],
        share: `    float turn = fbm(1.6 * p, 6);
    float vein = abs(sin(3.2 * (p.x + 0.6 * p.y + 1.3 * turn)));
    float share = 0.75 * pow(1.0 - vein, 6.0) + 0.12 * smoothstep(0.0, 1.5, fbm(5.0 * p, 4));`,
        roughness: "0.12",
    },
    granite: {
        doc: "Polished stone with grains.",
        light: [0.6, 0.5, 0.46],
        dark: [0.03, 0.03, 0.035],
        share: `    float coarse = fbm(14.0 * p, 3);
    float fine = fbm(45.0 * p, 2);
    float share = smoothstep(0.05, 0.5, coarse) * 0.75 + smoothstep(0.3, 0.9, fine) * 0.6;`,
        roughness: "0.25",
    },
    sandstone: {
        doc: "Layers of sand across the Y axis.",
        light: [0.68, 0.5, 0.31],
        dark: [0.42, 0.23, 0.12],
        share: `    float layer = p.y * 6.0 + 0.5 * fbm(1.5 * p, 4);
    float share = 0.5 + 0.35 * sin(layer) + 0.2 * sin(3.7 * layer) + 0.15 * fbm(40.0 * p, 2);`,
        roughness: "0.95",
    },
    rust: {
        doc: "Iron that rusts in patches.",
        light: [0.33, 0.31, 0.3],
        dark: [0.27, 0.085, 0.025],
        share: `    float patches = fbm(3.0 * p, 6);
    float share = smoothstep(-0.1, 0.35, patches) * (0.75 + 0.25 * fbm(20.0 * p, 3));`,
        roughness: "mix(0.35, 0.95, clamp(share, 0.0, 1.0))",
    },
};

const pattern = ([name, row]: [string, Pattern]): Preset => ({
    name,
    group: "pattern",
    shader: name,
    properties: {},
    code: shaderOf(row),
});

export const PRESETS: readonly Preset[] = [
    ...standard("earth", {
        clay: { base_color: [0.6, 0.24, 0.13], roughness: 0.9 },
        terracotta: { base_color: [0.42, 0.13, 0.06], roughness: 0.75 },
        plaster: { base_color: [0.78, 0.76, 0.72], roughness: 1 },
        ceramic: { base_color: [0.85, 0.85, 0.8], roughness: 0.12 },
        celadon: { base_color: [0.32, 0.5, 0.4], roughness: 0.1 },
        cobalt: { base_color: [0.02, 0.05, 0.3], roughness: 0.08 },
    }),
    ...standard("soft", {
        plastic: { base_color: [0.75, 0.06, 0.05], roughness: 0.3 },
        rubber: { base_color: [0.03, 0.03, 0.035], roughness: 0.75 },
        wax: { base_color: [0.82, 0.66, 0.4], roughness: 0.45 },
        skin: { base_color: [0.62, 0.32, 0.23], roughness: 0.5 },
        felt: { base_color: [0.1, 0.22, 0.12], roughness: 1 },
    }),
    ...standard("metal", {
        gold: metal([1, 0.77, 0.34], 0.2),
        brass: metal([0.89, 0.74, 0.38], 0.3),
        copper: metal([0.95, 0.64, 0.54], 0.25),
        aluminium: metal([0.91, 0.92, 0.92], 0.4),
        iron: metal([0.53, 0.51, 0.49], 0.5),
        chrome: metal([0.65, 0.69, 0.7], 0.05),
    }),
    ...standard("clear", {
        glass: clear(1.5, [1, 1, 1]),
        water: clear(1.33, [0.55, 0.85, 0.9]),
        emerald: clear(1.58, [0.03, 0.55, 0.2]),
        amber: clear(1.54, [0.95, 0.42, 0.03], 0.6),
        diamond: clear(2.4, [1, 1, 1]),
    }),
    ...standard("light", {
        glow: glow([2.4, 1.2, 0.4]),
        "neon-pink": glow([2.6, 0.12, 0.7]),
        "neon-blue": glow([0.08, 0.55, 2.6]),
    }),
    ...Object.entries(PATTERNS).map(pattern),
];

/* A ball of it in neutral light, to be drawn with what is behind left out. */
export function ballScene({ shader, properties, code }: Preset): JsonObject {
    const light = (id: string, direction: number[], intensity: number): JsonObject => ({
        id,
        type: "directional",
        direction,
        intensity,
        shadow: "none",
    });
    return {
        format: "fieldcast/1",
        camera: { position: [0, 0.9, 4.6], target: [0, 0, 0], fov: 26 },
        lights: [light("key", [-0.6, -0.8, -0.7], 2), light("rim", [0.8, -0.3, 0.6], 1.2)],
        environment: {
            type: "sky",
            sun: false,
            zenith: [0.62, 0.62, 0.62],
            horizon: [0.95, 0.95, 0.95],
            ground: [0.1, 0.1, 0.1],
        },
        ...(code ? { shaders: { [shader]: code } } : {}),
        materials: { it: { shader, properties } },
        root: { id: "ball", type: "sphere", params: { radius: 1 }, material: "it" },
    };
}
