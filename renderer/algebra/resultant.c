/* SPDX-License-Identifier: MIT */
/* Resultants have factors that do not belong to the surface: after each step the one is kept that
 * vanishes at its points (Cox, Little, O'Shea, "Using Algebraic Geometry", 3.2). */
#include <flint/fmpz_mpoly_factor.h>

#include "certificate.h"
#include "eliminate.h"

enum { S, T, X, LETTERS = X + 3, POINTS = 3 };

/* A power of a letter at a point, where x, y and z are fractions: letter by letter over W. */
struct point {
    fmpz_t at[LETTERS], under;
};

static void set_point(struct point *p, const struct patch *patch, flint_rand_t random)
{
    fmpz *parameters[] = {p->at[S], p->at[T]};

    do {
        fmpz_randbits(p->at[S], random, 30);
        fmpz_randbits(p->at[T], random, 30);
        fmpz_mpoly_evaluate_all_fmpz(p->under, patch->part[PATCH_W], parameters, patch->ring);
    } while (fmpz_is_zero(p->under));
    for (int i = 0; i < 3; i++) {
        fmpz_mpoly_evaluate_all_fmpz(p->at[X + i], patch->part[i], parameters, patch->ring);
    }
}

/* Times the power of W that makes it whole. */
static bool is_zero_at(const fmpz_mpoly_t f, const struct point *p, const fmpz_mpoly_ctx_t ring)
{
    fmpz_t sum, term, power;
    ulong most = 0, a[LETTERS];

    fmpz_init(sum), fmpz_init(term), fmpz_init(power);
    for (slong n = 0; n < fmpz_mpoly_length(f, ring); n++) {
        fmpz_mpoly_get_term_exp_ui(a, f, n, ring);
        most = a[X] + a[X + 1] + a[X + 2] > most ? a[X] + a[X + 1] + a[X + 2] : most;
    }
    for (slong n = 0; n < fmpz_mpoly_length(f, ring); n++) {
        fmpz_mpoly_get_term_coeff_fmpz(term, f, n, ring);
        fmpz_mpoly_get_term_exp_ui(a, f, n, ring);
        for (int i = 0; i < LETTERS; i++) {
            fmpz_pow_ui(power, p->at[i], a[i]);
            fmpz_mul(term, term, power);
        }
        fmpz_pow_ui(power, p->under, most - a[X] - a[X + 1] - a[X + 2]);
        fmpz_addmul(sum, term, power);
    }
    const bool zero = fmpz_is_zero(sum);
    fmpz_clear(sum), fmpz_clear(term), fmpz_clear(power);
    return zero;
}

struct resultants {
    const struct patch *patch;
    fmpz_mpoly_ctx_t ring; /* s, t, x, y, z */
    struct point points[POINTS];
    fmpz_mpoly_t sides[3]; /* W x - X and so on */
};

static void resultants_init(struct resultants *r, const struct patch *patch)
{
    flint_rand_t random;

    flint_randinit(random);
    r->patch = patch;
    fmpz_mpoly_ctx_init(r->ring, LETTERS, ORD_LEX);
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < LETTERS; k++) {
            fmpz_init(r->points[i].at[k]);
        }
        fmpz_init(r->points[i].under);
        set_point(&r->points[i], patch, random);
    }
    for (int i = 0; i < 3; i++) {
        fmpz_mpoly_init(r->sides[i], r->ring);
    }
    flint_randclear(random);
}

static void resultants_clear(struct resultants *r)
{
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < LETTERS; k++) {
            fmpz_clear(r->points[i].at[k]);
        }
        fmpz_clear(r->points[i].under);
    }
    for (int i = 0; i < 3; i++) {
        fmpz_mpoly_clear(r->sides[i], r->ring);
    }
    fmpz_mpoly_ctx_clear(r->ring);
}

static void lift(const struct resultants *r, int part, fmpz_mpoly_t out)
{
    const slong places[] = {S, T};

    fmpz_mpoly_compose_fmpz_mpoly_gen(out, r->patch->part[part], places, r->patch->ring, r->ring);
}

static void make_sides(struct resultants *r)
{
    fmpz_mpoly_t under, over;

    fmpz_mpoly_init(under, r->ring);
    fmpz_mpoly_init(over, r->ring);
    lift(r, PATCH_W, under);
    for (int i = 0; i < 3; i++) {
        lift(r, i, over);
        fmpz_mpoly_gen(r->sides[i], X + i, r->ring);
        fmpz_mpoly_mul(r->sides[i], r->sides[i], under, r->ring);
        fmpz_mpoly_sub(r->sides[i], r->sides[i], over, r->ring);
    }
    fmpz_mpoly_clear(under, r->ring);
    fmpz_mpoly_clear(over, r->ring);
}

static bool vanishes(const struct resultants *r, const fmpz_mpoly_t f)
{
    for (int i = 0; i < POINTS; i++) {
        if (!is_zero_at(f, &r->points[i], r->ring)) {
            return false;
        }
    }
    return true;
}

/* The factor that vanishes on the surface, into `f`. */
static bool keep_factor(const struct resultants *r, fmpz_mpoly_t f)
{
    fmpz_mpoly_factor_t factors;
    bool found = false;

    fmpz_mpoly_factor_init(factors, r->ring);
    if (!fmpz_mpoly_is_zero(f, r->ring) && fmpz_mpoly_factor(factors, f, r->ring)) {
        for (slong i = 0; !found && i < fmpz_mpoly_factor_length(factors, r->ring); i++) {
            found = vanishes(r, &factors->poly[i]);
            if (found) {
                fmpz_mpoly_set(f, &factors->poly[i], r->ring);
            }
        }
    }
    fmpz_mpoly_factor_clear(factors, r->ring);
    return found;
}

/* The resultant of a polynomial without the letter is a power of it. */
static bool eliminate(const struct resultants *r, fmpz_mpoly_t out, const fmpz_mpoly_t f,
                      const fmpz_mpoly_t g, slong letter)
{
    const bool free[] = {fmpz_mpoly_degree_si(f, letter, r->ring) == 0,
                         fmpz_mpoly_degree_si(g, letter, r->ring) == 0};

    if (free[0] || free[1]) {
        fmpz_mpoly_set(out, free[0] ? f : g, r->ring);
        return true;
    }
    return fmpz_mpoly_resultant(out, f, g, letter, r->ring) && keep_factor(r, out);
}

/* Two different ones without s, out of the three pairs of sides. */
static bool eliminate_s(const struct resultants *r, fmpz_mpoly_t first, fmpz_mpoly_t second)
{
    static const int pairs[][2] = {{0, 1}, {0, 2}, {1, 2}};
    bool found = false;

    for (int i = 0; i < 3; i++) {
        if (!eliminate(r, second, r->sides[pairs[i][0]], r->sides[pairs[i][1]], S)) {
            continue;
        }
        if (found && !fmpz_mpoly_equal(first, second, r->ring)) {
            return true;
        }
        fmpz_mpoly_set(first, second, r->ring);
        found = true;
    }
    return false;
}

static bool find(const struct resultants *r, fmpz_mpoly_t out)
{
    fmpz_mpoly_t first, second;

    fmpz_mpoly_init(first, r->ring);
    fmpz_mpoly_init(second, r->ring);
    const bool found = eliminate_s(r, first, second) && eliminate(r, out, first, second, T) &&
                       fmpz_mpoly_degree_si(out, S, r->ring) == 0 &&
                       fmpz_mpoly_degree_si(out, T, r->ring) == 0;
    fmpz_mpoly_clear(first, r->ring);
    fmpz_mpoly_clear(second, r->ring);
    return found;
}

bool eliminate_resultant(const struct patch *patch, fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                         struct error *err)
{
    static const slong places[] = {-1, -1, 0, 1, 2};
    struct resultants r;
    fmpz_mpoly_t equation;

    resultants_init(&r, patch);
    make_sides(&r);
    fmpz_mpoly_init(equation, r.ring);
    const bool found = find(&r, equation);
    if (found) {
        fmpz_mpoly_compose_fmpz_mpoly_gen(out, equation, places, r.ring, space);
    }
    fmpz_mpoly_clear(equation, r.ring);
    resultants_clear(&r);
    return found || error_set(err, ERROR_INVALID, "",
                              "the resultants have no factor that vanishes on the surface");
}
