/* SPDX-License-Identifier: MIT */
/* Where the rays of BLOCK_SIDE x BLOCK_SIDE pixels begin. */

#include "camera.glsl"
#include "march.glsl"

/* How far all rays of a block of pixels are free. */
float block_start(ivec2 block)
{
    return march(block_ray(block), 0.0, BLOCK_CONE, frame.max_steps).free;
}
