/* SPDX-License-Identifier: MIT */
/* Which pixels get more samples: edges, or those that had so many samples. */

#include "pixel.glsl"

layout(location = ARGS_LOCATION) uniform ListingArgs args;
layout(location = 0) out float out_mask;

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = ivec2(args.width, args.height) - 1; /* the tile has a margin of one pixel */
    bool inside = all(greaterThan(here, ivec2(0))) && all(lessThan(here, last));
    bool more = args.samples > 0 ? texelFetch(counted, here, 0).x >= float(args.samples)
                                 : is_edge(clamp(here, ivec2(1), last - 1));
    out_mask = inside && more ? 1.0 : 0.0;
}
