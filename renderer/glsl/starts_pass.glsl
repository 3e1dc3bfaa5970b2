/* SPDX-License-Identifier: MIT */
/* A fragment for each block of the tile: where the rays of its pixels begin. */

#include "starts.glsl"

layout(location = 0) out float out_start;

void main()
{
    preload();
    out_start = block_start((dispatch.origin >> BLOCK_BITS) + ivec2(gl_FragCoord.xy));
}
