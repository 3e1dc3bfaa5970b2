/* SPDX-License-Identifier: MIT */
/* Lists the pixels that are worth more samples: edges, and both sides of them. */

#include "edge_detect.glsl"
#include "group.glsl"
#include "list.glsl"

layout(location = ARGS_LOCATION) uniform ListingArgs args;

void main()
{
    ivec2 here = group_place();
    ivec2 last = ivec2(args.width, args.height) - 1; /* the tile has a margin of one pixel */
    bool inside = all(greaterThan(here, ivec2(0))) && all(lessThan(here, last));
    here = clamp(here, ivec2(1), last - 1);
    if (inside && is_edge(here)) {
        list_add(here);
    }
}
