/* SPDX-License-Identifier: MIT */
/* Adds a finished sample to its pixel.
 *
 * Every sample is tone mapped before the average is taken: a bright highlight then has edges as
 * smooth as any other. The average is one of light, so it is taken before the sRGB curve. */

#include "group.glsl"
#include "tone.glsl"

layout(location = ARGS_LOCATION) uniform GatherArgs args;
layout(binding = UNIT_TOTAL) uniform sampler2D totals;
layout(rgba32f, binding = IMAGE_PIXELS) uniform image2D pixels; /* sums; w: coverage */
layout(r32f, binding = IMAGE_COUNTED) writeonly uniform image2D counted;

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    vec4 total = texelFetch(totals, here, 0);
    vec3 color = args.linear == 1 ? total.rgb : tone_map(total.rgb * frame.exposure);
    vec4 before = args.sample_index == 0 ? vec4(0.0) : imageLoad(pixels, here);
    imageStore(pixels, here, before + vec4(color, total.w));
    imageStore(counted, here, vec4(float(args.sample_index + 1)));
}
