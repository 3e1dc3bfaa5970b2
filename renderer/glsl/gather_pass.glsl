/* SPDX-License-Identifier: MIT */
/* Adds a finished sample to its pixel. turn.x: which sample; turn.y: 1 where light is asked for as
 * it is.
 *
 * Every sample is tone mapped before the average is taken: a bright highlight then has edges as
 * smooth as any other. The average is one of light, so it is taken before the sRGB curve. */

layout(binding = 4) uniform sampler2D totals;
layout(rgba32f, binding = 6) uniform image2D pixels; /* sums; w: coverage */
layout(r32f, binding = 7) writeonly uniform image2D counted;

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    vec4 total = texelFetch(totals, here, 0);
    vec3 color = turn.y == 1 ? total.rgb : tone_map(total.rgb * zenith.w);
    vec4 before = turn.x == 0 ? vec4(0.0) : imageLoad(pixels, here);
    imageStore(pixels, here, before + vec4(color, total.w));
    imageStore(counted, here, vec4(float(turn.x + 1)));
}
