/* SPDX-License-Identifier: MIT */
/* Boxes around shapes and subtrees. Which box a node type has stands in its row (sdf.c). */
#include "bounds.h"

#include <math.h>

struct bounds bounds_empty(void)
{
    return (struct bounds){.low = {INFINITY, INFINITY, INFINITY},
                           .high = {-INFINITY, -INFINITY, -INFINITY},
                           .stretch = 1};
}

struct bounds bounds_infinite(void)
{
    return bounds_centred(INFINITY, INFINITY, INFINITY);
}

struct bounds bounds_centred(double x, double y, double z)
{
    return (struct bounds){.low = {-x, -y, -z}, .high = {x, y, z}, .stretch = 1};
}

bool bounds_is_empty(const struct bounds *box)
{
    return box->low[0] > box->high[0] || box->low[1] > box->high[1] || box->low[2] > box->high[2];
}

bool bounds_is_finite(const struct bounds *box)
{
    for (int i = 0; i < 3; i++) {
        if (!isfinite(box->low[i]) || !isfinite(box->high[i])) {
            return false;
        }
    }
    return true;
}

struct bounds bounds_union(struct bounds a, struct bounds b)
{
    for (int i = 0; i < 3; i++) {
        a.low[i] = fmin(a.low[i], b.low[i]);
        a.high[i] = fmax(a.high[i], b.high[i]);
    }
    a.stretch = fmax(a.stretch, b.stretch);
    return a;
}

struct bounds bounds_intersection(struct bounds a, struct bounds b)
{
    for (int i = 0; i < 3; i++) {
        double low = fmax(a.low[i], b.low[i]), high = fmin(a.high[i], b.high[i]);
        /* Apart on this axis: what grows there by and by lies around the gap. */
        a.low[i] = fmin(low, high);
        a.high[i] = fmax(low, high);
    }
    /* What both share after growing by delta reaches delta along each of these axes, thus the
     * square root of 3 times as far towards a corner, which is an axis once the box is turned. */
    a.stretch = fmax(a.stretch, b.stretch) * sqrt(3);
    return a;
}

struct bounds bounds_grow(struct bounds box, double delta)
{
    for (int i = 0; i < 3 && delta > 0; i++) {
        box.low[i] -= delta * box.stretch;
        box.high[i] += delta * box.stretch;
    }
    return box;
}

struct bounds bounds_transform(const struct bounds *box, const double matrix[12], double ratio)
{
    struct bounds out = {.stretch = box->stretch * ratio};

    for (int i = 0; i < 3; i++) {
        out.low[i] = out.high[i] = matrix[4 * i + 3];
        for (int j = 0; j < 3; j++) {
            const double m = matrix[4 * i + j];
            if (m != 0) { /* 0 * INFINITY is no number */
                out.low[i] += m * (m > 0 ? box->low[j] : box->high[j]);
                out.high[i] += m * (m > 0 ? box->high[j] : box->low[j]);
            }
        }
    }
    return out;
}

static double reach(const struct bounds *box, int axis)
{
    return fmax(fabs(box->low[axis]), fabs(box->high[axis]));
}

double bounds_radius_y(const struct bounds *box)
{
    return hypot(reach(box, 0), reach(box, 2));
}

double bounds_radius_z(const struct bounds *box)
{
    return hypot(reach(box, 0), reach(box, 1));
}

double bounds_sphere(const struct bounds *box, double out_centre[3])
{
    double square = 0;

    for (int i = 0; i < 3; i++) {
        const double half = (box->high[i] - box->low[i]) / 2;
        out_centre[i] = isfinite(half) ? box->low[i] + half : 0;
        square += half * half;
    }
    return isfinite(square) ? sqrt(square) : INFINITY;
}
