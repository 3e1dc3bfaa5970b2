/* SPDX-License-Identifier: MIT */
/* Fractions of polynomials with whole coefficients, in lowest terms, by FLINT. An operation that
 * fails tells ERROR_LIMIT or ERROR_INVALID; its result may be used and cleared all the same. One
 * thread. */
#ifndef RENDERER_ALGEBRA_FRACTION_H
#define RENDERER_ALGEBRA_FRACTION_H

#include <flint/fmpq.h>
#include <flint/fmpz_mpoly.h>
#include <stdbool.h>

#include "protocol/error.h"

struct fraction {
    fmpz_mpoly_t over, under; /* the denominator's first coefficient is positive */
};

void fraction_init(struct fraction *f, const fmpz_mpoly_ctx_t ring); /* 0 */
void fraction_clear(struct fraction *f, const fmpz_mpoly_ctx_t ring);
void fraction_set(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring);
void fraction_set_fmpq(struct fraction *out, const fmpq_t value, const fmpz_mpoly_ctx_t ring);
/* over / under for polynomials; the arguments may be those of `out`. */
bool fraction_set_quotient(struct fraction *out, const fmpz_mpoly_t over, const fmpz_mpoly_t under,
                           const fmpz_mpoly_ctx_t ring, struct error *err);
/* `out` may be an operand. */
bool fraction_add(struct fraction *out, const struct fraction *a, const struct fraction *b,
                  const fmpz_mpoly_ctx_t ring, struct error *err);
void fraction_negate(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring);
bool fraction_multiply(struct fraction *out, const struct fraction *a, const struct fraction *b,
                       const fmpz_mpoly_ctx_t ring, struct error *err);
bool fraction_invert(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring,
                     struct error *err);
bool fraction_power(struct fraction *out, const struct fraction *f, long exponent,
                    const fmpz_mpoly_ctx_t ring, struct error *err);

#endif
