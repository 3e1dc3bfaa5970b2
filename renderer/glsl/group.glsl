/* SPDX-License-Identifier: MIT */
/* Which sample of the tile an invocation of a compute shader is for. */

layout(local_size_x = 64) in;

/* A group covers 8 x 8 samples. Neighbours in the list are neighbours in the picture, 4 x 2 for
 * eight lanes and 8 x 4 for thirty-two, because lanes wait for the slowest of them. */
ivec2 group_place()
{
    int i = int(gl_LocalInvocationIndex);
    ivec2 inside = ivec2((i & 3) | ((i & 8) >> 1), ((i & 4) >> 2) | ((i & 48) >> 3));
    return ivec2(gl_WorkGroupID.xy) * 8 + inside;
}
