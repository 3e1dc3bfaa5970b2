/* SPDX-License-Identifier: MIT */
/* The first rays of a sample. */

#include "camera.glsl"
#include "group.glsl"

layout(location = ARGS_LOCATION) uniform SampleArgs args;
layout(rgba32f, binding = IMAGE_RAY_ORIGIN) writeonly uniform image2D out_ray_origin;
layout(rgba32f, binding = IMAGE_RAY_DIRECTION) writeonly uniform image2D out_ray_direction;

void main()
{
    ivec2 here = group_place();
    Ray ray = camera_sample(dispatch.origin + here, args.sample_index);
    imageStore(out_ray_origin, here, pack_ray_origin(ray));
    imageStore(out_ray_direction, here, pack_ray_direction(ray));
}
