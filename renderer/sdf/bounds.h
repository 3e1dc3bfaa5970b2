/* SPDX-License-Identifier: MIT */
/* Boxes around shapes and subtrees. Pure arithmetic; boxes may be empty or infinite on any side. */
#ifndef RENDERER_BOUNDS_H
#define RENDERER_BOUNDS_H

#include <stdbool.h>

struct bounds {
    double low[3], high[3]; /* low > high on any axis: nothing */
    /* How much faster than its field the shape may grow: every point whose field is at most
     * delta is no farther than stretch * delta from the box. 1 where distances are exact. */
    double stretch;
};

struct bounds bounds_empty(void);
struct bounds bounds_infinite(void);
/* The box with these half extents around the origin. */
struct bounds bounds_centred(double x, double y, double z);
bool bounds_is_empty(const struct bounds *box);
bool bounds_is_finite(const struct bounds *box);

struct bounds bounds_union(struct bounds a, struct bounds b);
/* Of boxes that are apart it is the gap between them, so that it may still be grown. */
struct bounds bounds_intersection(struct bounds a, struct bounds b);
/* The box after `delta` >= 0 is subtracted from the field. */
struct bounds bounds_grow(struct bounds box, double delta);
/* The box of the image under p -> matrix * p, three rows of (x, y, z, translation). `ratio` is
 * greatest by least scale of the matrix, by which the field lags behind the distance. */
struct bounds bounds_transform(const struct bounds *box, const double matrix[12], double ratio);
/* The greatest distance of the box from the Y or Z axis; INFINITY where there is none. */
double bounds_radius_y(const struct bounds *box);
double bounds_radius_z(const struct bounds *box);
/* The sphere around the box; its radius is INFINITY where the box is not finite. */
double bounds_sphere(const struct bounds *box, double out_centre[3]);

#endif
