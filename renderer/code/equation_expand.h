/* SPDX-License-Identifier: MIT */
/* Equations that are polynomials in x, y and z, as coefficients. Letters may stand in these. */
#ifndef RENDERER_EQUATION_EXPAND_H
#define RENDERER_EQUATION_EXPAND_H

#include "protocol/equation.h"

/* The degree that the equation's form allows, whatever its letters are; -1: it is no polynomial, or
 * of a degree above LIMIT_POLYNOMIAL_DEGREE. */
int equation_degree(const struct equation *equation);

/* An even power that is to be 0, or at most 0, has no sign which tells where it is: its base is put
 * in its place. True then. */
bool equation_take_root(struct equation *equation);

/* The coefficients of left - right, or what is negative inside, in parts x / extent of x, y and z:
 * for each power of x, then y, then z, from 0. The largest is 1 or -1, unless all are 0. In double
 * precision: coefficients are kept as floats in the end, whose error is a thousand times that of
 * expanding, and rational numbers would not know sqrt(5). */
void equation_expand(const struct equation *equation, const double *letters, double extent,
                     int degree, double *out);

#endif
