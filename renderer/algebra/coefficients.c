/* SPDX-License-Identifier: MIT */
/* Null spaces of matrices whose rows are the monomials at random points of the surface. */
#include "coefficients.h"

#include <flint/fmpq.h>

#include "protocol/limits.h"
#include "residues.h"

enum { SURPLUS_ROWS = 8, TRIES = 3 };

struct monomials {
    slong degree, count;
    ulong (*powers)[3];
};

struct lifting {
    struct monomials support;
    fmpz *residues; /* modulo `modulus`, where the first is 1 */
    fmpz_t modulus;
    fmpq *values, *before;
};

static void all_monomials(struct monomials *out, slong degree)
{
    const slong n = degree + 1;

    out->degree = degree;
    out->count = 0;
    out->powers = flint_calloc((size_t)(n * (n + 1) * (n + 2) / 6), sizeof *out->powers);
    for (slong i = 0; i <= degree; i++) {
        for (slong j = 0; i + j <= degree; j++) {
            for (slong k = 0; i + j + k <= degree; k++) {
                ulong *powers = out->powers[out->count++];
                powers[0] = (ulong)i, powers[1] = (ulong)j, powers[2] = (ulong)k;
            }
        }
    }
}

static void fill_row(mp_limb_t *row, const struct monomials *m, const mp_limb_t point[PATCH_PARTS],
                     nmod_t mod)
{
    mp_limb_t powers[3][LIMIT_IMPLICIT_DEGREE + 1];

    for (int k = 0; k < 3; k++) {
        const mp_limb_t value = nmod_div(point[k], point[PATCH_W], mod);
        powers[k][0] = 1;
        for (slong i = 1; i <= m->degree; i++) {
            powers[k][i] = nmod_mul(powers[k][i - 1], value, mod);
        }
    }
    for (slong i = 0; i < m->count; i++) {
        const ulong *p = m->powers[i];
        row[i] = nmod_mul(nmod_mul(powers[0][p[0]], powers[1][p[1]], mod), powers[2][p[2]], mod);
    }
}

/* The only vector that is 0 at all points, scaled so that its first entry that is not 0 is 1.
 * False: there is none, or more than one. */
static bool null_vector(const struct patch *patch, const struct monomials *m, mp_limb_t prime,
                        flint_rand_t random, mp_limb_t *out)
{
    struct residues r;
    nmod_mat_t matrix, kernel;

    residues_init(&r, patch->part, patch->ring, patch_degree(patch), prime);
    nmod_mat_init(matrix, m->count + SURPLUS_ROWS, m->count, prime);
    nmod_mat_init(kernel, m->count, m->count, prime);
    for (slong i = 0; i < m->count + SURPLUS_ROWS; i++) {
        mp_limb_t point[PATCH_PARTS];
        residues_random_point(&r, random, point);
        fill_row(matrix->rows[i], m, point, r.mod);
    }
    const bool one = nmod_mat_nullspace(kernel, matrix) == 1;
    slong first = 0;
    while (one && nmod_mat_entry(kernel, first, 0) == 0) {
        first++;
    }
    for (slong i = 0; one && i < m->count; i++) {
        out[i] = nmod_div(nmod_mat_entry(kernel, i, 0), nmod_mat_entry(kernel, first, 0), r.mod);
    }
    nmod_mat_clear(kernel);
    nmod_mat_clear(matrix);
    residues_clear(&r);
    return one;
}

/* Keeps the monomials that the equation has modulo this prime. */
static bool find_support(const struct patch *patch, slong degree, mp_limb_t prime,
                         flint_rand_t random, struct monomials *out)
{
    all_monomials(out, degree);
    mp_limb_t *vector = flint_calloc((size_t)out->count, sizeof *vector);
    const bool ok = null_vector(patch, out, prime, random, vector);
    slong kept = 0;
    for (slong i = 0; ok && i < out->count; i++) {
        if (vector[i] != 0) {
            memcpy(out->powers[kept++], out->powers[i], sizeof *out->powers);
        }
    }
    out->count = ok ? kept : out->count;
    flint_free(vector);
    return ok;
}

/* --- whole numbers --- */

static void lift(struct lifting *l, const mp_limb_t *vector, mp_limb_t prime)
{
    for (slong i = 0; i < l->support.count; i++) {
        fmpz_CRT_ui(&l->residues[i], &l->residues[i], l->modulus, vector[i], prime, 0);
    }
    fmpz_mul_ui(l->modulus, l->modulus, prime);
}

/* Rational numbers from the residues. True: they are those of the prime before. */
static bool rebuild(struct lifting *l)
{
    bool settled = true;
    fmpq *swap = l->values;

    l->values = l->before;
    l->before = swap;
    for (slong i = 0; i < l->support.count; i++) {
        const bool ok = fmpq_reconstruct_fmpz(&l->values[i], &l->residues[i], l->modulus);
        if (!ok) {
            fmpq_zero(&l->values[i]);
        }
        settled = settled && ok && fmpq_equal(&l->values[i], &l->before[i]);
    }
    return settled;
}

/* UNLUCKY: the equation has other monomials, which are 0 modulo the prime of the support. */
enum outcome { LIFTED, UNLUCKY, TOO_LONG };

static enum outcome lift_all(const struct patch *patch, struct lifting *l, flint_rand_t random,
                             const struct progress *progress, int *out_primes)
{
    mp_limb_t prime = UWORD(1) << 60;
    mp_limb_t *vector = flint_calloc((size_t)l->support.count, sizeof *vector);
    bool settled = false;
    int failed = 0;

    *out_primes = 0;
    while (!settled && failed < TRIES && fmpz_bits(l->modulus) <= 2 * LIMIT_COEFFICIENT_BITS) {
        prime = residues_next_prime(patch->part, patch->ring, prime);
        if (!null_vector(patch, &l->support, prime, random, vector)) {
            failed++;
        } else {
            lift(l, vector, prime);
            settled = rebuild(l);
            (*out_primes)++;
            progress_tell(progress, PROGRESS_PRIME, *out_primes, "prime %d: %ld bits", *out_primes,
                          (long)fmpz_bits(l->modulus));
        }
    }
    flint_free(vector);
    return settled ? LIFTED : failed == TRIES ? UNLUCKY : TOO_LONG;
}

/* Times the common denominator, without a common divisor. */
static void make_whole(const struct lifting *l, fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space)
{
    fmpz_t multiple, coefficient, content;

    fmpz_init(multiple), fmpz_init(coefficient), fmpz_init(content);
    fmpz_one(multiple);
    for (slong i = 0; i < l->support.count; i++) {
        fmpz_lcm(multiple, multiple, fmpq_denref(&l->values[i]));
    }
    for (slong i = 0; i < l->support.count; i++) {
        fmpz_divexact(coefficient, multiple, fmpq_denref(&l->values[i]));
        fmpz_mul(coefficient, coefficient, fmpq_numref(&l->values[i]));
        fmpz_gcd(content, content, coefficient);
        fmpz_mpoly_push_term_fmpz_ui(out, coefficient, l->support.powers[i], space);
    }
    fmpz_mpoly_sort_terms(out, space);
    fmpz_mpoly_get_term_coeff_fmpz(coefficient, out, 0, space);
    if (fmpz_sgn(coefficient) < 0) {
        fmpz_neg(content, content);
    }
    fmpz_mpoly_scalar_divexact_fmpz(out, out, content, space);
    fmpz_clear(multiple), fmpz_clear(coefficient), fmpz_clear(content);
}

static enum outcome lift_support(const struct patch *patch, struct lifting *l, flint_rand_t random,
                                 const struct progress *progress, fmpz_mpoly_t out,
                                 const fmpz_mpoly_ctx_t space, int *out_primes)
{
    const slong count = l->support.count, degree = l->support.degree;

    progress_tell(progress, PROGRESS_SUPPORT, count, "%ld of %ld monomials", count,
                  (degree + 1) * (degree + 2) * (degree + 3) / 6);
    l->residues = _fmpz_vec_init(count);
    l->values = _fmpq_vec_init(count);
    l->before = _fmpq_vec_init(count);
    fmpz_init_set_ui(l->modulus, 1);
    const enum outcome outcome = lift_all(patch, l, random, progress, out_primes);
    if (outcome == LIFTED) {
        make_whole(l, out, space);
    }
    fmpz_clear(l->modulus);
    _fmpz_vec_clear(l->residues, count);
    _fmpq_vec_clear(l->values, count);
    _fmpq_vec_clear(l->before, count);
    return outcome;
}

bool patch_find_equation(const struct patch *patch, slong degree, flint_rand_t random,
                         const struct progress *progress, fmpz_mpoly_t out,
                         const fmpz_mpoly_ctx_t space, int *out_primes, struct error *err)
{
    mp_limb_t prime = UWORD(1) << 29;
    enum outcome outcome = UNLUCKY;

    for (int i = 0; outcome == UNLUCKY && i < TRIES; i++) {
        struct lifting l = {0};
        prime = residues_next_prime(patch->part, patch->ring, prime);
        if (find_support(patch, degree, prime, random, &l.support)) {
            outcome = lift_support(patch, &l, random, progress, out, space, out_primes);
        }
        flint_free(l.support.powers);
    }
    if (outcome == TOO_LONG) {
        return error_set(err, ERROR_LIMIT, "", "coefficients of over %d bits (coefficient_bits)",
                         LIMIT_COEFFICIENT_BITS);
    }
    return outcome == LIFTED ||
           error_set(err, ERROR_INTERNAL, "", "no single equation of degree %ld", degree);
}
