/* SPDX-License-Identifier: MIT */
/* The equation of a node `implicit` as two polynomials in x, y, z with whole coefficients:
 * left - right = over / under, in lowest terms. One thread. */
#ifndef RENDERER_ALGEBRA_IMPLICIT_H
#define RENDERER_ALGEBRA_IMPLICIT_H

#include "fraction.h"
#include "protocol/record.h"

/* Into a fraction of a ring of three variables. False: `err` has the place in the text, if any. */
bool implicit_read(struct fraction *out, const struct record *params, const fmpz_mpoly_ctx_t space,
                   struct error *err);

#endif
