/* SPDX-License-Identifier: MIT */
/* What the march and material passes leave for the others, 56 bytes for each sample:
 *
 *   geometry  rgba32f   normal, distance along the ray (INFINITY: nothing hit; below 0: from inside
 *                       of something transmissive, something opaque)
 *   material0 rgba32ui  x  diffuse.r, diffuse.g       two halves
 *                       y  diffuse.b, gloss           two halves
 *                       z  specular, model            10 bits each, 2 bits
 *                       w  ior, transmission, reflectivity   a half, 8 bits each
 *   material1 rgba32ui  x  emission                   shared exponent
 *                       y  ambient, 1 where painted   10 bits each, 2 bits
 *                       z  absorption                 shared exponent
 *                       w  id
 *   steps     rg32f     steps of the march, STEPS_BITS, and above them the hit's source, as a whole
 *                       number; curvature
 *
 * Parts of n bits are from 0 to 1 in 2^n - 1 steps. A shared exponent (OpenGL 4.3, 8.25) leaves
 * nine bits to each channel: the error is at most 1/500 of the greatest one. */

#include "constants.glsl"
#include "surface.glsl"

#define SHARED_MAX 65408.0
#define STEPS_BITS 16

/* A float holds whole numbers of 24 bits. */
float steps_pack(int steps, int source)
{
    return float(source << STEPS_BITS | steps);
}

int steps_count(float word)
{
    return int(word) & (1 << STEPS_BITS) - 1;
}

int steps_source(float word)
{
    return int(word) >> STEPS_BITS;
}

/* Nine bits of each channel, then five of an exponent, such that none of the former rounds up to
 * ten bits: hence the little more than the greatest channel that the exponent is taken of. */
uint shared_pack(vec3 color)
{
    vec3 c = clamp(color, 0.0, SHARED_MAX);
    float largest = 1.001 * max(c.r, max(c.g, c.b));
    int exponent = clamp((floatBitsToInt(largest) >> 23) - 127, -16, 15);
    uvec3 parts = uvec3(c * exp2(float(8 - exponent)) + 0.5);
    return parts.r | parts.g << 9 | parts.b << 18 | uint(exponent + 16) << 27;
}

vec3 shared_unpack(uint word)
{
    uvec3 parts = uvec3(word, word >> 9, word >> 18) & 511u;
    return vec3(parts) * exp2(float(word >> 27) - 24.0);
}

/* Three parts of 10 bits, and a number from 0 to 3. */
uint parts_pack(vec3 parts, int number)
{
    uvec3 p = uvec3(clamp(parts, 0.0, 1.0) * 1023.0 + 0.5);
    return p.r | p.g << 10 | p.b << 20 | uint(number) << 30;
}

vec3 parts_unpack(uint word)
{
    return vec3(uvec3(word, word >> 10, word >> 20) & 1023u) / 1023.0;
}

void surface_pack(Surface s, out uvec4 material0, out uvec4 material1)
{
    vec3 diffuse = min(s.diffuse, HALF_MAX);
    uint parts = packUnorm4x8(vec4(0.0, 0.0, s.transmission, s.reflectivity));
    uint ior = packHalf2x16(vec2(s.ior, 0.0));
    material0 = uvec4(packHalf2x16(diffuse.rg), packHalf2x16(vec2(diffuse.b, s.gloss)),
                      parts_pack(s.specular, s.model), ior | parts);
    material1 = uvec4(shared_pack(s.emission), parts_pack(s.ambient, s.opaque_cut ? 1 : 0),
                      shared_pack(s.absorption), s.id);
}

Surface surface_unpack(uvec4 material0, uvec4 material1)
{
    vec2 y = unpackHalf2x16(material0.y);
    vec4 parts = unpackUnorm4x8(material0.w);
    Surface s;
    s.diffuse = vec3(unpackHalf2x16(material0.x), y.x);
    s.gloss = y.y;
    s.specular = parts_unpack(material0.z);
    s.model = int(material0.z >> 30);
    s.ior = unpackHalf2x16(material0.w).x;
    s.transmission = parts.z;
    s.reflectivity = parts.w;
    s.emission = shared_unpack(material1.x);
    s.ambient = parts_unpack(material1.y);
    s.opaque_cut = material1.y >> 30 == 1u;
    s.absorption = shared_unpack(material1.z);
    s.id = material1.w;
    return s;
}
