/* SPDX-License-Identifier: MIT */
/* Fractions: sums and products of numerators and denominators, then their common divisor. */
#include "fraction.h"

#include <stdlib.h>

#include "protocol/limits.h"

void fraction_init(struct fraction *f, const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_init(f->over, ring);
    fmpz_mpoly_init(f->under, ring);
    fmpz_mpoly_one(f->under, ring);
}

void fraction_clear(struct fraction *f, const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_clear(f->over, ring);
    fmpz_mpoly_clear(f->under, ring);
}

void fraction_set(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_set(out->over, f->over, ring);
    fmpz_mpoly_set(out->under, f->under, ring);
}

void fraction_set_fmpq(struct fraction *out, const fmpq_t value, const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_set_fmpz(out->over, fmpq_numref(value), ring);
    fmpz_mpoly_set_fmpz(out->under, fmpq_denref(value), ring);
}

static bool check_limits(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t ring, struct error *err)
{
    const slong degree = fmpz_mpoly_total_degree_si(f, ring);
    const slong bits = labs(fmpz_mpoly_max_bits(f));

    if (degree > LIMIT_PARAMETRIC_DEGREE) {
        return error_set(err, ERROR_LIMIT, "",
                         "a polynomial of degree %ld; the limit is %d (parametric_degree)", degree,
                         LIMIT_PARAMETRIC_DEGREE);
    }
    return bits <= LIMIT_COEFFICIENT_BITS ||
           error_set(err, ERROR_LIMIT, "",
                     "a coefficient of %ld bits; the limit is %d (coefficient_bits)", bits,
                     LIMIT_COEFFICIENT_BITS);
}

/* Before the product is made: it would be of this degree. */
static bool check_product(const fmpz_mpoly_t a, const fmpz_mpoly_t b, const fmpz_mpoly_ctx_t ring,
                          struct error *err)
{
    const slong degree = fmpz_mpoly_total_degree_si(a, ring) + fmpz_mpoly_total_degree_si(b, ring);

    return degree <= 2 * LIMIT_PARAMETRIC_DEGREE ||
           error_set(err, ERROR_LIMIT, "",
                     "a polynomial of degree %ld; the limit is %d (parametric_degree)", degree,
                     LIMIT_PARAMETRIC_DEGREE);
}

static bool reduce(struct fraction *f, const fmpz_mpoly_ctx_t ring, struct error *err)
{
    fmpz_mpoly_t divisor;
    fmpz_t first;

    fmpz_mpoly_init(divisor, ring);
    fmpz_init(first);
    const bool ok = fmpz_mpoly_gcd(divisor, f->over, f->under, ring) ||
                    error_set(err, ERROR_LIMIT, "", "a common divisor cannot be found");
    if (ok) {
        fmpz_mpoly_divides(f->over, f->over, divisor, ring);
        fmpz_mpoly_divides(f->under, f->under, divisor, ring);
        fmpz_mpoly_get_term_coeff_fmpz(first, f->under, 0, ring);
        if (fmpz_sgn(first) < 0) {
            fmpz_mpoly_neg(f->over, f->over, ring);
            fmpz_mpoly_neg(f->under, f->under, ring);
        }
    }
    fmpz_clear(first);
    fmpz_mpoly_clear(divisor, ring);
    return ok && check_limits(f->over, ring, err) && check_limits(f->under, ring, err);
}

bool fraction_set_quotient(struct fraction *out, const fmpz_mpoly_t over, const fmpz_mpoly_t under,
                           const fmpz_mpoly_ctx_t ring, struct error *err)
{
    if (fmpz_mpoly_is_zero(under, ring)) {
        return error_set(err, ERROR_INVALID, "", "a denominator is 0 everywhere");
    }
    fmpz_mpoly_set(out->over, over, ring);
    fmpz_mpoly_set(out->under, under, ring);
    return reduce(out, ring, err);
}

bool fraction_add(struct fraction *out, const struct fraction *a, const struct fraction *b,
                  const fmpz_mpoly_ctx_t ring, struct error *err)
{
    fmpz_mpoly_t left, right;

    if (!check_product(a->over, b->under, ring, err) ||
        !check_product(b->over, a->under, ring, err) ||
        !check_product(a->under, b->under, ring, err)) {
        return false;
    }
    fmpz_mpoly_init(left, ring);
    fmpz_mpoly_init(right, ring);
    fmpz_mpoly_mul(left, a->over, b->under, ring);
    fmpz_mpoly_mul(right, b->over, a->under, ring);
    fmpz_mpoly_mul(out->under, a->under, b->under, ring);
    fmpz_mpoly_add(out->over, left, right, ring);
    fmpz_mpoly_clear(left, ring);
    fmpz_mpoly_clear(right, ring);
    return reduce(out, ring, err);
}

void fraction_negate(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_neg(out->over, f->over, ring);
    fmpz_mpoly_set(out->under, f->under, ring);
}

bool fraction_multiply(struct fraction *out, const struct fraction *a, const struct fraction *b,
                       const fmpz_mpoly_ctx_t ring, struct error *err)
{
    if (!check_product(a->over, b->over, ring, err) ||
        !check_product(a->under, b->under, ring, err)) {
        return false;
    }
    fmpz_mpoly_mul(out->over, a->over, b->over, ring);
    fmpz_mpoly_mul(out->under, a->under, b->under, ring);
    return reduce(out, ring, err);
}

bool fraction_invert(struct fraction *out, const struct fraction *f, const fmpz_mpoly_ctx_t ring,
                     struct error *err)
{
    fmpz_mpoly_t over;

    fmpz_mpoly_init(over, ring);
    fmpz_mpoly_set(over, f->over, ring);
    const bool ok = fraction_set_quotient(out, f->under, over, ring, err);
    fmpz_mpoly_clear(over, ring);
    return ok;
}

bool fraction_power(struct fraction *out, const struct fraction *f, long exponent,
                    const fmpz_mpoly_ctx_t ring, struct error *err)
{
    struct fraction base;
    fmpq_t one;

    fraction_init(&base, ring);
    fmpq_init(one);
    fmpq_one(one);
    bool ok = exponent >= 0 || fraction_invert(&base, f, ring, err);
    if (exponent >= 0) {
        fraction_set(&base, f, ring);
    }
    fraction_set_fmpq(out, one, ring);
    for (long i = 0; ok && i < labs(exponent); i++) {
        ok = fraction_multiply(out, out, &base, ring, err);
    }
    fmpq_clear(one);
    fraction_clear(&base, ring);
    return ok;
}
