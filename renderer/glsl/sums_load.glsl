/* SPDX-License-Identifier: MIT */
/* Sums of the samples of each pixel: sums.glsl. */

#include "sums.glsl"

layout(binding = UNIT_PIXELS) uniform sampler2D pixels;
layout(binding = UNIT_COUNTED) uniform sampler2D counted;

vec4 mean_at(ivec2 here)
{
    return sums_mean(texelFetch(pixels, here, 0), texelFetch(counted, here, 0).xy);
}
