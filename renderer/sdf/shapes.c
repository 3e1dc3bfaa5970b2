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

static double box(const double p[3], const double *n)
{
    const double x = fabs(p[0]) - n[0] / 2, y = fabs(p[1]) - n[1] / 2, z = fabs(p[2]) - n[2] / 2;

    return length3(fmax(x, 0), fmax(y, 0), fmax(z, 0)) + fmin(fmax(x, fmax(y, z)), 0);
}

static struct bounds box_box(const double *n)
{
    return bounds_centred(n[0] / 2, n[1] / 2, n[2] / 2);
}

/* How far the box around an ellipsoid stays away, so that surfaces get their normals from the other
 * bound alone, which is smooth. */
static double ellipsoid_margin(const double *n)
{
    return fmin(n[0], fmin(n[1], n[2])) / 16;
}

static double ellipsoid(const double p[3], const double *n)
{
    double size[3] = {2 * n[0], 2 * n[1], 2 * n[2]};
    const double ball = length3(p[0] / n[0], p[1] / n[1], p[2] / n[2]) - 1;

    return fmax(ball * fmin(n[0], fmin(n[1], n[2])), box(p, size) - ellipsoid_margin(n));
}

static struct bounds ellipsoid_box(const double *n)
{
    const double margin = ellipsoid_margin(n);

    return bounds_centred(n[0] + margin, n[1] + margin, n[2] + margin);
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

/* In each axis: how far from the bars along it, and from those along the other two. Inside, the
 * nearest points are on the sides, or on the edges of the openings through two pairs of sides. */
static double box_frame(const double p[3], const double *n)
{
    double along[3], across[3], open[3], outside = INFINITY, depth = INFINITY;

    for (int i = 0; i < 3; i++) {
        const double q = fabs(p[i]) - n[i] / 2;
        along[i] = fmax(q, 0);
        across[i] = fmax(fmax(q, -n[3] - q), 0);
        open[i] = n[i] / 2 > n[3] ? fmax(q + n[3], 0) : 1e9;
        depth = fmin(depth, -q);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        outside = fmin(outside, length3(along[i], across[j], across[k]));
        depth = fmin(depth, hypot(open[j], open[k]));
    }
    return outside > 0 ? outside : -depth;
}

/* To the discs around (radius, 0) and (-radius, 0), for x >= 0: where the nearest point of the
 * first lies beyond x = 0, it is where they meet. */
static double disc_pair(double x, double y, double radius, double tube)
{
    const double from = hypot(x - radius, y);

    if (radius * from < tube * (radius - x)) {
        return -hypot(x, fabs(y) - sqrt((tube - radius) * (tube + radius)));
    }
    return from - tube;
}

static double torus(const double p[3], const double *n)
{
    return disc_pair(hypot(p[0], p[2]), p[1], n[0], n[1]);
}

static struct bounds torus_box(const double *n)
{
    return bounds_centred(n[0] + n[1], n[1], n[0] + n[1]);
}

/* capped_torus: radius and angle become x and y of the end on the side of +X. */
static void capped_torus_prepare(double *n)
{
    const double radius = n[0], angle = n[2];

    n[0] = fmax(radius * sin(angle), 1e-12 * radius); /* never 0: the axis has a side */
    n[2] = radius * cos(angle);
}

/* What bounds it from inside, for x >= 0. The tube, `ring` from its middle, unless the nearest
 * point lies beyond the Z axis (along the arc) or x = 0 (at an end). Or the seams where a wide tube
 * meets itself: points of the Z axis, and of its two ends a circle in the plane x = 0, y < 0. */
static double capped_torus_depth(double x, double y, double z, const double *n, double ring,
                                 bool beyond)
{
    double tube = n[1], radius = hypot(n[0], n[2]), depth = INFINITY;
    const double middle = beyond ? n[0] : radius, from = beyond ? x : hypot(x, y);

    if (middle * ring + tube * (from - middle) >= 0) {
        depth = tube - ring;
    }
    if (tube > radius) {
        depth = fmin(depth, length3(x, y, fabs(z) - sqrt((tube - radius) * (tube + radius))));
    }
    if (tube > n[0]) {
        const double seam = sqrt((tube - n[0]) * (tube + n[0])), w = hypot(y - n[2], z);
        if (w > 0 ? n[2] * w + seam * (y - n[2]) < 0 : n[2] < seam) {
            depth = fmin(depth, hypot(x, w - seam));
        }
    }
    return depth;
}

static double capped_torus(const double p[3], const double *n)
{
    const double x = fabs(p[0]), y = p[1], z = p[2];
    const bool beyond = x * n[2] - y * n[0] > 0;
    double ring =
        beyond ? length3(x - n[0], y - n[2], z) : hypot(hypot(x, y) - hypot(n[0], n[2]), z);

    return ring < n[1] ? -capped_torus_depth(x, y, z, n, ring, beyond) : ring - n[1];
}

static struct bounds capped_torus_box(const double *n)
{
    const double radius = hypot(n[0], n[2]), side = (n[2] < 0 ? radius : n[0]) + n[1];

    return (struct bounds){
        .low = {-side, n[2] - n[1], -n[1]}, .high = {side, radius + n[1], n[1]}, .stretch = 1};
}

static double link(const double p[3], const double *n)
{
    return disc_pair(hypot(p[0], fmax(fabs(p[1]) - n[0] / 2, 0)), p[2], n[1], n[2]);
}

static struct bounds link_box(const double *n)
{
    return bounds_centred(n[1] + n[2], n[0] / 2 + n[1] + n[2], n[2]);
}

static double cylinder(const double p[3], const double *n)
{
    return corner(hypot(p[0], p[2]) - n[0], fabs(p[1]) - n[1] / 2);
}

static struct bounds cylinder_box(const double *n)
{
    return bounds_centred(n[0], n[1] / 2, n[0]);
}

static void round_cylinder_prepare(double *n)
{
    n[2] = fmin(n[2], fmin(n[0], n[1] / 2));
}

static double round_cylinder(const double p[3], const double *n)
{
    double core[2] = {n[0] - n[2], n[1] - 2 * n[2]};

    return cylinder(p, core) - n[2];
}

static double capsule(const double p[3], const double *n)
{
    double pa[3], ba[3];

    for (int i = 0; i < 3; i++) {
        pa[i] = p[i] - n[i];
        ba[i] = n[3 + i] - n[i];
    }
    const double t = clamp(dot(pa, ba) / fmax(dot(ba, ba), 1e-30), 0, 1);
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
    const double radius = n[0], height = n[1];
    const double x = hypot(p[0], p[2]), y = height / 2 - p[1];
    const double t = clamp((x * radius + y * height) / (radius * radius + height * height), 0, 1);
    const double slope = hypot(x - t * radius, y - t * height);
    const double base = hypot(x - fmin(x, radius), y - height);
    const double outside = fmax(x * height - y * radius, y - height);

    return outside > 0 ? fmin(slope, base) : -fmin(slope, base);
}

/* In the half-plane (distance from the axis, height) half of a trapezium: the nearest point lies on
 * its slanted side, or on top or bottom, whichever is on this side of the middle. */
static double capped_cone(const double p[3], const double *n)
{
    const double x = hypot(p[0], p[2]), half = n[2] / 2, over = fabs(p[1]) - half;
    const double wx = x - n[0], wy = p[1] + half, sx = n[1] - n[0], sy = n[2];
    const double t = clamp((wx * sx + wy * sy) / (sx * sx + sy * sy), 0, 1);
    double d =
        fmin(hypot(wx - t * sx, wy - t * sy), hypot(fmax(x - (p[1] < 0 ? n[0] : n[1]), 0), over));

    return over > 0 || wx * sy > wy * sx ? d : -d;
}

static struct bounds capped_cone_box(const double *n)
{
    const double side = fmax(n[0], n[1]);

    return bounds_centred(side, n[2] / 2, side);
}

/* The wall touches both balls at the angle whose sine is `tilt`, unless one holds the other. */
static double round_cone(const double p[3], const double *n)
{
    const double x = hypot(p[0], p[2]), y = p[1], tilt = (n[0] - n[1]) / n[2];
    const double level = sqrt(fmax((1 - tilt) * (1 + tilt), 0)), along = y * level - x * tilt;

    if (tilt >= 1 || (tilt > -1 && along < 0)) {
        return hypot(x, y) - n[0];
    }
    if (tilt <= -1 || along > level * n[2]) {
        return hypot(x, y - n[2]) - n[1];
    }
    return x * level + y * tilt - n[0];
}

static struct bounds round_cone_box(const double *n)
{
    const double side = fmax(n[0], n[1]);

    return (struct bounds){.low = {-side, fmin(-n[0], n[2] - n[1]), -side},
                           .high = {side, fmax(n[0], n[2] + n[1]), side},
                           .stretch = 1};
}

/* Radius and angle become the end of the section's straight side; an x of 0 means a whole ball. */
static void solid_angle_prepare(double *n)
{
    const double radius = n[0], angle = n[1];
    const bool whole = angle > 3.14159;

    n[0] = whole ? 0 : fmax(radius * sin(angle), 1e-12 * radius);
    n[1] = whole ? -radius : radius * cos(angle);
}

static double solid_angle(const double p[3], const double *n)
{
    const double x = hypot(p[0], p[2]), y = p[1], radius = hypot(n[0], n[1]);
    const double t = clamp((x * n[0] + y * n[1]) / (radius * radius), 0, 1);
    const double ball = hypot(x, y) - radius, side = hypot(x - t * n[0], y - t * n[1]);

    if (n[0] == 0) {
        return ball;
    }
    return x * n[1] < y * n[0] ? fmax(ball, -side) : side;
}

static struct bounds solid_angle_box(const double *n)
{
    const double radius = hypot(n[0], n[1]), side = n[1] < 0 ? radius : n[0];

    return (struct bounds){
        .low = {-side, fmin(n[1], 0), -side}, .high = {side, radius, side}, .stretch = 1};
}

static void cut_sphere_prepare(double *n)
{
    n[1] = clamp(n[1], -n[0], n[0]);
}

/* The rim is nearest to what lies outside of it and below the cone from the centre through it. */
static double cut_sphere(const double p[3], const double *n)
{
    const double x = hypot(p[0], p[2]), y = p[1], rim = sqrt((n[0] - n[1]) * (n[0] + n[1]));

    if (x > rim && x * n[1] > y * rim) {
        return hypot(x - rim, y - n[1]);
    }
    return fmax(hypot(x, y) - n[0], n[1] - y);
}

static struct bounds cut_sphere_box(const double *n)
{
    const double side = n[1] > 0 ? sqrt((n[0] - n[1]) * (n[0] + n[1])) : n[0];

    return (struct bounds){.low = {-side, n[1], -side}, .high = {side, n[0], side}, .stretch = 1};
}

/* Radius and height become x and y of the rim. */
static void cut_hollow_sphere_prepare(double *n)
{
    const double radius = n[0], height = clamp(n[1], -radius, radius);

    n[0] = fmax(sqrt((radius - height) * (radius + height)), 1e-12 * radius);
    n[1] = height;
}

static double cut_hollow_sphere(const double p[3], const double *n)
{
    const double q[3] = {hypot(p[0], p[2]), -p[1], 0}, arc[3] = {n[0], -n[1], 2 * n[2]};

    return flat_arc(q, arc);
}

static struct bounds cut_hollow_sphere_box(const double *n)
{
    const double radius = hypot(n[0], n[1]), side = (n[1] > 0 ? radius : n[0]) + n[2];

    return (struct bounds){
        .low = {-side, -radius - n[2], -side}, .high = {side, n[1] + n[2], side}, .stretch = 1};
}

static void death_star_prepare(double *n)
{
    n[1] = fmin(n[1], n[0] + n[2]);
}

/* Where the balls' surfaces meet: at x = *out_x, or beyond the first ball where they do not. What a
 * limited radius leaves is a point also after its numbers were rounded. */
static void death_star_rim(const double *n, double *out_x, double *out_r)
{
    *out_x = n[2] > 0 ? (n[2] + (n[0] - n[1]) * (n[0] + n[1]) / n[2]) / 2 : INFINITY;
    *out_r = n[1] < 0.999999 * (n[0] + n[2]) ? sqrt(fmax((n[0] - *out_x) * (n[0] + *out_x), 0)) : 0;
}

/* The rim is nearest where the ways from both centres lead to points that are not there: on the
 * first ball within the second, and on the second outside of the first. */
static double death_star(const double p[3], const double *n)
{
    double x = p[0], y = hypot(p[1], p[2]), rim_x, rim_r;

    death_star_rim(n, &rim_x, &rim_r);
    if (x * rim_r > y * rim_x && (x - n[2]) * rim_r > y * (rim_x - n[2])) {
        return hypot(x - rim_x, y - rim_r);
    }
    return fmax(hypot(x, y) - n[0], n[1] - hypot(x - n[2], y));
}

static struct bounds death_star_box(const double *n)
{
    double rim_x, rim_r;

    death_star_rim(n, &rim_x, &rim_r);
    const double side = rim_x < 0 ? rim_r : n[0];
    return (struct bounds){
        .low = {-n[0], -side, -side}, .high = {fmin(rim_x, n[0]), side, side}, .stretch = 1};
}

static void plane_prepare(double *n)
{
    const double length = length3(n[0], n[1], n[2]);

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
    {"box_frame", .shape = box_frame, .box = box_box},
    {"capped_torus", .prepare = capped_torus_prepare, .shape = capped_torus,
     .box = capped_torus_box},
    {"link", .shape = link, .box = link_box},
    {"round_cylinder", .prepare = round_cylinder_prepare, .shape = round_cylinder,
     .box = cylinder_box},
    {"capped_cone", .shape = capped_cone, .box = capped_cone_box},
    {"round_cone", .shape = round_cone, .box = round_cone_box},
    {"solid_angle", .prepare = solid_angle_prepare, .shape = solid_angle, .box = solid_angle_box},
    {"cut_sphere", .prepare = cut_sphere_prepare, .shape = cut_sphere, .box = cut_sphere_box},
    {"cut_hollow_sphere", .prepare = cut_hollow_sphere_prepare, .shape = cut_hollow_sphere,
     .box = cut_hollow_sphere_box},
    {"death_star", .prepare = death_star_prepare, .shape = death_star, .box = death_star_box},
    {.type = NULL},
};
