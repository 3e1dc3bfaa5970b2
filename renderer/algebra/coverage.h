/* SPDX-License-Identifier: MIT */
/* How much of an implicit surface is the patch that its equation was found for. Random lines, even
 * over all directions and places, meet the surface in points that are even over its area. A point
 * is covered where parameters in the ranges lead to it, within COVERAGE_NEAR of the clip: they are
 * sought by damped Newton steps (Levenberg, 1944; Marquardt, 1963) from each sample of the patch
 * that is nearer to the point than those around it. In double precision: a measurement, no proof.
 * The same result each time. One thread. */
#ifndef RENDERER_ALGEBRA_COVERAGE_H
#define RENDERER_ALGEBRA_COVERAGE_H

#include <cjson/cJSON.h>
#include <flint/fmpz_mpoly.h>

#include "protocol/surface.h"
#include "renderer/code/equation_pole.h"

#define COVERAGE_NEAR 1e-3 /* of the greatest half length */

struct coverage {
    int points, covered;
};

/* `f` is in x, y, z and of degree LIMIT_IMPLICIT_DEGREE at most; the expressions of `surface` can
 * be read and stand in the letters that have ranges. */
void coverage_measure(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t space,
                      const struct surface *surface, const struct equation_clip *clip,
                      struct coverage *out);
/* A box about the origin around the patch, a little larger: its full lengths. */
void coverage_size(const struct surface *surface, double out[3]);
/* {"points", "covered", "share", "text"}; without points no share. */
cJSON *coverage_answer(const struct coverage *coverage);

#endif
