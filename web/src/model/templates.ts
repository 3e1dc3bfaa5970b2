/* SPDX-License-Identifier: MIT */
/* What new distance functions and shaders start with: something that works, and what there is to
 * work with. */
import type { JsonObject } from "./json.ts";

const FUNCTION_CODE = `// The distance from p to the surface, negative inside.
// The parameters declared above are there under their names; so is all of GLSL.
float sdf(vec3 p) {
    vec3 q = abs(p) - vec3(radius);
    float box = length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
    return max(box, length(p) - 1.3 * radius);
}
`;

/* A distance function with one parameter. */
export const NEW_PRIMITIVE: JsonObject = {
    params: [{ name: "radius", type: "float", default: 0.5, range: [0, 10], doc: "Its size." }],
    code: FUNCTION_CODE,
};

/* The code of a node that names no distance function. */
export const NEW_NODE_CODE = `// The distance from p to the surface, negative inside.
float sdf(vec3 p) {
    float ball = length(p) - 0.5;
    return max(ball, -(length(p.xz) - 0.2));
}
`;

/* The equation of a new implicit surface. Its letter has the default 1. */
export const NEW_EQUATION = "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4a = 0";

/* A new parametric surface: a monkey saddle, whose letter has the default 1. */
export const NEW_SURFACE: JsonObject = {
    x: "s",
    y: "a/2*(s^3 - 3*s*t^2)",
    z: "t",
    s: [-1, 1],
    t: [-1, 1],
};

const SHADER_CODE = `// The colour of one point of the surface. It has
//   properties.world_position, .object_position, .world_normal,
//   .ray_direction and .ray_distance;
// the properties declared above are there under their names.
// To mirror or refract, return a Surface: Surface s = Surface(color);
// it has .color, .metallic, .roughness, .reflectivity, .transmission,
// .ior, .emission and .absorption.
vec3 shade(FragmentProperties properties) {
    float stripes = 0.5 + 0.5 * sin(20.0 * properties.object_position.y);
    return mix(color1, color2, stripes * amount);
}
`;

/* A shader with two colours and a share of the second. */
export const NEW_SHADER: JsonObject = {
    properties: [
        { name: "color1", type: "color", default: [0.9, 0.85, 0.75] },
        { name: "color2", type: "color", default: [0.35, 0.15, 0.1] },
        { name: "amount", type: "float", default: 1, range: [0, 1], doc: "Share of color2." },
    ],
    code: SHADER_CODE,
};
