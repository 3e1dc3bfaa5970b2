/* SPDX-License-Identifier: MIT */
/* The first rays of a sample. turn.x: which sample of its pixel. */

layout(rgba32f, binding = 0) writeonly uniform image2D out_ray_from;
layout(rgba32f, binding = 1) writeonly uniform image2D out_ray_along;

void main()
{
    ivec2 here = group_place();
    Ray ray = camera_sample(tile.xy + here, turn.x);
    imageStore(out_ray_from, here, ray_from(ray));
    imageStore(out_ray_along, here, ray_along(ray));
}
