/* SPDX-License-Identifier: MIT */
/* Surfaces by polynomials in x, y and z, whose coefficients are numbers of the field.
 *
 * Around a point p the polynomial is the sum of its orders P_n. The norm b_n of P_n by Bombieri
 * bounds it, |P_n(h)| <= b_n |h|^n, in whatever direction h goes, and b_1 is the length of the
 * gradient (Beauzamy, Bombieri, Enflo, Montgomery, Products of polynomials in many variables,
 * Journal of Number Theory 36, 1990). So f changes by at most B(r) = b_1 r + b_2 r^2 + ... on a way
 * r, and the root of B(r) = |f| is a lower bound of the distance. As the norms are those of
 * symmetric tensors, the bound itself changes by no more than the way.
 *
 * The orders up to the third are computed at the point, by Horner's rule for series cut there. Of
 * the others it is known that within a radius R of the origin b_n is at most the sum of C(m, n)
 * B_m R^(m - n), where B_m are the norms of the polynomial's own orders: numbers of the field. Up
 * to degree 9 rays take hardly more steps by this than with all orders, at degree 12 a third more.
 *
 * It is asked within the clip alone, at the point of the clip that is nearest. What is in the clip
 * lies beyond that point, at a right angle or more, so outside both ways together, as the sides of
 * a right angle, are no longer than the distance.
 *
 * Coordinates are parts of the clip's extent: all are at most 1, so no power is large, and floats
 * have digits enough. Double precision here; glsl/polynomial.glsl is the same in floats. */
#ifndef RENDERER_SDF_POLYNOMIAL_H
#define RENDERER_SDF_POLYNOMIAL_H

#include "sdf.h"

/* The numbers, four in each row:
 *     half of the box, extent of the clip
 *     radius of the ball (0: a box), thickness / extent (-1: solid), degree, rows for the rest
 *     POLYNOMIAL_ESTIMATE, longest step / extent, grain / extent, rows of coefficients
 *     the rest: C(m, 4) B_m, the highest m first, behind zeros
 *     for each power of x and of y, the highest first: (enum polynomial_end, c, c, c), ...:
 *     coefficients of powers of z, behind zeros
 *     from POLYNOMIAL_FINE on: as many rows again, what floats lack of the coefficients.
 * The rows are read in one loop: some drivers count the rounds of all loops.
 *
 * From degree POLYNOMIAL_FINE on the terms cancel by so much that floats draw other surfaces. Next
 * to the surface the value is then computed anew, with what each operation loses, as in twice the
 * digits (Graillat, Langlois, Louvet, Compensated Horner scheme, 2005). */
enum {
    POLYNOMIAL_HEAD = 3,
    POLYNOMIAL_FINE = 16,
    POLYNOMIAL_DEGREE_MAX = 18,
    POLYNOMIAL_COEFFICIENTS_MAX = 1330
};

/* Behind a row: the next goes on with the same power of y, has another one, or one of x. */
enum polynomial_end { POLYNOMIAL_GOES_ON, POLYNOMIAL_ENDS_Y, POLYNOMIAL_ENDS_X };

/* An estimate of the distance, where that is more than the bound, is Laguerre's step along the
 * gradient (Press et al., Numerical Recipes, 9.5), which is right next to the surface and where all
 * roots seem to be one. It is at most this part of the extent more, and less by the way to the
 * clip. */
#define POLYNOMIAL_ESTIMATE 0.5

/* A polynomial whose square is to be 0 is drawn as a sheet of this thickness, a part of the extent:
 * a hundredth of a pixel's width in small pictures, by which rays may step too far. */
#define POLYNOMIAL_THIN 4e-4

/* Of terms that have at most this degree: rows of numbers. */
size_t polynomial_rows(int degree);
int polynomial_rest_rows(int degree);
/* Loop iterations of one evaluation in GLSL, with `count` rows of coefficients. */
int polynomial_trips(int degree, int count);

/* The first of the numbers of degree d that have i powers of x and j of y. */
static inline size_t polynomial_at(int d, int i, int j)
{
    const int e = d - i;
    return (size_t)((d + 1) * (d + 2) * (d + 3) / 6 - (e + 1) * (e + 2) * (e + 3) / 6 +
                    j * (e + 1) - j * (j - 1) / 2);
}

/* Writes what stands behind the head; `c` in the order of polynomial_at, the largest of them 1.
 * Returns the number of rows of coefficients. */
int polynomial_write(int degree, const double *c, double *out);

/* The row of such shapes; its numbers begin behind SDF_CUT_NUMBERS. */
extern const struct sdf sdf_polynomial;
double polynomial_distance(const double p[3], const double *n);

#endif
