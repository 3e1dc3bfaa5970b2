/* SPDX-License-Identifier: MIT */
/* Second pass: what the surface that the march found is made of. */

#include "field_pass.glsl"
#include "gbuffer_load.glsl"
#include "surface_of.glsl"

layout(rgba32ui, binding = IMAGE_MATERIAL0) writeonly uniform uimage2D out_material0;
layout(rgba32ui, binding = IMAGE_MATERIAL1) writeonly uniform uimage2D out_material1;

void main()
{
    preload();
    ivec2 here = group_place();
    vec4 g = texelFetch(geometry, here, 0);
    Ray ray = ray_load(here);
    float t = abs(g.w);
    bool hit = t < INFINITY;
    vec3 p = ray.origin + ray.direction * (hit ? t : 0.0);
    /* Where two surfaces lie near each other, the one that was met. */
    field_mask = g.w < 0.0 ? FAR : ray.inside ? -FAR : 0.0;
    Surface s = surface_nothing();
    uvec4 material0, material1;
    surface_of(steps_source(steps_load(here).x), p,
               Shading(p, vec3(0.0), g.xyz, ray.direction, t), s);
    s.id = hit ? s.id : 0u;
    surface_pack(s, material0, material1);
    imageStore(out_material0, here, material0);
    imageStore(out_material1, here, material1);
}
