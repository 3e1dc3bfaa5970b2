/* SPDX-License-Identifier: MIT */
/* The proof that f = 0 is the equation of a parametric surface: f(X/W, Y/W, Z/W) W^d is 0 over the
 * whole numbers, f is irreducible over the rationals, and the image is a surface. The elimination
 * ideal is prime and of height 1, so f generates it. One thread. */
#ifndef RENDERER_ALGEBRA_CERTIFICATE_H
#define RENDERER_ALGEBRA_CERTIFICATE_H

#include "parametric.h"

bool certificate_is_zero(const struct patch *patch, const fmpz_mpoly_t f,
                         const fmpz_mpoly_ctx_t space);
/* Over the rationals: a whole factor does not count. */
bool certificate_is_irreducible(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t space);

#endif
