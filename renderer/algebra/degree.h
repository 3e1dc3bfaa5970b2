/* SPDX-License-Identifier: MIT */
/* What a parametric surface is before its equation is known: its dimension and its degree, by
 * random lines modulo a prime (Chen, Cox, Liu, "The mu-basis and implicitization of a rational
 * parametric surface", 2005, for the degree formula with base points). One thread. */
#ifndef RENDERER_ALGEBRA_DEGREE_H
#define RENDERER_ALGEBRA_DEGREE_H

#include "parametric.h"

struct patch_degrees {
    slong surface; /* of the equation */
    slong map;     /* parameters of a general point */
    slong base;    /* base points with their multiplicity */
};

/* False: the image is a curve or a point. */
bool patch_is_surface(const struct patch *patch, flint_rand_t random, struct error *err);
/* False: the image is a curve or a point, or its degree is over the limit. */
bool patch_find_degrees(const struct patch *patch, flint_rand_t random, struct patch_degrees *out,
                        struct error *err);

#endif
