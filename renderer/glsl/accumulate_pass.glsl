/* SPDX-License-Identifier: MIT */
/* Adds a finished sample to its pixel. */

#include "group.glsl"
#include "sums.glsl"

layout(location = ARGS_LOCATION) uniform AccumulateArgs args;
layout(binding = UNIT_TOTAL) uniform sampler2D totals;
layout(rgba32f, binding = IMAGE_PIXELS) uniform image2D pixels; /* light; w: coverage */
layout(rg32f, binding = IMAGE_COUNTED) uniform image2D counted; /* samples, weight */

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    vec4 light;
    vec2 counts;
    sample_sums(texelFetch(totals, here, 0), light, counts);
    if (args.sample_index > 0) {
        light += imageLoad(pixels, here);
        counts += imageLoad(counted, here).xy;
    }
    imageStore(pixels, here, light);
    imageStore(counted, here, vec4(counts, 0.0, 0.0));
}
