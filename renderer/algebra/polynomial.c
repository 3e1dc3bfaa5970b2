/* SPDX-License-Identifier: MIT */
#include "polynomial.h"

#include <stdlib.h>

#include "protocol/memory.h"

enum { FIELDS = ORDER_ROWS + LIMIT_GROEBNER_LETTERS }; /* exponents that FLINT sees */

void ring_init(struct ring *ring, const struct order_params *order, ulong prime)
{
    order_make(&ring->order, order);
    ring->prime = prime;
    const slong fields = ring->order.rows + ring->order.letters;
    fmpz_mpoly_ctx_init(ring->whole, fields, ORD_LEX);
    nmod_mpoly_ctx_init(ring->residues, fields, ORD_LEX, prime ? prime : 2);
}

void ring_clear(struct ring *ring)
{
    fmpz_mpoly_ctx_clear(ring->whole);
    nmod_mpoly_ctx_clear(ring->residues);
}

void polynomial_init(struct polynomial *f, const struct ring *ring)
{
    fmpz_mpoly_init(f->whole, ring->whole);
    nmod_mpoly_init(f->residues, ring->residues);
}

void polynomial_clear(struct polynomial *f, const struct ring *ring)
{
    fmpz_mpoly_clear(f->whole, ring->whole);
    nmod_mpoly_clear(f->residues, ring->residues);
}

void polynomial_swap(struct polynomial *f, struct polynomial *g, const struct ring *ring)
{
    fmpz_mpoly_swap(f->whole, g->whole, ring->whole);
    nmod_mpoly_swap(f->residues, g->residues, ring->residues);
}

/* --- terms --- */

static void fields_of(const struct ring *ring, const ulong *letters, ulong out[FIELDS])
{
    for (int i = 0; i < ring->order.rows; i++) {
        out[i] = order_image(&ring->order, i, letters);
    }
    for (int i = 0; i < ring->order.letters; i++) {
        out[ring->order.rows + i] = letters[i];
    }
}

void polynomial_set(struct polynomial *out, const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t plain,
                    const struct ring *ring)
{
    exponents letters;
    ulong fields[FIELDS];
    fmpz_t coefficient;

    fmpz_init(coefficient);
    fmpz_mpoly_zero(out->whole, ring->whole);
    nmod_mpoly_zero(out->residues, ring->residues);
    for (slong n = 0; n < fmpz_mpoly_length(f, plain); n++) {
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, f, n, plain);
        fmpz_mpoly_get_term_exp_ui(letters, f, n, plain);
        fields_of(ring, letters, fields);
        if (ring->prime) {
            nmod_mpoly_push_term_ui_ui(out->residues, fmpz_fdiv_ui(coefficient, ring->prime),
                                       fields, ring->residues);
        } else {
            fmpz_mpoly_push_term_fmpz_ui(out->whole, coefficient, fields, ring->whole);
        }
    }
    fmpz_mpoly_sort_terms(out->whole, ring->whole);
    nmod_mpoly_sort_terms(out->residues, ring->residues);
    nmod_mpoly_combine_like_terms(out->residues, ring->residues); /* leaves out those that are 0 */
    fmpz_clear(coefficient);
}

void polynomial_get(fmpz_mpoly_t out, const fmpz_mpoly_ctx_t plain, const struct polynomial *f,
                    const struct ring *ring)
{
    exponents letters;
    fmpz_t coefficient;

    fmpz_init(coefficient);
    fmpz_mpoly_zero(out, plain);
    for (slong n = 0; n < polynomial_terms(f, ring); n++) {
        fmpz_mpoly_get_term_coeff_fmpz(coefficient, f->whole, n, ring->whole);
        polynomial_exponents(f, n, ring, letters);
        fmpz_mpoly_push_term_fmpz_ui(out, coefficient, letters, plain);
    }
    fmpz_mpoly_sort_terms(out, plain);
    fmpz_clear(coefficient);
}

slong polynomial_terms(const struct polynomial *f, const struct ring *ring)
{
    return ring->prime ? nmod_mpoly_length(f->residues, ring->residues)
                       : fmpz_mpoly_length(f->whole, ring->whole);
}

void polynomial_exponents(const struct polynomial *f, slong n, const struct ring *ring,
                          exponents out)
{
    ulong fields[FIELDS];

    if (ring->prime) {
        nmod_mpoly_get_term_exp_ui(fields, f->residues, n, ring->residues);
    } else {
        fmpz_mpoly_get_term_exp_ui(fields, f->whole, n, ring->whole);
    }
    for (int i = 0; i < ring->order.letters; i++) {
        out[i] = fields[ring->order.rows + i];
    }
}

ulong polynomial_degree(const struct polynomial *f, const struct ring *ring)
{
    ulong most = 0;

    for (slong n = 0; n < polynomial_terms(f, ring); n++) {
        exponents letters;
        ulong sum = 0;
        polynomial_exponents(f, n, ring, letters);
        for (int i = 0; i < ring->order.letters; i++) {
            sum += letters[i];
        }
        most = sum > most ? sum : most;
    }
    return most;
}

/* --- arithmetic --- */

void make_primitive(fmpz_mpoly_t f)
{
    fmpz_t divisor;

    fmpz_init(divisor);
    _fmpz_vec_content(divisor, f->coeffs, f->length);
    if (f->length > 0 && fmpz_sgn(f->coeffs) < 0) {
        fmpz_neg(divisor, divisor);
    }
    if (f->length > 0) {
        _fmpz_vec_scalar_divexact_fmpz(f->coeffs, f->coeffs, f->length, divisor);
    }
    fmpz_clear(divisor);
}

void polynomial_normalize(struct polynomial *f, const struct ring *ring)
{
    if (polynomial_terms(f, ring) == 0) {
        return;
    }
    if (ring->prime) {
        nmod_mpoly_make_monic(f->residues, f->residues, ring->residues);
        return;
    }
    make_primitive(f->whole);
}

/* The leading coefficient of `by`, times x^fields. */
static void set_factor(struct polynomial *out, const struct polynomial *by,
                       const ulong fields[FIELDS], const struct ring *ring)
{
    if (ring->prime) {
        nmod_mpoly_zero(out->residues, ring->residues);
        nmod_mpoly_push_term_ui_ui(out->residues, by->residues->coeffs[0], fields, ring->residues);
    } else {
        fmpz_mpoly_zero(out->whole, ring->whole);
        fmpz_mpoly_push_term_fmpz_ui(out->whole, by->whole->coeffs, fields, ring->whole);
    }
}

static void multiply(struct polynomial *out, const struct polynomial *f, const struct ring *ring)
{
    if (ring->prime) {
        nmod_mpoly_mul(out->residues, out->residues, f->residues, ring->residues);
    } else {
        fmpz_mpoly_mul(out->whole, out->whole, f->whole, ring->whole);
    }
}

static void subtract(struct polynomial *out, const struct polynomial *f, const struct ring *ring)
{
    if (ring->prime) {
        nmod_mpoly_sub(out->residues, out->residues, f->residues, ring->residues);
    } else {
        fmpz_mpoly_sub(out->whole, out->whole, f->whole, ring->whole);
    }
}

void polynomial_s(struct polynomial *out, const struct polynomial *f, const struct polynomial *g,
                  const struct ring *ring)
{
    exponents a, b, up = {0}, down = {0};
    ulong fields[FIELDS];
    struct polynomial other;

    polynomial_init(&other, ring);
    polynomial_exponents(f, 0, ring, a);
    polynomial_exponents(g, 0, ring, b);
    for (int i = 0; i < ring->order.letters; i++) {
        up[i] = b[i] > a[i] ? b[i] - a[i] : 0;
        down[i] = a[i] > b[i] ? a[i] - b[i] : 0;
    }
    fields_of(ring, up, fields);
    set_factor(out, g, fields, ring);
    multiply(out, f, ring);
    fields_of(ring, down, fields);
    set_factor(&other, f, fields, ring);
    multiply(&other, g, ring);
    subtract(out, &other, ring);
    polynomial_clear(&other, ring);
}

/* --- division --- */

void division_init(struct division *d, int divisors, const struct ring *ring)
{
    fmpz_init(d->scale);
    polynomial_init(&d->rest, ring);
    d->count = divisors;
    d->quotients = memory_alloc((size_t)divisors + 1, sizeof *d->quotients);
    for (int i = 0; i < divisors; i++) {
        polynomial_init(&d->quotients[i], ring);
    }
}

void division_clear(struct division *d, const struct ring *ring)
{
    for (int i = 0; i < d->count; i++) {
        polynomial_clear(&d->quotients[i], ring);
    }
    free(d->quotients);
    polynomial_clear(&d->rest, ring);
    fmpz_clear(d->scale);
}

void polynomial_divide(struct division *out, const struct polynomial *f,
                       const struct polynomial *const *divisors, const struct ring *ring)
{
    const size_t count = (size_t)out->count;
    nmod_mpoly_struct **residues = memory_alloc(2 * count + 1, sizeof *residues);
    fmpz_mpoly_struct **whole = memory_alloc(2 * count + 1, sizeof *whole);

    for (size_t i = 0; i < count; i++) {
        residues[i] = out->quotients[i].residues;
        whole[i] = out->quotients[i].whole;
        residues[count + i] = (nmod_mpoly_struct *)divisors[i]->residues;
        whole[count + i] = (fmpz_mpoly_struct *)divisors[i]->whole;
    }
    fmpz_one(out->scale);
    if (ring->prime) {
        nmod_mpoly_divrem_ideal(residues, out->rest.residues, f->residues, residues + count,
                                out->count, ring->residues);
    } else {
        fmpz_mpoly_quasidivrem_ideal(out->scale, whole, out->rest.whole, f->whole, whole + count,
                                     out->count, ring->whole);
    }
    free(residues);
    free(whole);
}

slong division_steps(const struct division *d, const struct ring *ring)
{
    slong sum = 0;

    for (int i = 0; i < d->count; i++) {
        sum += polynomial_terms(&d->quotients[i], ring);
    }
    return sum;
}

/* --- text --- */

void monomial_print(const exponents a, const char *const *letters, int count, FILE *out)
{
    const char *between = "";

    for (int i = 0; i < count; i++) {
        if (a[i] > 0) {
            fprintf(out, a[i] > 1 ? "%s%s^%lu" : "%s%s", between, letters[i], a[i]);
            between = "*";
        }
    }
    if (!between[0]) {
        fputc('1', out);
    }
}

static void print_term(const struct polynomial *f, slong n, const char *const *letters,
                       const struct ring *ring, FILE *out)
{
    exponents a;
    fmpz_t coefficient;
    bool constant = true;

    fmpz_init(coefficient);
    polynomial_exponents(f, n, ring, a);
    for (int i = 0; i < ring->order.letters; i++) {
        constant &= a[i] == 0;
    }
    if (ring->prime) {
        fmpz_set_ui(coefficient, f->residues->coeffs[n]);
    } else {
        fmpz_set(coefficient, f->whole->coeffs + n);
    }
    fputs(n == 0 ? (fmpz_sgn(coefficient) < 0 ? "-" : "")
                 : (fmpz_sgn(coefficient) < 0 ? " - " : " + "),
          out);
    fmpz_abs(coefficient, coefficient);
    if (constant || !fmpz_is_one(coefficient)) {
        fmpz_fprint(out, coefficient);
        fputs(constant ? "" : "*", out);
    }
    if (!constant) {
        monomial_print(a, letters, ring->order.letters, out);
    }
    fmpz_clear(coefficient);
}

void polynomial_print(const struct polynomial *f, const char *const *letters,
                      const struct ring *ring, FILE *out)
{
    const slong terms = polynomial_terms(f, ring);

    for (slong n = 0; n < terms; n++) {
        print_term(f, n, letters, ring, out);
    }
    if (terms == 0) {
        fputc('0', out);
    }
}
