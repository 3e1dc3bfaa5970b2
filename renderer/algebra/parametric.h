/* SPDX-License-Identifier: MIT */
/* A parametric surface as four polynomials: x = X/W, y = Y/W, z = Z/W in two parameters. The texts
 * are expressions of the language of equations in two of the letters s, t, u, v. A letter that
 * stands in sin, cos, tan alone becomes the tangent of half its angle, one that stands in exp,
 * sinh, cosh, tanh alone its exponential, so that both are rational. One thread. */
#ifndef RENDERER_ALGEBRA_PARAMETRIC_H
#define RENDERER_ALGEBRA_PARAMETRIC_H

#include <flint/fmpz_mpoly.h>
#include <stdbool.h>

#include "protocol/surface.h"

enum { PATCH_X, PATCH_Y, PATCH_Z, PATCH_W, PATCH_PARTS };

struct patch {
    fmpz_mpoly_ctx_t ring;
    fmpz_mpoly_t part[PATCH_PARTS]; /* without a common divisor */
    bool uses[SURFACE_LETTERS];     /* letters of the texts */
};

/* False: `err` names the text ("x", "y", "z" or ""), and where it can the place in it; nothing
 * has to be cleared. */
bool patch_read(struct patch *out, const char *const texts[3], struct error *err);
void patch_clear(struct patch *patch);
slong patch_degree(const struct patch *patch); /* the greatest total degree of a part */

#endif
