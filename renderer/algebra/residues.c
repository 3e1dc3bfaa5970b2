/* SPDX-License-Identifier: MIT */
/* Polynomials modulo a prime as dense tables. */
#include "residues.h"

#include <flint/ulong_extras.h>

static bool divides_any(mp_limb_t prime, const fmpz_mpoly_t parts[PATCH_PARTS],
                        const fmpz_mpoly_ctx_t ring)
{
    for (int i = 0; i < PATCH_PARTS; i++) {
        for (slong n = 0; n < fmpz_mpoly_length(parts[i], ring); n++) {
            if (fmpz_fdiv_ui(parts[i]->coeffs + n, prime) == 0) {
                return true;
            }
        }
    }
    return false;
}

mp_limb_t residues_next_prime(const fmpz_mpoly_t parts[PATCH_PARTS], const fmpz_mpoly_ctx_t ring,
                              mp_limb_t prime)
{
    do {
        prime = n_nextprime(prime, 0);
    } while (divides_any(prime, parts, ring));
    return prime;
}

static mp_limb_t *dense(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t ring, slong degree, nmod_t mod)
{
    mp_limb_t *table = flint_calloc((size_t)((degree + 1) * (degree + 1)), sizeof *table);
    fmpz_t coefficient;

    fmpz_init(coefficient);
    for (slong i = 0; i < fmpz_mpoly_length(f, ring); i++) {
        ulong powers[2];
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, f, i, ring);
        fmpz_mpoly_get_term_exp_ui(powers, f, i, ring);
        table[(slong)powers[0] * (degree + 1) + (slong)powers[1]] =
            fmpz_fdiv_ui(coefficient, mod.n);
    }
    fmpz_clear(coefficient);
    return table;
}

void residues_init(struct residues *out, const fmpz_mpoly_t parts[PATCH_PARTS],
                   const fmpz_mpoly_ctx_t ring, slong degree, mp_limb_t prime)
{
    nmod_init(&out->mod, prime);
    out->degree = degree;
    for (int i = 0; i < PATCH_PARTS; i++) {
        out->part[i] = dense(parts[i], ring, degree, out->mod);
    }
}

void residues_clear(struct residues *r)
{
    for (int i = 0; i < PATCH_PARTS; i++) {
        flint_free(r->part[i]);
    }
}

mp_limb_t residues_at(const struct residues *r, int part, mp_limb_t s, mp_limb_t t)
{
    const slong side = r->degree + 1;
    mp_limb_t value = 0;

    for (slong i = r->degree; i >= 0; i--) {
        mp_limb_t row = 0;
        for (slong j = r->degree - i; j >= 0; j--) {
            row = nmod_add(nmod_mul(row, t, r->mod), r->part[part][i * side + j], r->mod);
        }
        value = nmod_add(nmod_mul(value, s, r->mod), row, r->mod);
    }
    return value;
}

void residues_in_t(const struct residues *r, const mp_limb_t *part, mp_limb_t s, nmod_poly_t out)
{
    const slong side = r->degree + 1;

    nmod_poly_zero(out);
    for (slong j = 0; j <= r->degree; j++) {
        mp_limb_t value = 0;
        for (slong i = r->degree; i >= 0; i--) {
            value = nmod_add(nmod_mul(value, s, r->mod), part[i * side + j], r->mod);
        }
        nmod_poly_set_coeff_ui(out, j, value);
    }
}

void residues_random_point(const struct residues *r, flint_rand_t random,
                           mp_limb_t out[PATCH_PARTS])
{
    do {
        const mp_limb_t s = n_randint(random, r->mod.n), t = n_randint(random, r->mod.n);
        for (int i = 0; i < PATCH_PARTS; i++) {
            out[i] = residues_at(r, i, s, t);
        }
    } while (out[PATCH_W] == 0);
}
