/* SPDX-License-Identifier: MIT */
/* The march of each sample's ray. It runs twice for the first rays: coarsely at first, with a cone
 * for BLOCK x BLOCK pixels, which tells how far all their rays are free. turn.w: 1 for first
 * rays. */

layout(rgba32f, binding = 0) writeonly uniform image2D out_geometry;
layout(r32f, binding = 3) writeonly uniform image2D out_steps;
layout(r32f, binding = 4) uniform image2D starts; /* one value for each block */

#define BLOCK_BITS 3
#define BLOCK (1 << BLOCK_BITS)

/* Radius of a block's cone in footprints, which are half a pixel: from the block's middle to its
 * corners. */
#define CONE 11.5

void main()
{
    preload();
    ivec2 here = group_place();
    bool coarse = tile.w == PASS_COARSE, first = turn.w == 1 && right.w == 0.0;
    ivec2 block = ((tile.xy + here) >> BLOCK_BITS) - (tile.xy >> BLOCK_BITS);
    ivec2 centre = ((tile.xy >> BLOCK_BITS) + here) * BLOCK + BLOCK / 2;
    Ray ray = ray_load(here);
    float start = first && !coarse ? imageLoad(starts, block).x : coarse ? bounds_min.w : 0.0;
    if (coarse) {
        ray = camera_ray(vec2(centre));
    }
    Hit found = march(ray, start, coarse ? CONE : 0.0, here.x < 0 ? 0 : size.w);

    if (coarse) {
        imageStore(starts, here, vec4(found.free));
    } else {
        float t = found.solid ? -max(found.t, 1e-30) : found.t;
        imageStore(out_geometry, here, vec4(found.hit ? found.normal : vec3(0.0), t));
        imageStore(out_steps, here, vec4(float(found.steps)));
    }
}
