/* SPDX-License-Identifier: MIT */
/* The list that the next passes are for; laid out as the one of group.glsl. */

#include "interface.glsl"

layout(std430, binding = BINDING_NEXT) buffer Next {
    uint next_groups[3];
    uint next_count;
    uint next_places[];
};

void list_add(ivec2 here)
{
    uint at = atomicAdd(next_count, 1u);
    next_places[at] = uint(here.x) | uint(here.y) << 16;
    atomicMax(next_groups[0], at / uint(GROUP_SIZE) + 1u);
}
