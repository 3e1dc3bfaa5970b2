/* SPDX-License-Identifier: MIT */
/* What the samples of a pixel make together. */

#include "edge_detect.glsl"
#include "screen.glsl"

/* Edges are mixed with what is around them, the more the stronger they are (Sabino, Andrade, Clua,
 * Montenegro, Pagliosa: A hybrid GPU rasterized and ray traced rendering pipeline for real time
 * rendering of per pixel effects, 2012). */
vec4 blended(ivec2 here)
{
    float part = clamp(edge_at(here), 0.0, 1.0) / 6.0;
    vec4 light = (1.0 - 4.0 * part) * texelFetch(pixels, here, 0);
    vec2 counts = (1.0 - 4.0 * part) * texelFetch(counted, here, 0).xy;
    for (int i = zero; i < 4; i++) {
        ivec2 aside = here + (i < 2 ? ivec2(1, 0) : ivec2(0, 1)) * (1 - 2 * (i & 1));
        light += part * texelFetch(pixels, aside, 0);
        counts += part * texelFetch(counted, aside, 0).xy;
    }
    return sums_mean(light, counts);
}

/* Linear light and coverage of a pixel; `blend`: at edges with its neighbours'. */
vec4 pixel_light(ivec2 here, bool blend)
{
    return blend ? blended(here) : mean_at(here);
}
