/* SPDX-License-Identifier: MIT */
/* What the first sample of a pixel met, as march, material and shadow pass left it. */

#include "camera.glsl"
#include "gbuffer_load.glsl"
#include "outputs.glsl"
#include "visibility_load.glsl"
#include "visibility_mean.glsl"

Met met_load(ivec2 here)
{
    vec4 g = texelFetch(geometry, here, 0);
    Ray ray = camera_sample(dispatch.origin + here, 0);
    vec3 place = ray.origin + ray.direction * g.w;
    return Met(g.w < INFINITY, g.xyz, g.w, place, float(steps_count(steps_load(here).x)),
               surface_load(here), visibility_mean(here), ambient_visibility_of(here));
}

uint met_id(ivec2 here)
{
    return surface_load(here).id;
}
