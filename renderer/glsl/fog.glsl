/* SPDX-License-Identifier: MIT */
/* Fog that thins with height as exp(-height): its sum along a ray in closed form (Quilez: Better
 * fog, 2010). */

#include "ray.glsl"

/* Light that fog adds before distance t, and the part of the light from there that it lets through.
 * Where nothing is hit it ends with what can be seen. */
vec4 fog(Ray ray, float t)
{
    float distance = min(t, frame.max_distance);
    /* What is far below is opaque: its density need not be right, but finite. */
    float low = max(frame.fog_thinning * (ray.origin.y - frame.fog_base), -60.0);
    float high = frame.fog_thinning * (ray.origin.y + ray.direction.y * distance - frame.fog_base);
    float rise = max(high, -60.0) - low, a = exp(-low), b = exp(-max(high, -60.0));
    float mean = abs(rise) < 1e-3 ? 0.5 * (a + b) : (a - b) / rise;
    float transmittance = exp(-frame.fog_density * mean * distance);
    return vec4(frame.fog_color * (1.0 - transmittance), transmittance);
}
