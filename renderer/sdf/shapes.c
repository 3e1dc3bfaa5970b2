/* SPDX-License-Identifier: MIT */
/* The primitives in three dimensions, but for fractals and noise (fractals.c). */
#include "tools.h"

static double sphere(const double p[3], const double *n)
{
    return length3(p[0], p[1], p[2]) - n[0];
}

static struct bounds sphere_box(const double *n)
{
    return bounds_centred(n[0], n[0], n[0]);
}

static double ellipsoid(const double p[3], const double *n)
{
    return (length3(p[0] / n[0], p[1] / n[1], p[2] / n[2]) - 1) * fmin(n[0], fmin(n[1], n[2]));
}

static struct bounds ellipsoid_box(const double *n)
{
    struct bounds box = bounds_centred(n[0], n[1], n[2]);
    box.stretch = fmax(n[0], fmax(n[1], n[2])) / fmin(n[0], fmin(n[1], n[2]));
    return box;
}

static double box(const double p[3], const double *n)
{
    double x = fabs(p[0]) - n[0] / 2, y = fabs(p[1]) - n[1] / 2, z = fabs(p[2]) - n[2] / 2;
    return length3(fmax(x, 0), fmax(y, 0), fmax(z, 0)) + fmin(fmax(x, fmax(y, z)), 0);
}

static struct bounds box_box(const double *n)
{
    return bounds_centred(n[0] / 2, n[1] / 2, n[2] / 2);
}

static void round_box_prepare(double *n)
{
    n[3] = fmin(n[3], fmin(n[0], fmin(n[1], n[2])) / 2);
}

static double round_box(const double p[3], const double *n)
{
    double core[3] = {n[0] - 2 * n[3], n[1] - 2 * n[3], n[2] - 2 * n[3]};
    return box(p, core) - n[3];
}

static double torus(const double p[3], const double *n)
{
    return hypot(hypot(p[0], p[2]) - n[0], p[1]) - n[1];
}

static struct bounds torus_box(const double *n)
{
    return bounds_centred(n[0] + n[1], n[1], n[0] + n[1]);
}

static double cylinder(const double p[3], const double *n)
{
    return corner(hypot(p[0], p[2]) - n[0], fabs(p[1]) - n[1] / 2);
}

static struct bounds cylinder_box(const double *n)
{
    return bounds_centred(n[0], n[1] / 2, n[0]);
}

static double capsule(const double p[3], const double *n)
{
    double pa[3], ba[3];
    for (int i = 0; i < 3; i++) {
        pa[i] = p[i] - n[i];
        ba[i] = n[3 + i] - n[i];
    }
    double t = clamp(dot(pa, ba) / fmax(dot(ba, ba), 1e-30), 0, 1);
    return length3(pa[0] - t * ba[0], pa[1] - t * ba[1], pa[2] - t * ba[2]) - n[6];
}

static struct bounds capsule_box(const double *n)
{
    struct bounds box = {.stretch = 1};
    for (int i = 0; i < 3; i++) {
        box.low[i] = fmin(n[i], n[3 + i]) - n[6];
        box.high[i] = fmax(n[i], n[3 + i]) + n[6];
    }
    return box;
}

/* In the half-plane (distance from the axis, height below the tip) the cone is a triangle: the
 * nearest point lies on its slope or on its base. */
static double cone(const double p[3], const double *n)
{
    double radius = n[0], height = n[1];
    double x = hypot(p[0], p[2]), y = height / 2 - p[1];
    double t = clamp((x * radius + y * height) / (radius * radius + height * height), 0, 1);
    double slope = hypot(x - t * radius, y - t * height);
    double base = hypot(x - fmin(x, radius), y - height);
    double outside = fmax(x * height - y * radius, y - height);
    return outside > 0 ? fmin(slope, base) : -fmin(slope, base);
}

static void plane_prepare(double *n)
{
    double length = length3(n[0], n[1], n[2]);
    for (int i = 0; i < 3; i++) {
        n[i] = length > 0 ? n[i] / length : i == 1;
    }
}

static double plane(const double p[3], const double *n)
{
    return dot(p, n) - n[3];
}

static struct bounds plane_box(const double *n)
{
    struct bounds box = bounds_infinite();
    for (int i = 0; i < 3; i++) {
        if (n[i] == 1) {
            box.high[i] = n[3];
        } else if (n[i] == -1) {
            box.low[i] = -n[3];
        }
    }
    return box;
}

const struct sdf sdf_shapes[] = {
    {"sphere", .shape = sphere, .box = sphere_box},
    {"ellipsoid", .shape = ellipsoid, .box = ellipsoid_box},
    {"box", .shape = box, .box = box_box},
    {"round_box", .prepare = round_box_prepare, .shape = round_box, .box = box_box},
    {"torus", .shape = torus, .box = torus_box},
    {"cylinder", .shape = cylinder, .box = cylinder_box},
    {"capsule", .shape = capsule, .box = capsule_box},
    {"cone", .shape = cone, .box = cylinder_box},
    {"plane", .prepare = plane_prepare, .shape = plane, .box = plane_box},
    {.type = NULL},
};
