/* SPDX-License-Identifier: MIT */
/* f(X/W, Y/W, Z/W) W^d by Horner's rule in X and in Y. */
#include "certificate.h"

#include <flint/fmpz_mpoly_factor.h>
#include <stdlib.h>

#include "protocol/limits.h"

enum { SIDE = LIMIT_IMPLICIT_DEGREE + 1 };

struct substitution {
    const struct patch *patch;
    slong degree;
    fmpz_mpoly_t z[SIDE], w[SIDE];  /* powers of Z and W */
    fmpz_mpoly_t inner[SIDE][SIDE]; /* of X^i Y^j: its sum of c Z^k W^(d - i - j - k) */
};

static void substitution_init(struct substitution *s)
{
    const struct patch *patch = s->patch;

    for (slong i = 0; i <= s->degree; i++) {
        fmpz_mpoly_init(s->z[i], patch->ring);
        fmpz_mpoly_init(s->w[i], patch->ring);
        if (i == 0) {
            fmpz_mpoly_one(s->z[0], patch->ring);
            fmpz_mpoly_one(s->w[0], patch->ring);
        } else {
            fmpz_mpoly_mul(s->z[i], s->z[i - 1], patch->part[PATCH_Z], patch->ring);
            fmpz_mpoly_mul(s->w[i], s->w[i - 1], patch->part[PATCH_W], patch->ring);
        }
        for (slong j = 0; i + j <= s->degree; j++) {
            fmpz_mpoly_init(s->inner[i][j], patch->ring);
        }
    }
}

static void substitution_clear(struct substitution *s)
{
    for (slong i = 0; i <= s->degree; i++) {
        fmpz_mpoly_clear(s->z[i], s->patch->ring);
        fmpz_mpoly_clear(s->w[i], s->patch->ring);
        for (slong j = 0; i + j <= s->degree; j++) {
            fmpz_mpoly_clear(s->inner[i][j], s->patch->ring);
        }
    }
}

static void sum_terms(struct substitution *s, const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t space)
{
    const fmpz_mpoly_ctx_struct *ring = s->patch->ring;
    fmpz_mpoly_t term;
    fmpz_t coefficient;

    fmpz_mpoly_init(term, ring);
    fmpz_init(coefficient);
    for (slong n = 0; n < fmpz_mpoly_length(f, space); n++) {
        ulong p[3];
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, f, n, space);
        fmpz_mpoly_get_term_exp_ui(p, f, n, space);
        fmpz_mpoly_mul(term, s->z[p[2]], s->w[s->degree - (slong)(p[0] + p[1] + p[2])], ring);
        fmpz_mpoly_scalar_mul_fmpz(term, term, coefficient, ring);
        fmpz_mpoly_add(s->inner[p[0]][p[1]], s->inner[p[0]][p[1]], term, ring);
    }
    fmpz_clear(coefficient);
    fmpz_mpoly_clear(term, ring);
}

bool certificate_is_zero(const struct patch *patch, const fmpz_mpoly_t f,
                         const fmpz_mpoly_ctx_t space)
{
    struct substitution *s = calloc(1, sizeof *s);
    fmpz_mpoly_t sum, row;

    if (!s) {
        return false;
    }
    s->patch = patch;
    s->degree = fmpz_mpoly_total_degree_si(f, space);
    substitution_init(s);
    sum_terms(s, f, space);
    fmpz_mpoly_init(sum, patch->ring);
    fmpz_mpoly_init(row, patch->ring);
    for (slong i = s->degree; i >= 0; i--) {
        fmpz_mpoly_zero(row, patch->ring);
        for (slong j = s->degree - i; j >= 0; j--) {
            fmpz_mpoly_mul(row, row, patch->part[PATCH_Y], patch->ring);
            fmpz_mpoly_add(row, row, s->inner[i][j], patch->ring);
        }
        fmpz_mpoly_mul(sum, sum, patch->part[PATCH_X], patch->ring);
        fmpz_mpoly_add(sum, sum, row, patch->ring);
    }
    const bool zero = fmpz_mpoly_is_zero(sum, patch->ring);
    fmpz_mpoly_clear(sum, patch->ring);
    fmpz_mpoly_clear(row, patch->ring);
    substitution_clear(s);
    free(s);
    return zero;
}

bool certificate_is_irreducible(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t space)
{
    fmpz_mpoly_factor_t factors;

    fmpz_mpoly_factor_init(factors, space);
    const bool one = fmpz_mpoly_factor(factors, f, space) &&
                     fmpz_mpoly_factor_length(factors, space) == 1 && fmpz_is_one(&factors->exp[0]);
    fmpz_mpoly_factor_clear(factors, space);
    return one;
}
