/* SPDX-License-Identifier: MIT */
/* A parametric surface modulo a prime: its values, random points of it, lines that meet it. One
 * thread. */
#ifndef RENDERER_ALGEBRA_RESIDUES_H
#define RENDERER_ALGEBRA_RESIDUES_H

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>

#include "parametric.h"

struct residues {
    nmod_t mod;
    slong degree;                 /* total, of the greatest part */
    mp_limb_t *part[PATCH_PARTS]; /* of s^i t^j at [i (degree + 1) + j] */
};

/* The next prime that divides no coefficient of the parts. */
mp_limb_t residues_next_prime(const fmpz_mpoly_t parts[PATCH_PARTS], const fmpz_mpoly_ctx_t ring,
                              mp_limb_t prime);
void residues_init(struct residues *out, const fmpz_mpoly_t parts[PATCH_PARTS],
                   const fmpz_mpoly_ctx_t ring, slong degree, mp_limb_t prime);
void residues_clear(struct residues *r);
mp_limb_t residues_at(const struct residues *r, int part, mp_limb_t s, mp_limb_t t);
/* The part as a polynomial in t at a given s. */
void residues_in_t(const struct residues *r, const mp_limb_t *part, mp_limb_t s, nmod_poly_t out);
/* X, Y, Z, W at random parameters where W is not 0. */
void residues_random_point(const struct residues *r, flint_rand_t random,
                           mp_limb_t out[PATCH_PARTS]);

#endif
