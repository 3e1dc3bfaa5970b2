/* SPDX-License-Identifier: MIT */
/* The ray that a sample is at. */

#include "ray.glsl"

layout(binding = UNIT_RAY_ORIGIN) uniform sampler2D ray_origins; /* w: distance from the eye */
layout(binding = UNIT_RAY_DIRECTION) uniform sampler2D ray_directions; /* as in QueuedRay */

Ray ray_load(ivec2 here)
{
    return ray_of(texelFetch(ray_origins, max(here, 0), 0),
                  texelFetch(ray_directions, max(here, 0), 0));
}
