/* SPDX-License-Identifier: MIT */
/* The first rays of a sample. */

#include "camera.glsl"
#include "group.glsl"

layout(location = ARGS_LOCATION) uniform SampleArgs args;
layout(rgba32f, binding = IMAGE_RAY_FROM) writeonly uniform image2D out_ray_from;
layout(rgba32f, binding = IMAGE_RAY_ALONG) writeonly uniform image2D out_ray_along;

void main()
{
    ivec2 here = group_place();
    Ray ray = camera_sample(dispatch.origin + here, args.sample_index);
    imageStore(out_ray_from, here, ray_from(ray));
    imageStore(out_ray_along, here, ray_along(ray));
}
