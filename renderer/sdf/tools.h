/* SPDX-License-Identifier: MIT */
/* What the files of distance functions share. Where a formula comes from stands in its registry
 * row; each GLSL function of the same name is the same formula. */
#ifndef RENDERER_TOOLS_H
#define RENDERER_TOOLS_H

#include <math.h>

#include "sdf.h"

static inline double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double length3(double x, double y, double z)
{
    return sqrt(x * x + y * y + z * z);
}

/* Distance to the intersection of two half-spaces at right angles whose distances are a and b. */
static inline double corner(double a, double b)
{
    return fmin(fmax(a, b), 0) + hypot(fmax(a, 0), fmax(b, 0));
}

/* The row `arc` of flat.c, after its `prepare`: x and y of the end on the side of +X, thickness. */
double flat_arc(const double p[3], const double *n);

#endif
