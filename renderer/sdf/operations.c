/* SPDX-License-Identifier: MIT */
/* What combines the distances of several children. */
#include "tools.h"

static double combine_union(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b < a;
    return fmin(a, b);
}

static double combine_intersection(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b > a;
    return fmax(a, b);
}

static double combine_difference(double a, double b, const double *n, double *out_share)
{
    return combine_intersection(a, -b, n, out_share);
}

static void blend_prepare(double *n)
{
    n[0] = fmax(n[0], 1e-7);
}

static double combine_smooth_union(double a, double b, const double *n, double *out_share)
{
    double h = fmax(n[0] - fabs(a - b), 0) / n[0];
    *out_share = b < a ? 1 - h / 2 : h / 2;
    return fmin(a, b) - h * h * n[0] / 4;
}

static double combine_smooth_intersection(double a, double b, const double *n, double *out_share)
{
    return -combine_smooth_union(-a, -b, n, out_share);
}

static double combine_smooth_difference(double a, double b, const double *n, double *out_share)
{
    return -combine_smooth_union(-a, b, n, out_share);
}

/* One blend lowers by at most k/4; from the left fold x <- x + (k - x)^2 / (4k) never passes k. */
static double blend_lowered(const double *n, size_t count)
{
    return n[0] * fmin(1, (double)(count > 0 ? count - 1 : 0) / 4);
}

const struct sdf sdf_operations[] = {
    {"union", .combine = combine_union, .rule = SDF_ANY},
    {"intersection", .combine = combine_intersection, .rule = SDF_ALL},
    {"difference", .combine = combine_difference, .rule = SDF_FIRST},
    {"smooth_union", .prepare = blend_prepare, .combine = combine_smooth_union, .rule = SDF_ANY,
     .soft = true, .lowered = blend_lowered},
    {"smooth_intersection", .prepare = blend_prepare, .combine = combine_smooth_intersection,
     .rule = SDF_ALL, .soft = true},
    {"smooth_difference", .prepare = blend_prepare, .combine = combine_smooth_difference,
     .rule = SDF_FIRST, .soft = true},
    {"material", .combine = combine_union, .rule = SDF_ANY},
    {"group", .combine = combine_union, .rule = SDF_ANY},
    {.type = NULL},
};
