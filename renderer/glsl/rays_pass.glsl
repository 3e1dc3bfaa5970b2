/* SPDX-License-Identifier: MIT */
/* How many rays followed others in each column of a tile. */

#include "frame.glsl"

layout(location = ARGS_LOCATION) uniform ListingArgs args;
layout(binding = UNIT_COUNTED) uniform sampler2D counted;
layout(location = 0) out float out_rays;

void main()
{
    float sum = 0.0;
    for (int y = zero; y < args.height; y++) {
        sum += texelFetch(counted, ivec2(int(gl_FragCoord.x), y), 0).z;
    }
    out_rays = sum;
}
