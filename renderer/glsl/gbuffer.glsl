/* SPDX-License-Identifier: MIT */
/* What march.glsl and matter.glsl leave for light.glsl, 48 bytes for each sample:
 *   geometry  rgba32f   normal, distance along the ray (INFINITY: nothing hit)
 *   matter    rgba32ui  eight halves: diffuse, shininess, specular, emission.r
 *   more      rgba32ui  five halves: emission.gb, ambient, unused; then the id */

#define HALF_MAX 65504.0

void surface_pack(Surface s, out uvec4 matter, out uvec4 more)
{
    vec3 glow = min(s.emission, HALF_MAX);
    matter = uvec4(packHalf2x16(s.diffuse.rg), packHalf2x16(vec2(s.diffuse.b, s.shininess)),
                   packHalf2x16(s.specular.rg), packHalf2x16(vec2(s.specular.b, glow.r)));
    more = uvec4(packHalf2x16(glow.gb), packHalf2x16(s.ambient.rg),
                 packHalf2x16(vec2(s.ambient.b, 0.0)), s.id);
}

Surface surface_unpack(uvec4 matter, uvec4 more)
{
    vec2 a = unpackHalf2x16(matter.y), b = unpackHalf2x16(matter.w);
    Surface s;
    s.diffuse = vec3(unpackHalf2x16(matter.x), a.x);
    s.shininess = a.y;
    s.specular = vec3(unpackHalf2x16(matter.z), b.x);
    s.emission = vec3(b.y, unpackHalf2x16(more.x));
    s.ambient = vec3(unpackHalf2x16(more.y), unpackHalf2x16(more.z).x);
    s.id = more.w;
    return s;
}
