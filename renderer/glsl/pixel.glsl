/* SPDX-License-Identifier: MIT */
/* What the samples of a pixel make together. */

#include "edges.glsl"
#include "screen.glsl"

layout(binding = UNIT_COUNTED) uniform sampler2D counted;

vec4 average(ivec2 here)
{
    return texelFetch(pixels, here, 0) / max(texelFetch(counted, here, 0).x, 1.0);
}

/* Edges are mixed with what is around them, the more the stronger they are (Sabino, Andrade, Clua,
 * Montenegro, Pagliosa: A hybrid GPU rasterized and ray traced rendering pipeline for real time
 * rendering of per pixel effects, 2012). */
vec4 blended(ivec2 here)
{
    vec4 c = average(here);
    float edge = clamp(edge_at(here), 0.0, 1.0);
    vec4 sum = 2.0 * c;
    float weights = 2.0;
    for (int i = zero; i < 4; i++) {
        ivec2 aside = (i < 2 ? ivec2(1, 0) : ivec2(0, 1)) * (1 - 2 * (i & 1));
        sum += average(here + aside);
        weights += 1.0;
    }
    return mix(c, sum / weights, edge);
}

/* Light and coverage of a pixel; `blend`: at edges with its neighbours'. */
vec4 pixel_light(ivec2 here, bool blend)
{
    vec4 c = blend ? blended(here) : average(here);
    return vec4(c.rgb, (frame.effects & EFFECT_TRANSPARENT) != 0 ? c.a : 1.0);
}
