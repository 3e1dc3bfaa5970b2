/* SPDX-License-Identifier: MIT */
/* What of a light comes to a place, if nothing is between. */

#include "frame.glsl"

struct Incoming {
    vec3 direction; /* towards the light */
    vec3 color;     /* 0 where the light does not reach */
    float reach;    /* distance to the light */
};

/* By the inverse square, but for the light's own radius, and gently to nothing at its range
 * (Karis: Real shading in Unreal Engine 4, SIGGRAPH 2013 course). */
float falloff(Light light, float r2)
{
    float fall = 1.0 / max(r2, light.radius * light.radius);
    float range = light.range;
    float x = range > 0.0 ? r2 / (range * range) : 0.0;
    float window = clamp(1.0 - x * x, 0.0, 1.0);
    return fall * window * window;
}

/* Part of a spot's light in a direction: all in the middle of its cone, none beyond the rim. */
float cone_part(Light light, vec3 direction)
{
    float x = dot(light.axis, direction) - light.rim_cosine;
    x = clamp(x / max(light.fade_cosine - light.rim_cosine, 1e-6), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

Incoming incoming(Light light, vec3 p)
{
    if (light.kind == LIGHT_DIRECTIONAL) {
        return Incoming(light.position, light.color, 1e9);
    }
    vec3 away = light.position - p;
    float r2 = max(dot(away, away), 1e-12), r = sqrt(r2);
    vec3 direction = away / r;
    float cone = light.kind == LIGHT_POINT  ? 1.0
                 : light.kind == LIGHT_SPOT ? cone_part(light, -direction)
                                            : 0.0;
    float part = falloff(light, r2) * cone;
    return Incoming(direction, light.color * part, r);
}
