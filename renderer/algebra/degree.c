/* SPDX-License-Identifier: MIT */
/* Two planes meet in a line, and the line meets the surface `surface` times, each time at `map`
 * parameters; the resultant of the two planes counts these and the base points. Planes through a
 * point of the surface share its parameters, others the base points alone. */
#include "degree.h"

#include "protocol/limits.h"
#include "residues.h"

enum { TRIES = 5 };

/* --- the dimension --- */

static void derivatives(const struct patch *patch, slong variable, fmpz_mpoly_t out[PATCH_PARTS])
{
    for (int i = 0; i < PATCH_PARTS; i++) {
        fmpz_mpoly_init(out[i], patch->ring);
        fmpz_mpoly_derivative(out[i], patch->part[i], variable, patch->ring);
    }
}

/* Of (P; dP/ds; dP/dt) at random parameters. */
static slong rank_at(const struct residues rows[3], flint_rand_t random)
{
    const nmod_t mod = rows[0].mod;
    const mp_limb_t s = n_randint(random, mod.n), t = n_randint(random, mod.n);
    nmod_mat_t matrix;

    nmod_mat_init(matrix, 3, PATCH_PARTS, mod.n);
    for (int row = 0; row < 3; row++) {
        for (int i = 0; i < PATCH_PARTS; i++) {
            nmod_mat_entry(matrix, row, i) = residues_at(&rows[row], i, s, t);
        }
    }
    const slong rank = nmod_mat_rank(matrix);
    nmod_mat_clear(matrix);
    return rank;
}

static slong find_rank(const struct patch *patch, mp_limb_t prime, flint_rand_t random)
{
    struct residues rows[3];
    slong rank = 0;

    residues_init(&rows[0], patch->part, patch->ring, patch_degree(patch), prime);
    for (int k = 0; k < 2; k++) {
        fmpz_mpoly_t by[PATCH_PARTS];
        derivatives(patch, k, by);
        residues_init(&rows[k + 1], by, patch->ring, patch_degree(patch), prime);
        for (int i = 0; i < PATCH_PARTS; i++) {
            fmpz_mpoly_clear(by[i], patch->ring);
        }
    }
    for (int i = 0; i < TRIES; i++) {
        const slong found = rank_at(rows, random);
        rank = found > rank ? found : rank;
    }
    for (int k = 0; k < 3; k++) {
        residues_clear(&rows[k]);
    }
    return rank;
}

/* --- lines --- */

/* f(s + c t, t) */
static void shear(const struct residues *r, const mp_limb_t *f, mp_limb_t c, mp_limb_t *out)
{
    const slong side = r->degree + 1;
    mp_limb_t *powers = flint_calloc((size_t)side, sizeof *powers); /* (s + c t)^i by power of t */

    powers[0] = 1;
    for (slong i = 0; i < side; i++) {
        for (slong j = 0; i + j < side; j++) {
            for (slong k = 0; k <= i; k++) {
                mp_limb_t *to = &out[(i - k) * side + j + k];
                *to = nmod_add(*to, nmod_mul(f[i * side + j], powers[k], r->mod), r->mod);
            }
        }
        for (slong k = i + 1; k > 0 && k < side; k--) {
            powers[k] = nmod_add(powers[k], nmod_mul(powers[k - 1], c, r->mod), r->mod);
        }
    }
    flint_free(powers);
}

/* A random plane, through `point` unless that is NULL, at the parameters, sheared. */
static mp_limb_t *plane(const struct residues *r, const mp_limb_t *point, mp_limb_t slant,
                        flint_rand_t random)
{
    const size_t size = (size_t)((r->degree + 1) * (r->degree + 1));
    mp_limb_t factors[PATCH_PARTS], sum = 0;
    mp_limb_t *flat = flint_calloc(size, sizeof *flat), *out = flint_calloc(size, sizeof *out);

    for (int i = 0; i < PATCH_PARTS; i++) {
        factors[i] = 1 + n_randint(random, r->mod.n - 1);
    }
    if (point) {
        for (int i = 0; i < PATCH_W; i++) {
            sum = nmod_add(sum, nmod_mul(factors[i], point[i], r->mod), r->mod);
        }
        factors[PATCH_W] = nmod_neg(nmod_div(sum, point[PATCH_W], r->mod), r->mod);
    }
    for (int i = 0; i < PATCH_PARTS; i++) {
        for (size_t k = 0; k < size; k++) {
            flat[k] = nmod_add(flat[k], nmod_mul(factors[i], r->part[i][k], r->mod), r->mod);
        }
    }
    shear(r, flat, slant, out);
    flint_free(flat);
    return out;
}

/* The resultant in t of two random planes, as a polynomial in s. */
static void meet(const struct residues *r, const mp_limb_t *point, mp_limb_t slant,
                 flint_rand_t random, nmod_poly_t out)
{
    const slong count = r->degree * r->degree + 1;
    mp_limb_t *first = plane(r, point, slant, random), *second = plane(r, point, slant, random);
    mp_limb_t *at = flint_calloc((size_t)count, sizeof *at);
    mp_limb_t *values = flint_calloc((size_t)count, sizeof *values);
    nmod_poly_t a, b;

    nmod_poly_init_mod(a, r->mod);
    nmod_poly_init_mod(b, r->mod);
    for (slong i = 0; i < count; i++) {
        at[i] = (mp_limb_t)i;
        residues_in_t(r, first, at[i], a);
        residues_in_t(r, second, at[i], b);
        values[i] = nmod_poly_resultant(a, b);
    }
    nmod_poly_interpolate_nmod_vec(out, at, values, count);
    nmod_poly_clear(a);
    nmod_poly_clear(b);
    flint_free(at);
    flint_free(values);
    flint_free(first);
    flint_free(second);
}

/* Zeros that two lines share, and those of one of them. */
static slong shared(const struct residues *r, const mp_limb_t *point, mp_limb_t slant,
                    flint_rand_t random, slong *out_all)
{
    nmod_poly_t one, other;

    nmod_poly_init_mod(one, r->mod);
    nmod_poly_init_mod(other, r->mod);
    meet(r, point, slant, random, one);
    meet(r, point, slant, random, other);
    *out_all = nmod_poly_degree(one);
    nmod_poly_gcd(one, one, other);
    const slong common = nmod_poly_degree(one);
    nmod_poly_clear(one);
    nmod_poly_clear(other);
    return common;
}

static bool count(const struct residues *r, flint_rand_t random, struct patch_degrees *out)
{
    mp_limb_t point[PATCH_PARTS];
    const mp_limb_t slant = 1 + n_randint(random, r->mod.n - 1);
    slong all, of_point;

    residues_random_point(r, random, point);
    out->base = shared(r, NULL, slant, random, &all);
    out->map = shared(r, point, slant, random, &of_point) - out->base;
    if (out->map <= 0 || (all - out->base) % out->map != 0) {
        return false;
    }
    out->surface = (all - out->base) / out->map;
    return out->surface > 0;
}

bool patch_is_surface(const struct patch *patch, flint_rand_t random, struct error *err)
{
    const mp_limb_t prime = residues_next_prime(patch->part, patch->ring, UWORD(1) << 60);
    const slong rank = find_rank(patch, prime, random);

    return rank == 3 ||
           error_set(err, ERROR_INVALID, "", "these equations make a %s, not a surface",
                     rank == 2 ? "curve" : "point");
}

bool patch_find_degrees(const struct patch *patch, flint_rand_t random, struct patch_degrees *out,
                        struct error *err)
{
    const mp_limb_t prime = residues_next_prime(patch->part, patch->ring, UWORD(1) << 60);
    struct residues r;

    if (!patch_is_surface(patch, random, err)) {
        return false;
    }
    residues_init(&r, patch->part, patch->ring, patch_degree(patch), prime);
    bool ok = false;
    for (int i = 0; !ok && i < TRIES; i++) {
        ok = count(&r, random, out);
    }
    residues_clear(&r);
    if (!ok) {
        return error_set(err, ERROR_INTERNAL, "", "the degree of the surface was not found");
    }
    return out->surface <= LIMIT_IMPLICIT_DEGREE ||
           error_set(err, ERROR_LIMIT, "",
                     "the equation has degree %ld, up to %ld coefficients; the limit is %d "
                     "(implicit_degree)",
                     out->surface, (out->surface + 1) * (out->surface + 2) * (out->surface + 3) / 6,
                     LIMIT_IMPLICIT_DEGREE);
}
