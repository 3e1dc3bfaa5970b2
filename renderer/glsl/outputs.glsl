/* SPDX-License-Identifier: MIT */
/* What is told of a pixel besides its colour: of what the ray through its middle met. */

#include "surface.glsl"
#include "tone.glsl"

/* The first hit of a ray, and what came to it. */
struct Met {
    bool hit;
    vec3 normal;
    float distance; /* below 0: something opaque, from inside of something transmissive */
    vec3 place;
    float steps;
    Surface surface;
    vec3 lights; /* part of the light that arrives, of all lights together that cast shadows */
    float ambient_visibility; /* part of the environment's */
};

/* Neighbouring ids get hues far apart: steps of the golden ratio. */
vec3 id_color(uint id)
{
    float hue = fract(float(id) * 0.61803399);
    float value = 0.65 + 0.35 * fract(float(id) * 0.38196601 + 0.5);
    vec3 c = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return id == 0u ? vec3(0.0) : value * mix(vec3(1.0), c, 0.75);
}

/* STEPS_WHITE and the colours are those of protocol/picture.h. */
vec3 steps_color(float steps)
{
    float place = clamp(steps / float(STEPS_WHITE), 0.0, 1.0) * float(STEPS_COLORS - 1);
    int i = min(int(place), STEPS_COLORS - 2);
    return mix(steps_color_at(i), steps_color_at(i + 1), place - float(i));
}

/* Reflectivity, index of refraction, opacity, roughness. */
vec4 optical_of(Surface s)
{
    float rough = s.model == MODEL_STANDARD ? s.gloss : sqrt(2.0 / (s.gloss + 2.0));
    return vec4(s.reflectivity, s.ior, 1.0 - s.transmission, rough);
}

/* `kind`: OUT_..., but color and id's number. */
vec4 output_of(int kind, Met m)
{
    Surface s = m.surface;
    vec4 o = vec4(0.0);
    if (kind == OUT_DEPTH) {
        return vec4(m.distance);
    } else if (kind == OUT_NORMAL) {
        return vec4(m.hit ? m.normal * 0.5 + 0.5 : vec3(0.0), 1.0);
    } else if (kind == OUT_NORMAL_RAW) {
        return m.hit ? vec4(m.normal, 1.0) : o;
    } else if (kind == OUT_POSITION) {
        return m.hit ? vec4(m.place, 1.0) : o;
    } else if (kind == OUT_ID) {
        return vec4(id_color(s.id), 1.0);
    } else if (kind == OUT_STEPS) {
        return vec4(steps_color(m.steps), 1.0);
    } else if (kind == OUT_STEPS_RAW) {
        return vec4(m.steps);
    } else if (kind == OUT_ALBEDO) {
        return vec4(srgb(m.hit ? s.diffuse : vec3(0.0)), 1.0);
    } else if (kind == OUT_ALBEDO_RAW) {
        return m.hit ? vec4(s.diffuse, 1.0) : o;
    } else if (kind == OUT_SPECULAR) {
        return vec4(srgb(m.hit ? s.specular : vec3(0.0)), 1.0);
    } else if (kind == OUT_SPECULAR_RAW) {
        return m.hit ? vec4(s.specular, 1.0) : o;
    } else if (kind == OUT_OPTICAL) {
        o = optical_of(s);
        return vec4(m.hit ? vec3(o.x, (o.y - 1.0) / 3.0, o.z) : vec3(0.0), 1.0);
    } else if (kind == OUT_OPTICAL_RAW) {
        return m.hit ? optical_of(s) : o;
    } else if (kind == OUT_SHADOW || kind == OUT_SHADOW_RAW) {
        return vec4(m.hit ? m.lights : vec3(1.0), 1.0);
    } else if (kind == OUT_OCCLUSION) {
        return vec4(vec3(m.hit ? m.ambient_visibility : 1.0), 1.0);
    } else if (kind == OUT_OCCLUSION_RAW) {
        return vec4(m.hit ? m.ambient_visibility : 1.0);
    }
    return o;
}
