/* SPDX-License-Identifier: MIT */
#include "eliminate.h"

#include <string.h>

enum { PAIRS_APART = 25 };
enum { S, T, PARAMETERS }; /* of the patch */
enum { H = PARAMETERS, HOMOGENEOUS_X, HOMOGENEOUS_LETTERS = HOMOGENEOUS_X + PATCH_PARTS };
enum { Q, SATURATED_S, SATURATED_T, SATURATED_X, SATURATED_LETTERS = SATURATED_X + 3 };

struct elimination {
    const struct patch *patch;
    struct ring ring;
    fmpz_mpoly_ctx_t plain; /* the same letters */
    struct groebner basis;
};

static void elimination_init(struct elimination *e, const struct patch *patch,
                             const struct order_params *order)
{
    e->patch = patch;
    ring_init(&e->ring, order, 0);
    fmpz_mpoly_ctx_init(e->plain, order->letters, ORD_LEX);
    groebner_init(&e->basis, &e->ring);
}

static void elimination_clear(struct elimination *e)
{
    groebner_clear(&e->basis);
    fmpz_mpoly_ctx_clear(e->plain);
    ring_clear(&e->ring);
}

/* A part of the patch in letters from `first` on; h^(degree - its own) is put in where h >= 0. */
static void set_part(struct elimination *e, fmpz_mpoly_t out, int part, int first, int h,
                     slong degree)
{
    const struct patch *patch = e->patch;
    fmpz_t coefficient;

    fmpz_init(coefficient);
    fmpz_mpoly_zero(out, e->plain);
    for (slong n = 0; n < fmpz_mpoly_length(patch->part[part], patch->ring); n++) {
        ulong from[PARAMETERS];
        exponents to = {0};
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, patch->part[part], n, patch->ring);
        fmpz_mpoly_get_term_exp_ui(from, patch->part[part], n, patch->ring);
        to[first] = from[S];
        to[first + 1] = from[T];
        if (h >= 0) {
            to[h] = (ulong)degree - from[S] - from[T];
        }
        fmpz_mpoly_push_term_fmpz_ui(out, coefficient, to, e->plain);
    }
    fmpz_mpoly_sort_terms(out, e->plain);
    fmpz_clear(coefficient);
}

static void add_generator(struct elimination *e, const fmpz_mpoly_t f)
{
    struct polynomial g;

    polynomial_init(&g, &e->ring);
    polynomial_set(&g, f, e->plain, &e->ring);
    groebner_add(&e->basis, &g);
    polynomial_clear(&g, &e->ring);
}

/* An element in x, y, z, and w where there is one, which is 1. */
static void get_equation(struct elimination *e, int element, int first, fmpz_mpoly_t out,
                         const fmpz_mpoly_ctx_t space)
{
    fmpz_mpoly_t all;
    fmpz_t coefficient;

    fmpz_init(coefficient);
    fmpz_mpoly_init(all, e->plain);
    polynomial_get(all, e->plain, &e->basis.elements[element], &e->ring);
    fmpz_mpoly_zero(out, space);
    for (slong n = 0; n < fmpz_mpoly_length(all, e->plain); n++) {
        exponents from;
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, all, n, e->plain);
        fmpz_mpoly_get_term_exp_ui(from, all, n, e->plain);
        fmpz_mpoly_push_term_fmpz_ui(out, coefficient, from + first, space);
    }
    fmpz_mpoly_sort_terms(out, space);
    fmpz_mpoly_clear(all, e->plain);
    fmpz_clear(coefficient);
}

/* The first element in x, y, z (and w) becomes the equation. */
static bool take_equation(struct elimination *e, int first, fmpz_mpoly_t out,
                          const fmpz_mpoly_ctx_t space, struct error *err)
{
    for (int i = 0; i < e->basis.count; i++) {
        if (groebner_is_free(&e->basis, i, first)) {
            get_equation(e, i, first, out, space);
            return true;
        }
    }
    return error_set(err, ERROR_INTERNAL, "", "no element of the basis is free of parameters");
}

/* Some of them. */
static void tell_pairs(void *data, const struct groebner *g, const struct groebner_step *step)
{
    if (g->counts.pairs % PAIRS_APART == 0 || step->waiting == 0) {
        progress_tell(data, PROGRESS_PAIRS, (long)g->counts.pairs, "%zu pairs, %zu waiting",
                      g->counts.pairs, step->waiting);
    }
}

/* --- the homogeneous form --- */

static void add_homogeneous(struct elimination *e, slong degree)
{
    fmpz_mpoly_t f, letter;

    fmpz_mpoly_init(f, e->plain);
    fmpz_mpoly_init(letter, e->plain);
    for (int part = 0; part < PATCH_PARTS; part++) {
        set_part(e, f, part, S, H, degree);
        fmpz_mpoly_gen(letter, HOMOGENEOUS_X + part, e->plain);
        fmpz_mpoly_sub(f, letter, f, e->plain);
        add_generator(e, f);
    }
    fmpz_mpoly_clear(f, e->plain);
    fmpz_mpoly_clear(letter, e->plain);
}

bool eliminate_homogeneous(const struct patch *patch, const struct progress *progress,
                           fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                           struct groebner_counts *out_counts, struct error *err)
{
    const slong degree = patch_degree(patch);
    struct elimination e;
    struct order_params order = {
        .kind = ORDER_GREVLEX, .letters = HOMOGENEOUS_LETTERS, .eliminate = HOMOGENEOUS_X};

    for (int i = 0; i < HOMOGENEOUS_LETTERS; i++) {
        order.weights[i] = i < HOMOGENEOUS_X ? 1 : (unsigned)degree;
    }
    elimination_init(&e, patch, &order);
    add_homogeneous(&e, degree);
    groebner_complete(
        &e.basis, &(struct groebner_params){.coprime = true, .chain = true, .until = HOMOGENEOUS_X},
        tell_pairs, (void *)progress);
    *out_counts = e.basis.counts;
    const bool found = take_equation(&e, HOMOGENEOUS_X, out, space, err);
    elimination_clear(&e);
    return found;
}

/* --- the saturated form --- */

static void add_saturated(struct elimination *e)
{
    fmpz_mpoly_t f, letter, under;

    fmpz_mpoly_init(f, e->plain);
    fmpz_mpoly_init(letter, e->plain);
    fmpz_mpoly_init(under, e->plain);
    set_part(e, under, PATCH_W, SATURATED_S, -1, 0);
    for (int part = 0; part < PATCH_W; part++) {
        set_part(e, f, part, SATURATED_S, -1, 0);
        fmpz_mpoly_gen(letter, SATURATED_X + part, e->plain);
        fmpz_mpoly_mul(letter, letter, under, e->plain);
        fmpz_mpoly_sub(f, letter, f, e->plain);
        add_generator(e, f);
    }
    fmpz_mpoly_gen(letter, Q, e->plain);
    fmpz_mpoly_mul(under, under, letter, e->plain);
    fmpz_mpoly_one(f, e->plain);
    fmpz_mpoly_sub(f, f, under, e->plain);
    add_generator(e, f);
    fmpz_mpoly_clear(f, e->plain);
    fmpz_mpoly_clear(letter, e->plain);
    fmpz_mpoly_clear(under, e->plain);
}

bool eliminate_saturated(const struct patch *patch, const struct progress *progress,
                         fmpz_mpoly_t out, const fmpz_mpoly_ctx_t space,
                         struct groebner_counts *out_counts, struct error *err)
{
    struct elimination e;

    elimination_init(&e, patch,
                     &(struct order_params){.kind = ORDER_GREVLEX,
                                            .letters = SATURATED_LETTERS,
                                            .eliminate = SATURATED_X});
    add_saturated(&e);
    groebner_complete(
        &e.basis,
        &(struct groebner_params){.strategy = STRATEGY_SUGAR, .coprime = true, .chain = true},
        tell_pairs, (void *)progress);
    *out_counts = e.basis.counts;
    groebner_reduce(&e.basis);
    const bool found = take_equation(&e, SATURATED_X, out, space, err);
    elimination_clear(&e);
    return found;
}
