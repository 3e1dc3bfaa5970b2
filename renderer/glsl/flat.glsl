/* SPDX-License-Identifier: MIT */
/* Distance functions of two-dimensional shapes; in C they are in renderer/sdf/flat.c. */

#include "points.glsl"
#include "shapes.glsl"

#define FLAT_PI 3.14159265

/* Positive where b lies to the left of a. */
float cross2(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* The square of the distance to the segment from a to b. */
float to_segment(vec2 p, vec2 a, vec2 b)
{
    vec2 w = p - a, e = b - a;
    w -= e * clamp(dot(w, e) / max(dot(e, e), 1e-30), 0.0, 1.0);
    return dot(w, w);
}

/* A disc. */
float sd2_circle(vec2 p, float radius)
{
    return length(p) - radius;
}

/* A rectangle of full lengths `size`. */
float sd2_rectangle(vec2 p, vec2 size)
{
    vec2 q = abs(p) - 0.5 * size;
    return corner(q.x, q.y);
}

/* A rectangle whose rounding lies inside `size`; radius at most half of the lesser length. */
float sd2_round_rectangle(vec2 p, vec2 size, float radius)
{
    return sd2_rectangle(p, size - 2.0 * radius) - radius;
}

/* A triangle, its corners in either order. */
float sd2_triangle2(vec2 p, vec2 a, vec2 b, vec2 c)
{
    float turn = sign(cross2(b - a, c - a));
    vec3 left = turn * vec3(cross2(b - a, p - a), cross2(c - b, p - b), cross2(a - c, p - c));
    float d = sqrt(min(to_segment(p, a, b), min(to_segment(p, b, c), to_segment(p, c, a))));
    return min(left.x, min(left.y, left.z)) > 0.0 ? -d : d;
}

/* A star, its first point up: in half of a sector, the edge from a point to a corner `inner`. */
float sd2_star(vec2 p, float radius, float points, float inner)
{
    float turn = 2.0 * FLAT_PI / points;
    float angle = turn * round(atan(p.x, p.y == 0.0 ? 1e-30 : p.y) / turn);
    float c = cos(angle), s = sin(angle);
    vec2 q = vec2(abs(c * p.x - s * p.y), s * p.x + c * p.y), tip = vec2(0.0, radius);
    vec2 dent = inner * vec2(sin(0.5 * turn), cos(0.5 * turn));
    float d = sqrt(to_segment(q, tip, dent));
    return cross2(dent - tip, q - tip) < 0.0 ? -d : d;
}

/* A polygon of equal sides, its first corner up. */
float sd2_regular_polygon(vec2 p, float radius, float sides)
{
    return sd2_star(p, radius, sides, radius * cos(FLAT_PI / sides));
}

/* A polygon: inside, a ray from the point to the right crosses an odd number of sides. */
float sd2_polygon(vec2 p, vec2 points)
{
    int count = points_count(points);
    vec2 a = points_at(points, count - 1);
    float nearest = 1e18;
    bool inside = false;
    for (int i = 0; i < count; i++) {
        vec2 b = points_at(points, i);
        bool level = (a.y > p.y) != (b.y > p.y);
        inside = inside != (level && (cross2(b - a, p - a) > 0.0) == (b.y > a.y));
        nearest = min(nearest, to_segment(p, a, b));
        a = b;
    }
    return inside ? -sqrt(nearest) : sqrt(nearest);
}

/* A line along a circle, at most twice as thick as the circle's radius. */
float sd2_ring(vec2 p, float radius, float thickness)
{
    return abs(length(p) - radius) - 0.5 * thickness;
}

/* An arc around +Y by one of its ends: outside from the line, inside to the circles around it. */
float sd2_arc(vec2 p, float end_x, float end_y, float thickness)
{
    vec2 end = vec2(end_x, end_y), q = vec2(abs(p.x), p.y), w = q - end;
    float half_width = 0.5 * thickness, radius = length(end), r = length(q), l = length(w);
    float pore = 1e-6 * radius;
    bool beyond = cross2(q, end) > 0.0;
    float line = beyond ? l : abs(r - radius);
    float depth = beyond ? 1e9 : radius + half_width - r;
    bool hole = !beyond && half_width < radius - pore;
    depth = hole ? min(depth, half_width - radius + r) : depth;
    vec2 rim = end + w * (half_width / max(l, 1e-30));
    depth = rim.x >= 0.0 && cross2(rim, end) >= 0.0 ? min(depth, half_width - l) : depth;
    float root = sqrt(max((half_width - end.x) * (half_width + end.x), 0.0));
    float low = end.y - root, high = end.y + root;
    depth = half_width >= end.x && low < pore ? min(depth, length(q - vec2(0.0, low))) : depth;
    depth = half_width >= end.x && high < -pore ? min(depth, length(q - vec2(0.0, high))) : depth;
    return line > half_width ? line - half_width : -depth;
}

/* A bowl by its rim: an arc around -Y, turned about Y. */
float sd_cut_hollow_sphere(vec3 p, float rim_x, float rim_y, float thickness)
{
    return sd2_arc(vec2(length(p.xz), -p.y), rim_x, -rim_y, 2.0 * thickness);
}

/* What two discs have in common, whose centres are `between` apart; at most twice the radius. */
float sd2_vesica(vec2 p, float radius, float between)
{
    vec2 q = abs(p);
    float centre = 0.5 * between, tip = sqrt(max((radius - centre) * (radius + centre), 0.0));
    return (q.y - tip) * centre > q.x * tip ? length(q - vec2(0.0, tip))
                                            : length(q + vec2(centre, 0.0)) - radius;
}

/* Two equal bars: in an eighth of the plane, a bar's end, its side, the corner between them. */
float sd2_cross(vec2 p, float size, float thickness)
{
    vec2 q = abs(p);
    q = vec2(max(q.x, q.y), min(q.x, q.y));
    vec2 over = q - 0.5 * vec2(size, thickness);
    float inside = max(over.x, -length(vec2(max(0.5 * thickness - q.x, 0.0), over.y)));
    return max(over.x, over.y) > 0.0 ? length(max(over, 0.0)) : inside;
}

/* A quadratic curve: the roots of a cubic by Newton's method from both ends, and the sharpest
 * point of the curve. */
float sd2_bezier(vec2 p, vec2 a, vec2 b, vec2 c, float thickness)
{
    vec2 w = a - p, u = b - a, v = a - 2.0 * b + c;
    float uv = dot(u, v), vv = dot(v, v), c0 = dot(w, u), c1 = 2.0 * dot(u, u) + dot(w, v);
    vec2 t = vec2(0.0, 1.0);
    for (int i = 0; i < 10; i++) {
        vec2 value = ((vv * t + 3.0 * uv) * t + c1) * t + c0;
        vec2 slope = (3.0 * vv * t + 6.0 * uv) * t + c1;
        t = clamp(t - value / max(slope, 1e-20), 0.0, 1.0);
    }
    float sharpest = clamp(-uv / max(vv, 1e-30), 0.0, 1.0);
    vec2 x = w + t.x * (2.0 * u + t.x * v), y = w + t.y * (2.0 * u + t.y * v);
    vec2 z = w + sharpest * (2.0 * u + sharpest * v);
    return sqrt(min(dot(x, x), min(dot(y, y), dot(z, z)))) - 0.5 * thickness;
}

/* A heart that stands on the origin: half of a disc on a square that stands on its corner. */
float sd2_heart(vec2 p, float size)
{
    vec2 q = vec2(abs(p.x), p.y), foot = q - 0.5 * max(q.x + q.y, 0.0);
    float disc = length(q - size * vec2(0.25, 0.75)) - size * 0.35355339;
    vec2 notch = q - vec2(0.0, size);
    float d = sqrt(min(dot(foot, foot), dot(notch, notch)));
    return q.x + q.y > size ? disc : q.x < q.y ? -d : d;
}

/* A disc with two radii: a bound. */
float sd2_ellipse(vec2 p, vec2 radii)
{
    return (length(p / radii) - 1.0) * min(radii.x, radii.y);
}

/* A straight line with round ends. */
float sd2_segment(vec2 p, vec2 a, vec2 b, float thickness)
{
    return sqrt(to_segment(p, a, b)) - 0.5 * thickness;
}
