/* SPDX-License-Identifier: MIT */
/* Lists the pixels that had all samples so far, turn.z of them: those that get more. turn.xy: the
 * tile's size. */

layout(binding = 14) uniform sampler2D counted;

void main()
{
    ivec2 here = group_place();
    ivec2 last = ivec2(turn.x, turn.y) - 1; /* the tile has a margin of one pixel */
    bool inside = all(greaterThan(here, ivec2(0))) && all(lessThan(here, last));
    if (inside && texelFetch(counted, here, 0).x >= float(turn.z)) {
        list_add(here);
    }
}
