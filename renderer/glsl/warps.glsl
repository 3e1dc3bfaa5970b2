/* SPDX-License-Identifier: MIT */
/* Modifiers that bend space or add to the distance; in C they are in renderer/sdf/warps.c. */

#include "noise.glsl"
#include "shapes.glsl"

/* Turns the section at each height back, inside the children's cylinder (rate, radius, ...). */
vec3 dom_twist(vec3 p, vec4 twist)
{
    vec2 q = p.xz * min(twist.y / max(length(p.xz), 1e-30), 1.0);
    float c = cos(twist.x * p.y), s = sin(twist.x * p.y);
    return vec3(c * q.x - s * q.y, p.y, s * q.x + c * q.y);
}

/* Makes the children's distance a bound outside them: (rate, radius, 1 / Lipschitz, scale). */
float dom_twist_after(float d, vec3 p, vec4 twist)
{
    return corner(d * twist.z, (length(p.xz) - twist.y) * twist.w);
}

/* Turns the section at each place along X back, inside the children's cylinder (rate, radius, ...).
 */
vec3 dom_bend(vec3 p, vec4 bend)
{
    vec2 q = p.xy * min(bend.y / max(length(p.xy), 1e-30), 1.0);
    float c = cos(bend.x * q.x), s = sin(bend.x * q.x);
    return vec3(c * q.x + s * q.y, c * q.y - s * q.x, p.z);
}

/* Makes the children's distance a bound outside them: (rate, radius, 1 / Lipschitz, scale). */
float dom_bend_after(float d, vec3 p, vec4 bend)
{
    return corner(d * bend.z, (length(p.xy) - bend.y) * bend.w);
}

/* Shifts the point in waves: (amplitude, 1 / Lipschitz), (frequency). */
vec3 dom_offset_space(vec3 p, vec4 offset, vec4 frequency)
{
    return p + offset.xyz * sin(frequency.xyz * p.yzx);
}

/* Makes the children's distance a bound. */
float dom_offset_space_after(float d, vec3 p, vec4 offset, vec4 frequency)
{
    return d * offset.w;
}

/* Waves on the surface: (frequency, amplitude times scale), (1 / Lipschitz). */
float dom_displace_after(float d, vec3 p, vec4 waves, vec4 more)
{
    vec3 s = sin(waves.xyz * p);
    return max((d + waves.w * s.x * s.y * s.z) * more.x, d - waves.w);
}

/* Noise on the surface: (frequency, height of the first octave times scale, octaves, seed),
 * (1 / Lipschitz, amplitude times scale, where noise is of no account). */
float dom_displace_noise_after(float d, vec3 p, vec4 noise, vec4 more)
{
    int octaves = d < more.z ? int(noise.z) : 0;
    float g = noise.y * noise_octaves(noise.x * p, octaves, uint(noise.w));
    return max((d + g) * more.x, d - more.y);
}
