/* SPDX-License-Identifier: MIT */
/* Points of parametric surfaces, in double precision, from their expressions. Pure. */
#ifndef RENDERER_SURFACE_SAMPLE_H
#define RENDERER_SURFACE_SAMPLE_H

#include "protocol/equation.h"
#include "protocol/surface.h"

/* The two parameters, in the order of surface_names, then the letters of equation_letters. */
enum { SURFACE_SAMPLE_LETTERS = SURFACE_PARAMETERS + EQUATION_LETTERS };

struct surface_reading {
    struct equation *parts[SURFACE_PARTS];
    const char *letters[SURFACE_SAMPLE_LETTERS + 1]; /* NULL at the end */
    double low[SURFACE_PARAMETERS], high[SURFACE_PARAMETERS];
};

/* False: a part cannot be read, the one of the number `*out_part`, and `out_errors` says why.
 * Otherwise the caller finishes it. `surface` has all parts, and stays while this does. */
bool surface_reading_init(struct surface_reading *out, const struct surface *surface, int *out_part,
                          struct equation_errors *out_errors);
void surface_reading_finish(struct surface_reading *reading);

/* The point at two shares of the ranges, each from 0 to 1; not finite where an expression is not.
 * `letters` are the values of equation_letters; `room` is for LIMIT_EQUATION_NODES + 1 numbers. */
void surface_point(const struct surface_reading *reading, const double *letters, double s, double t,
                   double *room, double out[3]);
/* `count` by `count` of them, evenly, the second parameter faster. */
void surface_points(const struct surface_reading *reading, const double *letters, int count,
                    double *out);

#endif
