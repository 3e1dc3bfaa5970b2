/* SPDX-License-Identifier: MIT */
/* The march of each sample's ray. It runs twice for the first rays: coarsely at first, with a cone
 * for BLOCK_SIDE x BLOCK_SIDE pixels, which tells how far all their rays are free. */

#include "camera.glsl"
#include "field_pass.glsl"
#include "gbuffer.glsl"
#include "march.glsl"

layout(rgba32f, binding = IMAGE_GEOMETRY) writeonly uniform image2D out_geometry;
layout(rg32f, binding = IMAGE_STEPS) writeonly uniform image2D out_steps;
layout(r32f, binding = IMAGE_STARTS) uniform image2D starts; /* one value for each block */

void main()
{
    preload();
    ivec2 here = group_place();
    bool coarse = dispatch.mode == PASS_COARSE;
    bool first = args.first == 1 && camera.lens_radius == 0.0;
    ivec2 block = ((dispatch.origin + here) >> BLOCK_BITS) - (dispatch.origin >> BLOCK_BITS);
    Ray ray = ray_load(here);
    float start = first && !coarse ? imageLoad(starts, block).x : 0.0;
    if (coarse) {
        ray = block_ray((dispatch.origin >> BLOCK_BITS) + here);
    }
    Hit found = march(ray, start, coarse ? BLOCK_CONE : 0.0, here.x < 0 ? 0 : frame.max_steps);

    if (coarse) {
        imageStore(starts, here, vec4(found.free));
    } else {
        float t = found.opaque ? -max(found.t, 1e-30) : found.t;
        imageStore(out_geometry, here, vec4(found.hit ? found.normal : vec3(0.0), t));
        float word = steps_pack(found.steps, found.source);
        imageStore(out_steps, here, vec4(word, found.curvature, 0.0, 0.0));
    }
}
