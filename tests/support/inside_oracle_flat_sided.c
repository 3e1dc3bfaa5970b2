/* SPDX-License-Identifier: MIT */
/* What is inside of the shapes with flat sides, of fractals and of noise. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "inside_oracle.h"

#define PI 3.141592653589793
#define PHI 1.618033988749895

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static bool in_box(const double p[3], const double *n)
{
    return fabs(p[0]) < n[0] / 2 && fabs(p[1]) < n[1] / 2 && fabs(p[2]) < n[2] / 2;
}

static bool in_plane(const double p[3], const double *n)
{
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);

    return (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / length < n[3];
}

/* --- prisms and plates --- */

static bool in_prism(const double p[3], const double *n, int sides, double first)
{
    bool inside = fabs(p[2]) < n[1] / 2;

    for (int i = 0; i < sides; i++) {
        const double angle = first + 2 * PI * i / sides;
        inside = inside && p[0] * cos(angle) + p[1] * sin(angle) < n[0];
    }
    return inside;
}

static bool in_hex_prism(const double p[3], const double *n)
{
    return in_prism(p, n, 6, PI / 2);
}

static bool in_tri_prism(const double p[3], const double *n)
{
    return in_prism(p, n, 3, -PI / 2);
}

static bool in_pyramid(const double p[3], const double *n)
{
    const double half = n[0] / 2 * (1 - p[1] / n[1]);

    return p[1] > 0 && p[1] < n[1] && fabs(p[0]) < half && fabs(p[2]) < half;
}

static bool near_point(const double p[3], const double *a, double radius)
{
    double w[3];

    minus(p, a, w);
    return dot(w, w) < radius * radius;
}

/* Beside the segment from a to b, not beyond its ends. */
static bool beside_segment(const double p[3], const double *a, const double *b, double radius)
{
    double w[3], e[3], across[3];

    minus(p, a, w);
    minus(b, a, e);
    cross(w, e, across);
    return dot(w, e) > 0 && dot(w, e) < dot(e, e) &&
           dot(across, across) < radius * radius * dot(e, e);
}

static bool in_rhombus(const double p[3], const double *n)
{
    double q[3] = {fabs(p[0]), 0, fabs(p[2])}, a[3] = {n[0] / 2, 0, 0}, b[3] = {0, 0, n[1] / 2};
    const bool plan = q[0] / a[0] + q[2] / b[2] < 1 || near_point(q, a, n[3]) ||
                      near_point(q, b, n[3]) || beside_segment(q, a, b, n[3]);

    return plan && fabs(p[1]) < n[2] / 2;
}

/* Above or under the triangle. */
static bool beside_face(const double p[3], const double *const corners[3], double thickness)
{
    double u[3], v[3], normal[3], w[3], edge[3], outward[3];

    minus(corners[1], corners[0], u);
    minus(corners[2], corners[0], v);
    cross(u, v, normal);
    minus(p, corners[0], w);
    bool inside = fabs(dot(w, normal)) < thickness * sqrt(dot(normal, normal));
    for (int i = 0; i < 3; i++) {
        minus(corners[(i + 1) % 3], corners[i], edge);
        minus(p, corners[i], w);
        cross(edge, normal, outward);
        inside = inside && dot(w, outward) < 0;
    }
    return inside;
}

static bool near_triangle(const double p[3], const double *a, const double *b, const double *c,
                          double thickness)
{
    const double *corners[3] = {a, b, c};
    bool inside = beside_face(p, corners, thickness);

    for (int i = 0; i < 3; i++) {
        inside = inside || near_point(p, corners[i], thickness) ||
                 beside_segment(p, corners[i], corners[(i + 1) % 3], thickness);
    }
    return inside;
}

static bool in_triangle(const double p[3], const double *n)
{
    return near_triangle(p, n, n + 3, n + 6, n[9]);
}

static bool in_quad(const double p[3], const double *n)
{
    return near_triangle(p, n, n + 3, n + 6, n[12]) || near_triangle(p, n, n + 6, n + 9, n[12]);
}

/* --- regular solids: the hull of their corners --- */

struct hull {
    int corner_count, plane_count;
    double corners[20][3];
    double planes[256][4]; /* unit normal and offset; some are there several times */
};

/* The corner with these coordinates, and all others that have other signs and turn (x, y, z) to
 * (y, z, x). */
static void add_corners(struct hull *hull, double x, double y, double z)
{
    double at[3] = {x, y, z}, length = sqrt(x * x + y * y + z * z);

    for (int turn = 0; turn < (x == y && y == z ? 1 : 3); turn++) {
        for (int signs = 0; signs < 8; signs++) {
            double *corner = hull->corners[hull->corner_count];
            bool twice = false;
            for (int i = 0; i < 3; i++) {
                const double sign = signs >> i & 1 ? -1 : 1;
                corner[i] = sign * at[(i + turn) % 3] / length;
                twice = twice || (sign < 0 && corner[i] == 0);
            }
            hull->corner_count += !twice;
        }
    }
}

/* A plane through three corners with none beyond it is a face. */
static void add_plane(struct hull *hull, const double *a, const double *b, const double *c)
{
    double u[3], v[3], normal[3];

    minus(b, a, u);
    minus(c, a, v);
    cross(u, v, normal);
    const double length = sqrt(dot(normal, normal));
    if (length < 1e-9) {
        return;
    }
    double *plane = hull->planes[hull->plane_count];
    for (int i = 0; i < 3; i++) {
        plane[i] = normal[i] / length;
    }
    plane[3] = dot(plane, a);
    for (int i = 0; i < hull->corner_count; i++) {
        if (dot(plane, hull->corners[i]) > plane[3] + 1e-9) {
            return;
        }
    }
    hull->plane_count++;
}

static bool in_hull(struct hull *hull, const double p[3], double radius)
{
    if (hull->plane_count == 0) {
        const int count = hull->corner_count;
        for (int i = 0; i < count * count * count; i++) {
            const int a = i % count, b = i / count % count, c = i / count / count;
            if (a < b && a < c && b != c) { /* each turn once, in both senses */
                add_plane(hull, hull->corners[a], hull->corners[b], hull->corners[c]);
            }
        }
    }
    bool inside = true;
    for (int i = 0; i < hull->plane_count; i++) {
        inside = inside && dot(hull->planes[i], p) < hull->planes[i][3] * radius;
    }
    return inside;
}

static bool in_octahedron(const double p[3], const double *n)
{
    return fabs(p[0]) + fabs(p[1]) + fabs(p[2]) < n[0];
}

static bool in_tetrahedron(const double p[3], const double *n)
{
    static struct hull hull;
    static const double signs[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

    if (hull.corner_count == 0) {
        hull.corner_count = 4;
        for (int i = 0; i < 12; i++) {
            hull.corners[i / 3][i % 3] = signs[i / 3][i % 3] / sqrt(3);
        }
    }
    return in_hull(&hull, p, n[0]);
}

static bool in_dodecahedron(const double p[3], const double *n)
{
    static struct hull hull;

    if (hull.corner_count == 0) {
        add_corners(&hull, 0, 1 / PHI, PHI);
        add_corners(&hull, 1, 1, 1);
    }
    return in_hull(&hull, p, n[0]);
}

static bool in_icosahedron(const double p[3], const double *n)
{
    static struct hull hull;

    if (hull.corner_count == 0) {
        add_corners(&hull, 0, 1, PHI);
    }
    return in_hull(&hull, p, n[0]);
}

/* --- fractals, noise --- */

static bool in_gyroid(const double p[3], const double *n)
{
    const double k = 2 * PI / n[0], x = k * p[0], y = k * p[1], z = k * p[2];
    const double g = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);

    return in_box(p, n + 2) && fabs(g) / (sqrt(3) * k) < n[1] / 2;
}

/* Numbers between 0 and 1, to the base of three: nowhere have two of them the same digit 1 in the
 * same place. */
static bool in_menger(const double p[3], const double *n)
{
    double size[3] = {n[0], n[0], n[0]}, q[3];

    for (int i = 0; i < 3; i++) {
        q[i] = p[i] / n[0] + 0.5;
    }
    for (int level = 0; level < (int)n[1]; level++) {
        int middle = 0;
        for (int i = 0; i < 3; i++) {
            const double digit = floor(3 * q[i]);
            q[i] = 3 * q[i] - digit;
            middle += digit == 1;
        }
        if (middle > 1) {
            return false;
        }
    }
    return in_box(p, size);
}

/* The product of quaternions. */
static void multiply(const double a[4], const double b[4], double out[4])
{
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3];
    out[3] = a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1];
}

static double norm4(const double q[4])
{
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

/* Beyond the edge, where r^2 = r + |c|, orbits only grow. */
static bool in_julia(const double p[3], const double *n)
{
    double q[4] = {p[0], p[1], p[2], 0}, next[4], edge = 0.5 + sqrt(0.25 + norm4(n));

    for (int i = 0; i < (int)n[4] && norm4(q) < edge; i++) {
        multiply(q, q, next);
        for (int j = 0; j < 4; j++) {
            q[j] = next[j] + n[j];
        }
    }
    return norm4(q) < edge;
}

/* Beyond the edge, where r^power = 2 r, orbits only grow. */
static bool in_mandelbulb(const double p[3], const double *n)
{
    double z[3] = {p[0], p[1], p[2]}, edge = pow(2, 1 / (n[0] - 1)), r = sqrt(dot(z, z));

    for (int i = 0; i < (int)n[1] && r < edge; i++) {
        const double down = n[0] * atan2(hypot(z[0], z[2]), z[1]),
                     around = n[0] * atan2(z[0], z[2]);
        const double length = pow(r, n[0]);
        z[0] = length * sin(down) * sin(around) + p[0];
        z[1] = length * cos(down) + p[1];
        z[2] = length * sin(down) * cos(around) + p[2];
        r = sqrt(dot(z, z));
    }
    return r < edge;
}

/* A corner's height, from 0 to 1: it is the landscape, so it is the same numbers here. */
static double corner_height(double x, double z, uint32_t seed)
{
    uint32_t h = 0x9e3779b1u * (uint32_t)(int32_t)x + 0x85ebca77u * (uint32_t)(int32_t)z;

    h += 0xc2b2ae3du * seed;
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return (h >> 8) / (pow(2, 24) - 1);
}

/* The share of a corner that is `t` away, in cells. */
static double share(double t)
{
    return 1 - 3 * t * t + 2 * fabs(t * t * t);
}

static bool in_terrain(const double p[3], const double *n)
{
    double sum = 0, most = 0, x = p[0], z = p[2], cell = fmax(n[0], n[2]) / 4;

    for (int octave = 0; octave < (int)n[3]; octave++) {
        const double height = pow(0.5, octave), size = cell * height;
        const double u = x / size + 0.37 * (1 / height - 1), v = z / size + 0.61 * (1 / height - 1);
        for (int k = 0; k < 4; k++) {
            const double i = floor(u) + k % 2, j = floor(v) + k / 2;
            const uint32_t seed = (uint32_t)n[4] + 65536u * (uint32_t)octave;
            sum += height * share(u - i) * share(v - j) * corner_height(i, j, seed);
        }
        most += height;
    }
    return in_box(p, n) && p[1] < n[1] * (sum / most - 0.5);
}

const struct inside_oracle inside_oracle_flat_sided[] = {
    {"box", in_box},
    {"plane", in_plane},
    {"hex_prism", in_hex_prism},
    {"tri_prism", in_tri_prism},
    {"octahedron", in_octahedron},
    {"tetrahedron", in_tetrahedron},
    {"dodecahedron", in_dodecahedron},
    {"icosahedron", in_icosahedron},
    {"pyramid", in_pyramid},
    {"rhombus", in_rhombus},
    {"triangle", in_triangle},
    {"quad", in_quad},
    {"gyroid", in_gyroid},
    {"menger", in_menger},
    {"julia", in_julia},
    {"mandelbulb", in_mandelbulb},
    {"terrain", in_terrain},
    {.type = NULL},
};
