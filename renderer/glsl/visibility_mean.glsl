/* SPDX-License-Identifier: MIT */
#include "frame.glsl"

vec3 visibility_of(ivec2 here, int light);

/* Part of the light that arrives, of all lights together that cast shadows. */
vec3 visibility_mean(ivec2 here)
{
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = zero; i < frame.light_count; i++) {
        bool counts_in = frame.lights[i].shadow != SHADOW_NONE;
        sum += counts_in ? visibility_of(here, i) : vec3(0.0);
        count += counts_in ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : vec3(1.0);
}
