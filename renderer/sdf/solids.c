/* SPDX-License-Identifier: MIT */
/* Primitives in three dimensions with flat sides, and flat ones with a thickness. */
#include <stdbool.h>

#include "tools.h"

#define GOLDEN 1.618033988749895

/* --- prisms along Z --- */

/* Distance to a regular polygon whose side of this half length faces up, at `radius`; a point in
 * the sector of that side. */
static double side(double x, double y, double radius, double half)
{
    return y < radius ? y - radius : hypot(fmax(fabs(x) - half, 0), y - radius);
}

static double hex_prism(const double p[3], const double *n)
{
    const double x = fabs(p[0]), y = fabs(p[1]);
    const double beyond = fmax(x * sqrt(3) / 2 - y / 2, 0); /* of the mirror between two sides */
    const double flat = side(x - beyond * sqrt(3), y + beyond, n[0], n[0] / sqrt(3));

    return corner(flat, fabs(p[2]) - n[1] / 2);
}

static struct bounds hex_prism_box(const double *n)
{
    return bounds_centred(n[0] * 2 / sqrt(3), n[0], n[1] / 2);
}

static double tri_prism(const double p[3], const double *n)
{
    const double x = fabs(p[0]), y = p[1];
    const double beyond = fmax(x / 2 + y * sqrt(3) / 2, 0);
    const double flat = side(x - beyond, beyond * sqrt(3) - y, n[0], n[0] * sqrt(3));

    return corner(flat, fabs(p[2]) - n[1] / 2);
}

static struct bounds tri_prism_box(const double *n)
{
    struct bounds box = bounds_centred(n[0] * sqrt(3), n[0], n[1] / 2);

    box.high[1] = 2 * n[0];
    return box;
}

/* --- regular solids --- */

/* With the least coordinate first: the face, unless the foot lies beyond the edge where that
 * coordinate is 0. */
static double octahedron(const double p[3], const double *n)
{
    double a[3] = {fabs(p[0]), fabs(p[1]), fabs(p[2])};
    const int least = a[0] <= fmin(a[1], a[2]) ? 0 : a[1] <= a[2] ? 1 : 2;
    const double x = a[least], y = a[(least + 1) % 3], z = a[(least + 2) % 3];
    const double face = x + y + z - n[0], t = clamp((z - y + n[0]) / 2, 0, n[0]);

    return 3 * x < face ? length3(x, y - n[0] + t, z - t) : face / sqrt(3);
}

static struct bounds octahedron_box(const double *n)
{
    return bounds_centred(n[0], n[0], n[0]);
}

/* A regular solid looks the same in all its mirrors, so the point may be led by them into the wedge
 * between the middle of a face, the middle of an edge and a corner. What is nearest to it lies
 * there too, on the triangle of these three. `ways` to the three need no length. */
static double regular(const double q[3], const double ways[3][3], double radius)
{
    double axes[3][3], corner_at[3], w[3];
    const double along_face = dot(ways[0], ways[0]), along_corner = dot(ways[2], ways[2]);
    const double inner = radius * dot(ways[0], ways[2]) / sqrt(along_face * along_corner);

    for (int i = 0; i < 3; i++) {
        const double face = ways[0][i] / sqrt(along_face);
        const double edge = ways[1][i] * inner * sqrt(along_face) / dot(ways[0], ways[1]);
        corner_at[i] = ways[2][i] * radius / sqrt(along_corner);
        axes[0][i] = face;
        axes[1][i] = edge - face * inner;
        axes[2][i] = corner_at[i] - edge;
    }
    for (int i = 0; i < 3; i++) {
        const double length = sqrt(dot(axes[i], axes[i]));
        w[i] = (dot(axes[i], q) - dot(axes[i], corner_at)) / length;
    }
    return w[1] > 0 ? length3(w[0], w[1], fmax(w[2], 0)) : w[0];
}

/* The mirrors are the planes in which two coordinates, or one and the other's negative, are equal.
 * They keep the sign of the product, and let the coordinates be sorted. */
static double tetrahedron(const double p[3], const double *n)
{
    static const double ways[3][3] = {{1, 1, -1}, {1, 0, 0}, {1, 1, 1}};
    const double x = fabs(p[0]), y = fabs(p[1]), z = fabs(p[2]), least = fmin(x, fmin(y, z));
    const bool odd = (p[0] < 0) != ((p[1] < 0) != (p[2] < 0));
    double q[3] = {fmax(x, fmax(y, z)), fmax(fmin(x, y), fmin(fmax(x, y), z)),
                   odd ? -least : least};

    return regular(q, ways, n[0]);
}

/* Corners at equal signs of three equal coordinates. */
static struct bounds tetrahedron_box(const double *n)
{
    const double x = n[0] / sqrt(3);

    return bounds_centred(x, x, x);
}

/* Three rounds of the four mirrors lead any point into the wedge between the axes (0, 1, GOLDEN) of
 * five, (1, 0, GOLDEN + 1) of three and (0, 0, 1) of two turns. */
static void icosahedral(double q[3])
{
    static const double mirror[3] = {GOLDEN / 2, 0.5, -1 / (2 * GOLDEN)};

    for (int round = 0; round <= 3; round++) {
        const double beyond = round ? fmax(dot(q, mirror), 0) : 0;
        for (int i = 0; i < 3; i++) {
            q[i] = fabs(q[i] - 2 * beyond * mirror[i]);
        }
    }
}

/* Its own mirrors are those with X and Y exchanged. */
static double dodecahedron(const double p[3], const double *n)
{
    static const double ways[3][3] = {{0, 1, GOLDEN}, {0, 0, 1}, {1, 0, GOLDEN + 1}};
    double q[3] = {p[1], p[0], p[2]};

    icosahedral(q);
    return regular(q, ways, n[0]);
}

static struct bounds dodecahedron_box(const double *n)
{
    const double x = n[0] * GOLDEN / sqrt(3);

    return bounds_centred(x, x, x);
}

static double icosahedron(const double p[3], const double *n)
{
    static const double ways[3][3] = {{1, 0, GOLDEN + 1}, {0, 0, 1}, {0, 1, GOLDEN}};
    double q[3] = {p[0], p[1], p[2]};

    icosahedral(q);
    return regular(q, ways, n[0]);
}

static struct bounds icosahedron_box(const double *n)
{
    const double x = n[0] * GOLDEN / sqrt(GOLDEN + 2);

    return bounds_centred(x, x, x);
}

/* --- pyramid --- */

/* In the quarter around +X, of which only the half with z > 0 is looked at, the nearest point lies
 * on the square at y = 0 or on the side towards +X. In the plane of that side, with u up the slope
 * from the middle of its lower edge, the side is the triangle (0, +-half), (slope, 0). */
static double pyramid(const double p[3], const double *n)
{
    const double half = n[0] / 2, height = n[1], slope = hypot(half, height);
    const double x = fmax(fabs(p[0]), fabs(p[2])) - half, z = fmin(fabs(p[0]), fabs(p[2])) - half;
    const double above = (x * height + p[1] * half) / slope, u = (p[1] * height - x * half) / slope;

    if (p[1] > 0 && above < 0) {
        return -fmin(p[1], -above);
    }
    double over[2] = {fmin(u, 0), fmax(z, 0)};
    if (u * half + z * slope > 0) {
        const double t = clamp((u * slope - z * half) / (slope * slope + half * half), 0, 1);
        over[0] = u - t * slope;
        over[1] = z + t * half;
    }
    return fmin(length3(fmax(x, 0), p[1], fmax(z, 0)), length3(above, over[0], over[1]));
}

static struct bounds pyramid_box(const double *n)
{
    struct bounds box = bounds_centred(n[0] / 2, 0, n[0] / 2);

    box.high[1] = n[1];
    return box;
}

/* --- plates --- */

static double rhombus(const double p[3], const double *n)
{
    const double a = n[0] / 2, b = n[1] / 2, x = fabs(p[0]) - a, z = fabs(p[2]);
    const double t = clamp((z * b - x * a) / (a * a + b * b), 0, 1);
    const double edge = hypot(x + t * a, z - t * b);
    const bool inside = x * b + z * a < 0;

    return corner((inside ? -edge : edge) - n[3], fabs(p[1]) - n[2] / 2);
}

static struct bounds rhombus_box(const double *n)
{
    return bounds_centred(n[0] / 2 + n[3], n[2] / 2, n[1] / 2 + n[3]);
}

/* The square of the distance from p to the segment from a to b. */
static double segment_square(const double p[3], const double *a, const double *b)
{
    double w[3], e[3];

    for (int i = 0; i < 3; i++) {
        w[i] = p[i] - a[i];
        e[i] = b[i] - a[i];
    }
    const double t = clamp(dot(w, e) / fmax(dot(e, e), 1e-30), 0, 1);
    for (int i = 0; i < 3; i++) {
        w[i] -= t * e[i];
    }
    return dot(w, w);
}

/* The same to a triangle: its edges, and the foot a + s u + t v of p in its plane. That is kept
 * inside instead of being tested, so that it does no harm where the plane is unsure. */
static double triangle_square(const double p[3], const double *a, const double *b, const double *c)
{
    double w[3], u[3], v[3], across[3];

    for (int i = 0; i < 3; i++) {
        w[i] = p[i] - a[i];
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    const double uu = fmax(dot(u, u), 1e-30), uv = dot(u, v);
    for (int i = 0; i < 3; i++) {
        across[i] = v[i] - u[i] * uv / uu;
    }
    const double t = clamp(dot(w, across) / fmax(dot(across, across), 1e-30), 0, 1);
    const double s = clamp((dot(w, u) - t * uv) / uu, 0, 1 - t);
    for (int i = 0; i < 3; i++) {
        w[i] -= s * u[i] + t * v[i];
    }
    const double edges = fmin(segment_square(p, b, c), segment_square(p, c, a));
    return fmin(fmin(dot(w, w), segment_square(p, a, b)), edges);
}

/* The box of `count` points, three numbers each, with this much around them. */
static struct bounds points_box(const double *points, int count, double around)
{
    struct bounds box = bounds_empty();

    for (int i = 0; i < 3 * count; i++) {
        box.low[i % 3] = fmin(box.low[i % 3], points[i] - around);
        box.high[i % 3] = fmax(box.high[i % 3], points[i] + around);
    }
    return box;
}

static double triangle(const double p[3], const double *n)
{
    return sqrt(triangle_square(p, n, n + 3, n + 6)) - n[9];
}

static struct bounds triangle_box(const double *n)
{
    return points_box(n, 3, n[9]);
}

static double quad(const double p[3], const double *n)
{
    const double first = triangle_square(p, n, n + 3, n + 6);

    return sqrt(fmin(first, triangle_square(p, n, n + 6, n + 9))) - n[12];
}

static struct bounds quad_box(const double *n)
{
    return points_box(n, 4, n[12]);
}

const struct sdf sdf_solids[] = {
    {"hex_prism", .shape = hex_prism, .box = hex_prism_box},
    {"tri_prism", .shape = tri_prism, .box = tri_prism_box},
    {"octahedron", .shape = octahedron, .box = octahedron_box},
    {"tetrahedron", .shape = tetrahedron, .box = tetrahedron_box},
    {"dodecahedron", .shape = dodecahedron, .box = dodecahedron_box},
    {"icosahedron", .shape = icosahedron, .box = icosahedron_box},
    {"pyramid", .shape = pyramid, .box = pyramid_box},
    {"rhombus", .shape = rhombus, .box = rhombus_box},
    {"triangle", .shape = triangle, .box = triangle_box},
    {"quad", .shape = quad, .box = quad_box},
    {.type = NULL},
};
