/* SPDX-License-Identifier: MIT */
/* Surfaces by patches (renderer/sdf/patches.h), as in renderer/sdf/patches.c. */

#include "params.glsl"

/* Of lanes that run together, as the engine's do. A shader's are apart. */
#ifndef ANY_LANE
#define ANY_LANE(x) (x)
#define FIRST_LANE(x) (x)
#endif

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
        vec2 from = uv;
        uv = patch_step(p, a, b, c, d, uv);
        vec2 moved = abs(uv - from);
        if (max(moved.x, moved.y) < 0.05) {
            break;
        }
    }
    vec3 e = p - patch_point(a, b, c, d, uv);
    return dot(e, e);
}

/* The same, or `best` where that is less. From five places of a bent patch. */
float patch_nearer(vec3 p, int at, bool again, float best)
{
    vec4 middle = P_FROM(at + 12), first = P_FROM(at + 13), second = P_FROM(at + 14);
    int begins = second.w < 0.0 ? 4 : again ? -1 : 0;
    vec3 e = p - middle.xyz, half_size = vec3(middle.w, first.w, abs(second.w));
    vec3 place = vec3(dot(e, first.xyz), dot(e, second.xyz),
                      dot(e, cross(first.xyz, second.xyz)));
    vec3 away = max(abs(place) - half_size, 0.0);
    if (dot(away, away) < best) {
        for (int i = begins; i >= 0; i--) {
            vec2 uv = vec2(i == 1 || i == 3 ? 0.25 : 0.75, i > 2 ? 0.25 : 0.75);
            if (i == 0) {
                uv = clamp(0.5 + 0.5 * place.xy / half_size.xy, 0.0, 1.0);
            }
            best = min(best, patch_near(p, at, uv));
        }
    }
    return best;
}

/* The square of the distance to the patch that a corner of the grid knows. Lanes that have the same
 * one go together: its numbers are fetched once for all of them. */
float patches_begin(vec3 p, int first, vec4 seed)
{
    float best = 0.0;
    for (int waits = 1; waits > 0;) {
        int one = FIRST_LANE(int(seed.y));
        if (one == int(seed.y)) {
            best = patch_near(p, first + 15 * one, seed.zw);
            waits = 0;
        }
    }
    return best;
}

/* The distance to the nearest patch, from what a corner of the grid knows. All lanes go through the
 * nodes that one of them asks for; `next` is the node that a lane waits for. After 256 nodes boxes
 * stand for what is in them. */
float patches_search(vec3 p, int tree, int nodes, vec4 seed)
{
    int first = tree + 2 * nodes, next = 0, left = 256;
    float best = patches_begin(p, first, seed);
    for (int i = 0; i < nodes;) {
        vec4 low = P_FROM(tree + 2 * i), high = P_FROM(tree + 2 * i + 1);
        vec3 away = max(max(low.xyz - p, p - high.xyz), 0.0);
        float square = dot(away, away);
        bool here = i >= next, down = here && square < best;
        if (high.w >= 0.0) {
            if (down) {
                int one = int(high.w);
                best = patch_nearer(p, first + 15 * one, one == int(seed.y), best);
            }
            down = false;
        } else if (down && left <= 0) {
            best = square;
            down = false;
        }
        left -= here ? 1 : 0;
        next = down ? next : max(next, int(low.w));
        i = ANY_LANE(down) ? i + 1 : max(int(low.w), i + 1);
    }
    return sqrt(best);
}

/* What the corners of a cell tell, interpolated. */
float patches_mean(int first, int row, int layer, vec3 f)
{
    vec4 near = vec4(P_FROM(first).x, P_FROM(first + row).x, P_FROM(first + layer).x,
                     P_FROM(first + row + layer).x);
    vec4 next = vec4(P_FROM(first + 1).x, P_FROM(first + row + 1).x, P_FROM(first + layer + 1).x,
                     P_FROM(first + row + layer + 1).x);
    vec4 edges = near + (next - near) * f.x;
    vec2 faces = edges.xz + (edges.yw - edges.xz) * f.y;
    return faces.x + (faces.y - faces.x) * f.z;
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
    float mean = 0.0;
    for (int waits = 1; waits > 0;) {
        int one = FIRST_LANE(first);
        if (first == one) {
            mean = patches_mean(one, row, layer, f);
            waits = 0;
        }
    }
    float far = max(mean - band.z, 0.0);
    float share = clamp((mean - band.x) * band.y, 0.0, 1.0);
    if (share < 1.0) {
        int seed =
            first + (f.x > 0.5 ? 1 : 0) + (f.y > 0.5 ? row : 0) + (f.z > 0.5 ? layer : 0);
        float exact = patches_search(p, corners + int(along.w), int(band.w), P_FROM(seed));
        far = exact + (far - exact) * share;
    }
    return far;
}

float patches(vec3 p, int at)
{
    vec4 low = P_FROM(at), high = P_FROM(at + 1);
    vec3 near = clamp(p, low.xyz, high.xyz);
    return length(vec2(distance(p, near), patches_within(near, at, low))) - high.w;
}
