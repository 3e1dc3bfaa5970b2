/* SPDX-License-Identifier: MIT */
/* Where a picture of one sample for each pixel has edges: surfaces that end or bend, and changes of
 * colour that nothing of the surface tells of (shadows, patterns, reflections). */

#include "camera.glsl"
#include "geometry_load.glsl"
#include "sums_load.glsl"

/* 0: the same surface; 1 and more: an edge. Depth is compared with the plane through the pixel. */
float edge_between(ivec2 here, ivec2 there, vec4 g)
{
    vec4 h = texelFetch(geometry, there, 0);
    bool a = g.w < INFINITY, b = h.w < INFINITY;
    float bent = (1.0 - dot(g.xyz, h.xyz)) / 0.08;
    float slope = max(-dot(g.xyz, camera_ray(vec2(dispatch.origin + here) + 0.5).direction), 0.05);
    float radius = camera.pixel_radius * (camera.orthographic != 0 ? 1.0 : g.w);
    float apart = abs(h.w - g.w) * slope / (6.0 * radius);
    return a && b ? max(bent, apart) : a == b ? 0.0 : 2.0;
}

/* The strongest of the eight around. */
float edge_at(ivec2 here)
{
    vec4 g = texelFetch(geometry, here, 0);
    float strongest = 0.0;
    for (int i = zero; i < 9; i++) {
        strongest =
            max(strongest, i == 4 ? 0.0 : edge_between(here, here + ivec2(i % 3, i / 3) - 1, g));
    }
    return strongest;
}

/* A pixel's colour and coverage in about equal steps for the eye. */
vec4 seen_at(ivec2 here)
{
    vec4 mean = mean_at(here);
    return sqrt(clamp(vec4(shown(mean.rgb), mean.a), 0.0, 1.0));
}

/* How much the colours around differ from the pixel's, as eyes see them. */
float contrast_at(ivec2 here)
{
    vec4 c = seen_at(here), strongest = vec4(0.0);
    for (int i = zero; i < 9; i++) {
        strongest = max(strongest, abs(seen_at(here + ivec2(i % 3, i / 3) - 1) - c));
    }
    return max(strongest.r, max(strongest.g, strongest.b));
}

/* Whether the pixel is worth more samples. */
bool is_edge(ivec2 here)
{
    return edge_at(here) >= 1.0 || contrast_at(here) > 0.06;
}
