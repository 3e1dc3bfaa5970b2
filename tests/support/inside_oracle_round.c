/* SPDX-License-Identifier: MIT */
/* What is inside of the shapes that are round somewhere, and of frames. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "inside_oracle.h"

static double clamped(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

static bool in_sphere(const double p[3], const double *n)
{
    return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < n[0] * n[0];
}

static bool in_ellipsoid(const double p[3], const double *n)
{
    return pow(p[0] / n[0], 2) + pow(p[1] / n[1], 2) + pow(p[2] / n[2], 2) < 1;
}

/* Within the radius of a point of the box whose sides are the radius farther in. */
static bool in_round_box(const double p[3], const double *n)
{
    double radius = fmin(n[3], fmin(n[0], fmin(n[1], n[2])) / 2), sum = 0;

    for (int i = 0; i < 3; i++) {
        const double core = n[i] / 2 - radius;
        sum += pow(p[i] - clamped(p[i], -core, core), 2);
    }
    return sum <= radius * radius; /* may be 0 */
}

/* In the box, and as near to two of its sides as the bars are thick. */
static bool in_box_frame(const double p[3], const double *n)
{
    int near = 0;

    for (int i = 0; i < 3; i++) {
        const double depth = n[i] / 2 - fabs(p[i]);
        if (depth <= 0) {
            return false;
        }
        near += depth < n[3];
    }
    return near >= 2;
}

static bool in_torus(const double p[3], const double *n)
{
    const double ring = sqrt(p[0] * p[0] + p[2] * p[2]) - n[0];

    return ring * ring + p[1] * p[1] < n[1] * n[1];
}

/* Near the point of the arc at the nearest angle. */
static bool near_arc(double x, double y, double z, double radius, double angle, double reach)
{
    const double at = clamped(atan2(x, y), -angle, angle);
    const double dx = x - radius * sin(at), dy = y - radius * cos(at);

    return dx * dx + dy * dy + z * z < reach * reach;
}

static bool in_capped_torus(const double p[3], const double *n)
{
    return near_arc(p[0], p[1], p[2], n[0], n[2], n[1]);
}

/* Two half rings and two straight parts. */
static bool in_link(const double p[3], const double *n)
{
    const double y = fabs(p[1]), half = n[0] / 2, aside = fabs(p[0]) - n[1];
    const double straight = y - clamped(y, -half, half);

    return near_arc(p[0], y - half, p[2], n[1], acos(-1) / 2, n[2]) ||
           aside * aside + straight * straight + p[2] * p[2] < n[2] * n[2];
}

static bool in_cylinder(const double p[3], const double *n)
{
    return p[0] * p[0] + p[2] * p[2] < n[0] * n[0] && fabs(p[1]) < n[1] / 2;
}

/* Within the rounding of a point of the cylinder that is smaller by it. */
static bool in_round_cylinder(const double p[3], const double *n)
{
    const double rounding = fmin(n[2], fmin(n[0], n[1] / 2)), r = sqrt(p[0] * p[0] + p[2] * p[2]);
    const double half = n[1] / 2 - rounding;
    const double aside = r - clamped(r, 0, n[0] - rounding),
                 over = p[1] - clamped(p[1], -half, half);

    return aside * aside + over * over <= rounding * rounding; /* may be 0 */
}

/* In a ball around a point from a to b, whose radius changes evenly on the way. How deep the balls
 * hold the point is a convex function of the way, so its best is found by thirds. */
static bool in_balls(const double p[3], const double *a, const double *b, double radius1,
                     double radius2)
{
    double low = 0, high = 1;

    for (int i = 0; i < 60; i++) {
        double out[2];
        for (int k = 0; k < 2; k++) {
            double t = low + (high - low) * (1 + k) / 3, sum = 0;
            for (int j = 0; j < 3; j++) {
                sum += pow(p[j] - a[j] - t * (b[j] - a[j]), 2);
            }
            out[k] = sqrt(sum) - radius1 - t * (radius2 - radius1);
            if (out[k] < 0) {
                return true;
            }
        }
        *(out[0] < out[1] ? &high : &low) = low + (high - low) * (out[0] < out[1] ? 2 : 1) / 3;
    }
    return false;
}

static bool in_capsule(const double p[3], const double *n)
{
    return in_balls(p, n, n + 3, n[6], n[6]);
}

static bool in_round_cone(const double p[3], const double *n)
{
    return in_balls(p, (const double[3]){0, 0, 0}, (const double[3]){0, n[2], 0}, n[0], n[1]);
}

/* Nearer to the axis than the wall at its height. */
static bool in_cone_part(const double p[3], double radius1, double radius2, double height)
{
    const double t = p[1] / height + 0.5, wall = radius1 + t * (radius2 - radius1);

    return t > 0 && t < 1 && p[0] * p[0] + p[2] * p[2] < wall * wall;
}

static bool in_cone(const double p[3], const double *n)
{
    return in_cone_part(p, n[0], 0, n[1]);
}

static bool in_capped_cone(const double p[3], const double *n)
{
    return in_cone_part(p, n[0], n[1], n[2]);
}

static bool in_solid_angle(const double p[3], const double *n)
{
    return in_sphere(p, n) && atan2(sqrt(p[0] * p[0] + p[2] * p[2]), p[1]) < n[1];
}

static bool in_cut_sphere(const double p[3], const double *n)
{
    return in_sphere(p, n) && p[1] > n[1];
}

/* Its section is an arc around -Y. */
static bool in_cut_hollow_sphere(const double p[3], const double *n)
{
    const double angle = acos(clamped(-n[1] / n[0], -1, 1));

    return near_arc(sqrt(p[0] * p[0] + p[2] * p[2]), -p[1], 0, n[0], angle, n[2]);
}

static bool in_death_star(const double p[3], const double *n)
{
    double moved[3] = {p[0] - n[2], p[1], p[2]};

    return in_sphere(p, n) && !in_sphere(moved, n + 1);
}

const struct inside_oracle inside_oracle_round[] = {
    {"sphere", in_sphere},
    {"ellipsoid", in_ellipsoid},
    {"round_box", in_round_box},
    {"box_frame", in_box_frame},
    {"torus", in_torus},
    {"capped_torus", in_capped_torus},
    {"link", in_link},
    {"cylinder", in_cylinder},
    {"round_cylinder", in_round_cylinder},
    {"capsule", in_capsule},
    {"cone", in_cone},
    {"capped_cone", in_capped_cone},
    {"round_cone", in_round_cone},
    {"solid_angle", in_solid_angle},
    {"cut_sphere", in_cut_sphere},
    {"cut_hollow_sphere", in_cut_hollow_sphere},
    {"death_star", in_death_star},
    {.type = NULL},
};

const struct inside_oracle *inside_oracle_find(const char *type)
{
    static const struct inside_oracle *const tables[] = {inside_oracle_round,
                                                         inside_oracle_flat_sided};

    for (int i = 0; i < 2; i++) {
        for (const struct inside_oracle *row = tables[i]; row->type; row++) {
            if (strcmp(row->type, type) == 0) {
                return row;
            }
        }
    }
    return NULL;
}

bool inside_oracle_hollow(const char *type, const double *n)
{
    if (strcmp(type, "capped_cone") == 0 || strcmp(type, "round_cone") == 0) {
        return n[0] == 0 && n[1] == 0;
    }
    return (strcmp(type, "solid_angle") == 0 && n[1] == 0) ||
           (strcmp(type, "cut_sphere") == 0 && n[1] >= n[0]) ||
           (strcmp(type, "death_star") == 0 && n[1] >= n[0] + n[2]);
}
