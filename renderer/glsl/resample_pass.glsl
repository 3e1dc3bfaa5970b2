/* SPDX-License-Identifier: MIT */
/* Lists the pixels that had all samples so far, those that get more. */

#include "group.glsl"
#include "list.glsl"

layout(location = ARGS_LOCATION) uniform ListingArgs args;
layout(binding = UNIT_COUNTED) uniform sampler2D counted;

void main()
{
    ivec2 here = group_place();
    ivec2 last = ivec2(args.width, args.height) - 1; /* the tile has a margin of one pixel */
    bool inside = all(greaterThan(here, ivec2(0))) && all(lessThan(here, last));
    if (inside && texelFetch(counted, here, 0).x >= float(args.samples)) {
        list_add(here);
    }
}
