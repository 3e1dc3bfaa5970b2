/* SPDX-License-Identifier: MIT */
/* Distance functions of primitives with flat sides; in C they are in renderer/sdf/solids.c. */

#include "shapes.glsl"

/* A rod with six equal sides along Z. */
float sd_hex_prism(vec3 p, float radius, float height)
{
    const vec2 mirror = vec2(0.866025404, -0.5);
    vec2 q = abs(p.xy);
    q -= 2.0 * max(dot(q, mirror), 0.0) * mirror;
    vec2 over = vec2(max(abs(q.x) - 0.577350269 * radius, 0.0), q.y - radius);
    return corner(over.y < 0.0 ? over.y : length(over), abs(p.z) - 0.5 * height);
}

/* A rod with three equal sides along Z, an edge up. */
float sd_tri_prism(vec3 p, float radius, float height)
{
    const vec2 mirror = vec2(0.5, 0.866025404);
    vec2 q = vec2(abs(p.x), p.y);
    q -= 2.0 * max(dot(q, mirror), 0.0) * mirror;
    vec2 over = vec2(max(abs(q.x) - 1.732050808 * radius, 0.0), -radius - q.y);
    return corner(over.y < 0.0 ? over.y : length(over), abs(p.z) - 0.5 * height);
}

/* A solid of eight triangles, its corners on the axes. */
float sd_octahedron(vec3 p, float radius)
{
    vec3 q = abs(p);
    q = q.x <= min(q.y, q.z) ? q : q.y <= q.z ? q.yzx : q.zxy;
    float face = q.x + q.y + q.z - radius;
    float t = clamp(0.5 * (q.z - q.y + radius), 0.0, radius);
    return 3.0 * q.x < face ? length(q - vec3(0.0, radius - t, t)) : face * 0.577350269;
}

/* Distance to a regular solid, where its mirrors have led: `axes` are the normal of a face, the way
 * in it to the middle of an edge, and the way on to a corner; `ends` is that corner in them. */
float regular(vec3 q, mat3 axes, vec3 ends)
{
    vec3 w = q * axes - ends;
    return w.y > 0.0 ? length(vec3(w.xy, max(w.z, 0.0))) : w.x;
}

/* A solid of four triangles. */
float sd_tetrahedron(vec3 p, float radius)
{
    const mat3 axes = mat3(0.577350269, 0.577350269, -0.577350269, 0.816496581, -0.408248290,
                           0.408248290, 0.0, 0.707106781, 0.707106781);
    vec3 a = abs(p);
    float smallest = min(a.x, min(a.y, a.z));
    bool odd = (p.x < 0.0) != ((p.y < 0.0) != (p.z < 0.0));
    vec3 q = vec3(max(a.x, max(a.y, a.z)), max(min(a.x, a.y), min(max(a.x, a.y), a.z)),
                  odd ? -smallest : smallest);
    return regular(q, axes, radius * vec3(0.333333333, 0.471404521, 0.816496581));
}

/* The image of a point by the mirrors of the icosahedron, between an axis of each kind. */
vec3 icosahedral(vec3 p)
{
    const vec3 mirror = vec3(0.809016994, 0.5, -0.309016994);
    vec3 q = abs(p);
    q = abs(q - 2.0 * max(dot(q, mirror), 0.0) * mirror);
    q = abs(q - 2.0 * max(dot(q, mirror), 0.0) * mirror);
    return abs(q - 2.0 * max(dot(q, mirror), 0.0) * mirror);
}

/* A solid of twelve pentagons. */
float sd_dodecahedron(vec3 p, float radius)
{
    const mat3 axes = mat3(0.0, 0.525731112, 0.850650808, 0.0, -0.850650808, 0.525731112, 1.0, 0.0,
                           0.0);
    return regular(icosahedral(p.yxz), axes, radius * vec3(0.794654472, 0.491123473, 0.356822090));
}

/* A solid of twenty triangles. */
float sd_icosahedron(vec3 p, float radius)
{
    const mat3 axes = mat3(0.356822090, 0.0, 0.934172359, -0.934172359, 0.0, 0.356822090, 0.0, 1.0,
                           0.0);
    return regular(icosahedral(p), axes, radius * vec3(0.794654472, 0.303530999, 0.525731112));
}

/* A pyramid on a square at y = 0: the nearer of the square and the side towards +X. */
float sd_pyramid(vec3 p, float base, float height)
{
    float half_base = 0.5 * base, slope = length(vec2(half_base, height));
    vec3 q = vec3(max(abs(p.x), abs(p.z)), p.y, min(abs(p.x), abs(p.z)));
    vec3 under = vec3(max(q.x - half_base, 0.0), q.y, max(q.z - half_base, 0.0));
    vec3 side = vec3((q.x - half_base) * height + q.y * half_base,
                     q.y * height - (q.x - half_base) * half_base, q.z * slope) / slope;
    vec2 edge = vec2(slope, -half_base), rest = vec2(side.y, side.z - half_base);
    bool beside = rest.x * half_base + rest.y * slope > 0.0;
    vec2 over = beside ? rest - edge * clamp(dot(rest, edge) / dot(edge, edge), 0.0, 1.0)
                       : vec2(min(side.y, 0.0), max(rest.y, 0.0));
    float square = min(dot(under, under), side.x * side.x + dot(over, over));
    return q.y > 0.0 && side.x < 0.0 ? -min(q.y, -side.x) : sqrt(square);
}

/* A plate in the form of a diamond, grown in its plane by `rounding`. */
float sd_rhombus(vec3 p, float width, float depth, float height, float rounding)
{
    vec2 q = abs(p.xz), end = 0.5 * vec2(width, depth), side = vec2(-end.x, end.y);
    vec2 w = q - vec2(end.x, 0.0);
    float d = length(w - side * clamp(dot(w, side) / dot(side, side), 0.0, 1.0));
    bool inside = w.x * end.y + w.y * end.x < 0.0;
    return corner((inside ? -d : d) - rounding, abs(p.y) - 0.5 * height);
}

/* The square of the distance from the origin to the segment from a to b. */
float segment_square(vec3 a, vec3 b)
{
    vec3 e = b - a;
    vec3 w = a + e * clamp(-dot(a, e) / max(dot(e, e), 1e-30), 0.0, 1.0);
    return dot(w, w);
}

/* The same to a triangle of any form: its edges, and the foot in its plane as far as it is inside.
 * The foot is kept inside rather than tested, so it does no harm where the plane is unsure. */
float triangle_square(vec3 a, vec3 b, vec3 c)
{
    vec3 u = b - a, v = c - a;
    float uu = max(dot(u, u), 1e-30);
    vec3 across = v - u * (dot(u, v) / uu);
    float t = clamp(-dot(a, across) / max(dot(across, across), 1e-30), 0.0, 1.0);
    float s = clamp(-dot(a + v * t, u) / uu, 0.0, 1.0 - t);
    vec3 foot = a + u * s + v * t;
    return min(min(dot(foot, foot), segment_square(a, b)),
               min(segment_square(b, c), segment_square(c, a)));
}

/* All points near a triangle. */
float sd_triangle(vec3 p, vec3 a, vec3 b, vec3 c, float thickness)
{
    return sqrt(triangle_square(a - p, b - p, c - p)) - thickness;
}

/* All points near two triangles. */
float sd_quad(vec3 p, vec3 a, vec3 b, vec3 c, vec3 d, float thickness)
{
    vec3 pa = a - p, pc = c - p;
    return sqrt(min(triangle_square(pa, b - p, pc), triangle_square(pa, pc, d - p))) - thickness;
}
