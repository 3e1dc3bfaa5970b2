/* SPDX-License-Identifier: MIT */
/* The equation of a parametric surface by elimination: roads beside that of coefficients.h. What
 * comes out is proved by certificate.h too. One thread. */
#ifndef RENDERER_ALGEBRA_ELIMINATE_H
#define RENDERER_ALGEBRA_ELIMINATE_H

#include "groebner.h"
#include "parametric.h"
#include "progress.h"

/* The first element without parameters of a basis of <x - X, y - Y, z - Z, w - W>, where X, Y, Z, W
 * are made homogeneous of degree n by h, and s, t, h weigh 1 and x, y, z, w weigh n: the kernel of
 * a graded map. Its elements come degree by degree, so the first one is the equation. */
bool eliminate_homogeneous(const struct patch *patch, const struct progress *progress,
                           fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                           struct groebner_counts *out_counts, struct error *err);
/* <W x - X, W y - Y, W z - Z, 1 - W q>: the reduced basis in an order that eliminates q, s, t (Cox,
 * Little, O'Shea, 3.3, theorem 2). */
bool eliminate_saturated(const struct patch *patch, const struct progress *progress,
                         fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                         struct groebner_counts *out_counts, struct error *err);
/* The factor that vanishes on the surface of a resultant in t of two resultants in s. */
bool eliminate_resultant(const struct patch *patch, fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                         struct error *err);

#endif
