/* SPDX-License-Identifier: MIT */
/* Value noise; in C it is in renderer/sdf/noise.c, where the bounds of it are. */

/* The number from -1 to 1 at a whole point. */
float noise_lattice(uvec3 at, uint seed)
{
    uvec3 sum = at * uvec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);
    uint h = sum.x + sum.y + sum.z + seed * 0x27d4eb2fu;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    h ^= h >> 16;
    return float(h >> 8) * 1.1920929e-7 - 1.0;
}

/* Value noise of one octave. */
float noise_value(vec3 p, uint seed)
{
    vec3 whole = floor(p), t = p - whole;
    uvec3 a = uvec3(whole - 65536.0 * floor(whole / 65536.0)) & 65535u;
    uvec3 b = (a + 1u) & 65535u;
    vec3 u = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec4 low = vec4(noise_lattice(a, seed), noise_lattice(uvec3(a.x, b.y, a.z), seed),
                    noise_lattice(uvec3(a.x, a.y, b.z), seed),
                    noise_lattice(uvec3(a.x, b.y, b.z), seed));
    vec4 high = vec4(noise_lattice(uvec3(b.x, a.y, a.z), seed),
                     noise_lattice(uvec3(b.x, b.y, a.z), seed),
                     noise_lattice(uvec3(b.x, a.y, b.z), seed), noise_lattice(b, seed));
    vec4 rows = mix(low, high, u.x);
    vec2 planes = mix(rows.xz, rows.yw, u.y);
    return mix(planes.x, planes.y, u.z);
}

/* Sum of octaves, each with twice the frequency and half of the height of the one before. */
float noise_octaves(vec3 p, int octaves, uint seed)
{
    float height = 1.0, sum = 0.0;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_value(p, seed + uint(i));
        height *= 0.5;
        p = 2.0 * p + 0.37;
    }
    return sum;
}
