/* SPDX-License-Identifier: MIT */
/* The equation of a parametric surface of known degree, by linear algebra: which monomials it has
 * modulo one prime, their coefficients modulo several, and from these the whole numbers by the
 * Chinese remainder theorem and rational reconstruction. What comes out is a guess until
 * certificate.h has proved it. One thread. */
#ifndef RENDERER_ALGEBRA_COEFFICIENTS_H
#define RENDERER_ALGEBRA_COEFFICIENTS_H

#include "parametric.h"
#include "progress.h"

/* `space` has the variables x, y, z; `out` is primitive, its first coefficient positive. */
bool patch_find_equation(const struct patch *patch, slong degree, flint_rand_t random,
                         const struct progress *progress, fmpz_mpoly_t out,
                         const fmpz_mpoly_ctx_t space, int *out_primes, struct error *err);

#endif
