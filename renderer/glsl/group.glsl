/* SPDX-License-Identifier: MIT */
/* Which sample of the tile an invocation of a compute shader is for. */

#include "frame.glsl"

layout(local_size_x = GROUP_SIZE) in;
#define GROUP

/* Samples one by one: groups of 64 of them (the arguments of an indirect dispatch), how many, and
 * their places in the tile, x in the low half of a word. */
layout(std430, binding = BINDING_LIST) readonly buffer List {
    uint list_groups[3];
    uint list_count;
    uint list_places[];
};

/* A group covers 8 x 8 samples, or 64 of the list. Neighbours in the group are neighbours in the
 * picture, 4 x 2 for eight lanes and 8 x 4 for thirty-two, because lanes wait for the slowest of
 * them. (-1, -1): nothing to do. */
ivec2 group_place()
{
    int i = int(gl_LocalInvocationIndex);
    ivec2 inside = ivec2((i & 3) | ((i & 8) >> 1), ((i & 4) >> 2) | ((i & 48) >> 3));
    ivec2 here = ivec2(gl_WorkGroupID.xy) * GROUP_SIDE + inside;
    if (dispatch.mode == PASS_LIST) {
        uint at = gl_WorkGroupID.x * uint(GROUP_SIZE) + gl_LocalInvocationIndex;
        bool some = at < list_count;
        uint place = list_places[some ? at : 0u];
        here = some ? ivec2(place & 0xffffu, place >> 16) : ivec2(-1);
    }
    return here;
}
