/* SPDX-License-Identifier: MIT */
/* What is inside of the shapes with flat sides, of fractals and of noise. */
#include <math.h>
#include <stddef.h>

#include "predicates.h"

static bool in_box(const double p[3], const double *n)
{
    return fabs(p[0]) < n[0] / 2 && fabs(p[1]) < n[1] / 2 && fabs(p[2]) < n[2] / 2;
}

static bool in_plane(const double p[3], const double *n)
{
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / length < n[3];
}

const struct predicate predicates_flat_sided[] = {
    {"box", in_box},
    {"plane", in_plane},
    {.type = NULL},
};
