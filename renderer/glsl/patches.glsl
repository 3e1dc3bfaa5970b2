/* SPDX-License-Identifier: MIT */
/* Surfaces by patches (renderer/sdf/patches.h), as in renderer/sdf/patches.c. */

#include "params.glsl"

/* The coefficients of one power of u: those of all powers of v, for each coordinate. */
struct PatchRow {
    vec4 x, y, z;
};

PatchRow patch_row(int at)
{
    return PatchRow(P_FROM(at), P_FROM(at + 1), P_FROM(at + 2));
}

vec3 patch_dot(PatchRow row, vec4 powers)
{
    return vec3(dot(row.x, powers), dot(row.y, powers), dot(row.z, powers));
}

vec3 patch_point(PatchRow a, PatchRow b, PatchRow c, PatchRow d, vec2 uv)
{
    vec4 powers = vec4(1.0, uv.y, uv.y * uv.y, uv.y * uv.y * uv.y);
    return ((patch_dot(d, powers) * uv.x + patch_dot(c, powers)) * uv.x + patch_dot(b, powers)) *
               uv.x +
           patch_dot(a, powers);
}

/* One step of Newton's method for the nearest point, in the square of parameters: where one of them
 * is at its end, the other goes on alone. */
vec2 patch_step(vec3 p, PatchRow a, PatchRow b, PatchRow c, PatchRow d, vec2 uv)
{
    float u = uv.x, v = uv.y;
    vec4 powers = vec4(1.0, v, v * v, v * v * v);
    vec4 first = vec4(0.0, 1.0, 2.0 * v, 3.0 * v * v), second = vec4(0.0, 0.0, 2.0, 6.0 * v);
    vec3 r0 = patch_dot(a, powers), r1 = patch_dot(b, powers);
    vec3 r2 = patch_dot(c, powers), r3 = patch_dot(d, powers);
    vec3 t1 = patch_dot(b, first), t2 = patch_dot(c, first), t3 = patch_dot(d, first);
    vec3 e = p - (((r3 * u + r2) * u + r1) * u + r0);
    vec3 by_u = (3.0 * r3 * u + 2.0 * r2) * u + r1;
    vec3 by_v = ((t3 * u + t2) * u + t1) * u + patch_dot(a, first);
    vec3 q2 = patch_dot(c, second), q3 = patch_dot(d, second);
    vec3 by_vv = ((q3 * u + q2) * u + patch_dot(b, second)) * u + patch_dot(a, second);
    float gu = dot(by_u, by_u), gv = dot(by_v, by_v), bu = dot(by_u, e), bv = dot(by_v, e);
    float small = 1e-6 * (gu + gv) + 1e-30;
    float uu = max(gu - dot(6.0 * r3 * u + 2.0 * r2, e), 0.25 * gu) + small;
    float vv = max(gv - dot(by_vv, e), 0.25 * gv) + small;
    float bound = 0.95 * sqrt(uu * vv);
    float mixed = dot(by_u, by_v) - dot((3.0 * t3 * u + 2.0 * t2) * u + t1, e);
    mixed = clamp(mixed, -bound, bound);
    float du = (bu * vv - bv * mixed) / (uu * vv - mixed * mixed);
    du = clamp(du, -u, 1.0 - u);
    float dv = clamp((bv - mixed * du) / vv, -v, 1.0 - v);
    du = clamp((bu - mixed * dv) / uu, -u, 1.0 - u);
    return vec2(u + du, v + dv);
}

/* The square of the distance to a patch; `uv` is where to begin. */
float patch_near(vec3 p, int at, vec2 uv)
{
    PatchRow a = patch_row(at), b = patch_row(at + 3), c = patch_row(at + 6), d = patch_row(at + 9);
    for (int i = 0; i < 3; i++) {
        uv = patch_step(p, a, b, c, d, uv);
    }
    vec3 e = p - patch_point(a, b, c, d, uv);
    return dot(e, e);
}

/* The distance to the nearest patch, from what a corner of the grid knows. */
float patches_search(vec3 p, int tree, int nodes, vec4 seed)
{
    int first = tree + 2 * nodes, i = 0;
    float best = patch_near(p, first + 12 * int(seed.y), seed.zw);
    for (int left = 256; left > 0 && i < nodes; left--) {
        vec4 low = P_FROM(tree + 2 * i), high = P_FROM(tree + 2 * i + 1);
        vec3 away = max(max(low.xyz - p, p - high.xyz), 0.0);
        bool near = dot(away, away) < best;
        if (near && high.w >= 0.0) {
            best = min(best, patch_near(p, first + 12 * int(high.w), vec2(0.5)));
        }
        i = near ? i + 1 : int(low.w);
    }
    return sqrt(best);
}

/* In the grid. */
float patches_within(vec3 p, int at, vec4 low)
{
    vec4 along = P_FROM(at + 2), band = P_FROM(at + 3);
    vec3 place = (p - low.xyz) / max(low.w, 1e-18);
    vec3 cell = clamp(floor(place), vec3(0.0), max(along.xyz - 2.0, 0.0));
    vec3 f = place - cell;
    int row = int(along.x), layer = row * int(along.y);
    int corners = at + 4, first = corners + int(cell.x) + row * int(cell.y) + layer * int(cell.z);
    vec4 near = vec4(P_FROM(first).x, P_FROM(first + row).x, P_FROM(first + layer).x,
                     P_FROM(first + row + layer).x);
    vec4 next = vec4(P_FROM(first + 1).x, P_FROM(first + row + 1).x, P_FROM(first + layer + 1).x,
                     P_FROM(first + row + layer + 1).x);
    vec4 edges = near + (next - near) * f.x;
    vec2 faces = edges.xz + (edges.yw - edges.xz) * f.y;
    float mean = faces.x + (faces.y - faces.x) * f.z;
    float far = max(mean - band.z, 0.0);
    float share = clamp((mean - band.x) * band.y, 0.0, 1.0);
    if (share == 1.0) {
        return far;
    }
    int seed = first + (f.x > 0.5 ? 1 : 0) + (f.y > 0.5 ? row : 0) + (f.z > 0.5 ? layer : 0);
    float exact = patches_search(p, corners + int(along.w), int(band.w), P_FROM(seed));
    return exact + (far - exact) * share;
}

float patches(vec3 p, int at)
{
    vec4 low = P_FROM(at), high = P_FROM(at + 1);
    vec3 near = clamp(p, low.xyz, high.xyz);
    return length(vec2(distance(p, near), patches_within(near, at, low))) - high.w;
}
