/* SPDX-License-Identifier: MIT */
/* What of lights and environment comes to the surfaces that the samples' rays met. */

#include "field_pass.glsl"
#include "gbuffer_load.glsl"
#include "shadow.glsl"
#include "shadow_sink.glsl"

void main()
{
    preload();
    store_here = group_place();
    bool idle = store_here.x < 0;
    vec4 g = texelFetch(geometry, max(store_here, 0), 0);
    Ray ray = ray_load(store_here);
    bool hit = !idle && abs(g.w) < INFINITY;
    float t = hit ? abs(g.w) : 0.0;
    trace_visibility(ray.origin + ray.direction * t, hit ? g.xyz : vec3(0.0, 1.0, 0.0),
                     pixel_footprint(ray, t), hit);
}
