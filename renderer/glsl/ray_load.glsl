/* SPDX-License-Identifier: MIT */
/* The ray that a sample is at. */

#include "ray.glsl"

layout(binding = UNIT_RAY_FROM) uniform sampler2D rays_from;  /* origin, way from the eye to it */
layout(binding = UNIT_RAY_ALONG) uniform sampler2D rays_along; /* as Waiting.along */

Ray ray_load(ivec2 here)
{
    return ray_of(texelFetch(rays_from, max(here, 0), 0), texelFetch(rays_along, max(here, 0), 0));
}
