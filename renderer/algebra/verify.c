/* SPDX-License-Identifier: MIT */
/* The cheap questions come first: what does not fit mostly fails at one of the first points, before
 * polynomials of a high degree are made. */
#include "verify.h"

#include <stdlib.h>
#include <string.h>

#include "certificate.h"
#include "degree.h"
#include "implicit.h"
#include "protocol/json.h"
#include "protocol/limits.h"

enum { WITNESS = 6 }; /* the greatest sum of the parameters that are tried */

struct proof {
    struct patch patch;
    fmpz_mpoly_ctx_t space;
    struct fraction equation; /* of x, y, z */
    struct verdict *out;
};

static bool misfit(struct proof *p, const char *why)
{
    p->out->verdict = SURFACE_DOES_NOT_FIT;
    return error_set(&p->out->reason, ERROR_INVALID, "", "%s", why);
}

/* --- a point of the surface --- */

/* f at (x, y, z) */
static void value_at(const fmpz_mpoly_t f, fmpq_t point[3], fmpq_t out,
                     const fmpz_mpoly_ctx_t space)
{
    fmpq_t term, power;
    fmpz_t coefficient;

    fmpq_init(term), fmpq_init(power);
    fmpz_init(coefficient);
    fmpq_zero(out);
    for (slong n = 0; n < fmpz_mpoly_length(f, space); n++) {
        ulong exponents[3];
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, f, n, space);
        fmpz_mpoly_get_term_exp_ui(exponents, f, n, space);
        fmpq_set_fmpz(term, coefficient);
        for (int i = 0; i < 3; i++) {
            fmpq_pow_si(power, point[i], (slong)exponents[i]);
            fmpq_mul(term, term, power);
        }
        fmpq_add(out, out, term);
    }
    fmpz_clear(coefficient);
    fmpq_clear(term), fmpq_clear(power);
}

/* The point of parameters i and j; false: there is none. */
static bool point_at(const struct patch *patch, slong i, slong j, fmpq_t point[3])
{
    fmpz s = i, t = j, *at[2] = {&s, &t};
    fmpz_t over, under;

    fmpz_init(over), fmpz_init(under);
    fmpz_mpoly_evaluate_all_fmpz(under, patch->part[PATCH_W], at, patch->ring);
    const bool ok = !fmpz_is_zero(under);
    for (int k = 0; ok && k < 3; k++) {
        fmpz_mpoly_evaluate_all_fmpz(over, patch->part[k], at, patch->ring);
        fmpq_set_fmpz_frac(point[k], over, under);
    }
    fmpz_clear(over), fmpz_clear(under);
    return ok;
}

/* Whether the equation is not 0 there; `under` is not 0 then either. */
static bool tell_point(struct proof *p, slong i, slong j)
{
    fmpq_t point[3], over, under;

    for (int k = 0; k < 3; k++) {
        fmpq_init(point[k]);
    }
    fmpq_init(over), fmpq_init(under);
    bool found = point_at(&p->patch, i, j, point);
    if (found) {
        value_at(p->equation.over, point, over, p->space);
        value_at(p->equation.under, point, under, p->space);
        found = !fmpq_is_zero(over) && !fmpq_is_zero(under);
    }
    if (found) {
        fmpq_div(over, over, under);
        error_set(&p->out->reason, ERROR_INVALID, "",
                  "at the point (%g, %g, %g) of the surface the equation is off by %g",
                  fmpq_get_d(point[0]), fmpq_get_d(point[1]), fmpq_get_d(point[2]),
                  fmpq_get_d(over));
    }
    for (int k = 0; k < 3; k++) {
        fmpq_clear(point[k]);
    }
    fmpq_clear(over), fmpq_clear(under);
    return found;
}

static bool check_points(struct proof *p)
{
    for (slong sum = 3; sum <= WITNESS; sum++) {
        for (slong i = 1; i < sum; i++) {
            if (tell_point(p, i, sum - i)) {
                p->out->verdict = SURFACE_DOES_NOT_FIT;
                return false;
            }
        }
    }
    return true;
}

/* --- the steps --- */

static bool check_letters(struct proof *p, const struct surface *surface)
{
    for (int i = 0; i < SURFACE_LETTERS; i++) {
        const char *letter = surface_names[SURFACE_PARTS + i];
        if (p->patch.uses[i] && !surface->ranges[i].set) {
            return error_set(&p->out->reason, ERROR_INVALID, letter, "has no range");
        }
    }
    return true;
}

static bool check_surface(struct proof *p)
{
    flint_rand_t random;

    flint_randinit(random);
    struct error err = {0};
    const bool ok = patch_is_surface(&p->patch, random, &err);
    flint_randclear(random);
    return ok || misfit(p, err.message);
}

static bool check_equation(struct proof *p)
{
    const slong degree = fmpz_mpoly_total_degree_si(p->equation.over, p->space);

    if (degree < 0) {
        return misfit(p, "the equation holds everywhere");
    }
    if (degree == 0) {
        return misfit(p, "the equation holds nowhere");
    }
    return degree <= LIMIT_IMPLICIT_DEGREE ||
           error_set(&p->out->reason, ERROR_LIMIT, "",
                     "too large: the equation has degree %ld; the limit is %d (implicit_degree)",
                     degree, LIMIT_IMPLICIT_DEGREE);
}

static bool check_factors(struct proof *p)
{
    return certificate_is_irreducible(p->equation.over, p->space) ||
           misfit(p, "the equation is a product, of which this surface is one factor");
}

static bool prove(struct proof *p, const struct surface *surface, const struct record *params)
{
    struct error *reason = &p->out->reason;

    if (!check_letters(p, surface) || !check_surface(p)) {
        return false;
    }
    if (!implicit_read(&p->equation, params, p->space, reason)) {
        snprintf(reason->place, sizeof reason->place, "equation");
        return false;
    }
    return check_equation(p) && check_points(p) && check_factors(p) &&
           (certificate_is_zero(&p->patch, p->equation.over, p->space) ||
            misfit(p, "on the surface the equation does not hold"));
}

/* --- all of it --- */

static struct equation_clip clip_of(const struct record *params)
{
    const double radius = record_number(params, "radius");
    const double *size = record_vector(params, "size");
    struct equation_clip clip = {.ball = record_is(params, "clip", "ball")};

    for (int i = 0; i < 3; i++) {
        clip.half[i] = clip.ball ? radius : size[i] / 2;
    }
    return clip;
}

static void verify_surface(const struct record *params, const struct surface *surface,
                           struct verdict *out)
{
    struct proof p = {.out = out};

    if (!patch_read(&p.patch, surface->parts, &out->reason)) {
        return;
    }
    fmpz_mpoly_ctx_init(p.space, 3, ORD_DEGLEX);
    fraction_init(&p.equation, p.space);
    if (prove(&p, surface, params)) {
        const struct equation_clip clip = clip_of(params);
        out->verdict = SURFACE_VERIFIED;
        coverage_measure(p.equation.over, p.space, surface, &clip, &out->coverage);
        error_set(&out->reason, ERROR_NONE, "", "degree %ld, %ld terms",
                  fmpz_mpoly_total_degree_si(p.equation.over, p.space),
                  fmpz_mpoly_length(p.equation.over, p.space));
    }
    fraction_clear(&p.equation, p.space);
    fmpz_mpoly_ctx_clear(p.space);
    patch_clear(&p.patch);
}

void verify(const struct record *params, struct verdict *out)
{
    const char *text = record_text(params, "parametric");
    struct surface surface;
    cJSON *json = json_parse(text, strlen(text), NULL);

    *out = (struct verdict){.verdict = SURFACE_NOT_CHECKED};
    surface_read(&surface, json, "", NULL);
    if (surface.parts[0]) {
        verify_surface(params, &surface, out);
    } else {
        error_set(&out->reason, ERROR_INVALID, "", "there is no parametric surface");
    }
    cJSON_Delete(json);
}
