/* SPDX-License-Identifier: MIT */
/* The ray that a sample is at. */

layout(binding = 5) uniform sampler2D ray_from;  /* origin, way from the eye to it */
layout(binding = 6) uniform sampler2D ray_along; /* direction, 1 where it is inside */

Ray ray_load(ivec2 here)
{
    vec4 from = texelFetch(ray_from, max(here, 0), 0);
    vec4 along = texelFetch(ray_along, max(here, 0), 0);
    return Ray(from.xyz, along.xyz, from.w, along.w > 0.5);
}
