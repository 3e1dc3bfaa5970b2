/* SPDX-License-Identifier: MIT */
/* Second pass: what the surface that march.glsl found is made of. */

layout(binding = 0) uniform sampler2D geometry;
layout(rgba32ui, binding = 1) writeonly uniform uimage2D out_matter;
layout(rgba32ui, binding = 2) writeonly uniform uimage2D out_more;

void main()
{
    preload();
    ivec2 here = group_place();
    vec4 g = texelFetch(geometry, here, 0);
    bool hit = g.w < INFINITY;
    Ray ray = camera_ray(tile.xy * size.z + here);
    vec3 p = ray.origin + ray.direction * (hit ? g.w : 0.0);
    Surface s;
    uvec4 matter, more;
    surface(p, Shading(p, vec3(0.0), g.xyz, ray.direction, g.w), s);
    s.id = hit ? s.id : 0u;
    surface_pack(s, matter, more);
    imageStore(out_matter, here, matter);
    imageStore(out_more, here, more);
}
