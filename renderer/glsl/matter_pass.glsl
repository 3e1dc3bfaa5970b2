/* SPDX-License-Identifier: MIT */
/* Second pass: what the surface that the march found is made of. */

#include "field_pass.glsl"
#include "field_surface.glsl"
#include "gbuffer_load.glsl"

layout(rgba32ui, binding = IMAGE_MATTER) writeonly uniform uimage2D out_matter;
layout(rgba32ui, binding = IMAGE_MORE) writeonly uniform uimage2D out_more;

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
    through = g.w < 0.0 ? FAR : ray.inside ? -FAR : 0.0;
    Surface s;
    uvec4 matter, more;
    surface(p, Shading(p, vec3(0.0), g.xyz, ray.direction, t), s);
    s.id = hit ? s.id : 0u;
    surface_pack(s, matter, more);
    imageStore(out_matter, here, matter);
    imageStore(out_more, here, more);
}
