/* SPDX-License-Identifier: MIT */
/* Fog that thins with height as exp(-height): its sum along a ray in closed form (Quilez: Better
 * fog, 2010). */

/* Light that fog adds before distance t, and the part of the light from there that it lets through.
 * Where nothing is hit it ends with what can be seen. */
vec4 fog(Ray ray, float t)
{
    float way = min(t, bounds_max.w);
    /* What is far below is opaque: its density need not be right, but finite. */
    float low = max(fog_shape.x * (ray.origin.y - fog_shape.y), -60.0);
    float high = fog_shape.x * (ray.origin.y + ray.direction.y * way - fog_shape.y);
    float rise = max(high, -60.0) - low, a = exp(-low), b = exp(-max(high, -60.0));
    float mean = abs(rise) < 1e-3 ? 0.5 * (a + b) : (a - b) / rise;
    float through = exp(-fog_color.w * mean * way);
    return vec4(fog_color.rgb * (1.0 - through), through);
}
