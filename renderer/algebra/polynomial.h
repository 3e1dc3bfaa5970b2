/* SPDX-License-Identifier: MIT */
/* Polynomials over the rationals or modulo a prime, ordered by a matrix, by FLINT. Over the
 * rationals they are kept as whole numbers without a common divisor. One thread. */
#ifndef RENDERER_ALGEBRA_POLYNOMIAL_H
#define RENDERER_ALGEBRA_POLYNOMIAL_H

#include <flint/fmpz_mpoly.h>
#include <flint/nmod_mpoly.h>
#include <stdio.h>

#include "order.h"

/* FLINT knows lex, and each monomial has the rows of the order as exponents in front: M a, a. Both
 * are sums where monomials are multiplied, and M a divides M b where a divides b. */
struct ring {
    struct order order;
    ulong prime; /* 0: the rationals */
    fmpz_mpoly_ctx_t whole;
    nmod_mpoly_ctx_t residues;
};

struct polynomial {
    fmpz_mpoly_t whole;    /* over the rationals */
    nmod_mpoly_t residues; /* modulo a prime */
};

typedef ulong exponents[LIMIT_GROEBNER_LETTERS];

void ring_init(struct ring *ring, const struct order_params *order, ulong prime);
void ring_clear(struct ring *ring);

void polynomial_init(struct polynomial *f, const struct ring *ring); /* 0 */
void polynomial_clear(struct polynomial *f, const struct ring *ring);
void polynomial_swap(struct polynomial *f, struct polynomial *g, const struct ring *ring);
/* Of a polynomial in the same letters, in a ring of FLINT's own. */
void polynomial_set(struct polynomial *out, const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t plain,
                    const struct ring *ring);
/* The other way, over the rationals alone. */
void polynomial_get(fmpz_mpoly_t out, const fmpz_mpoly_ctx_t plain, const struct polynomial *f,
                    const struct ring *ring);

slong polynomial_terms(const struct polynomial *f, const struct ring *ring); /* 0: it is 0 */
/* Of term `n`; 0 is the leading one. */
void polynomial_exponents(const struct polynomial *f, slong n, const struct ring *ring,
                          exponents out);
ulong polynomial_degree(const struct polynomial *f, const struct ring *ring); /* total */
/* Without a common divisor, the leading coefficient above 0. */
void make_primitive(fmpz_mpoly_t f);
/* A leading coefficient of 1 modulo a prime; else above 0, without a common divisor. */
void polynomial_normalize(struct polynomial *f, const struct ring *ring);
/* lc(g) x^(lcm - a) f - lc(f) x^(lcm - b) g for leading exponents a and b. */
void polynomial_s(struct polynomial *out, const struct polynomial *f, const struct polynomial *g,
                  const struct ring *ring);

/* scale f = sum of quotients[i] divisors[i] + rest, where no term of the rest is a multiple of a
 * leading monomial. The first divisor that fits is taken. `scale` is 1 modulo a prime. */
struct division {
    fmpz_t scale;
    struct polynomial *quotients, rest;
    int count;
};
void division_init(struct division *d, int divisors, const struct ring *ring);
void division_clear(struct division *d, const struct ring *ring);
void polynomial_divide(struct division *out, const struct polynomial *f,
                       const struct polynomial *const *divisors, const struct ring *ring);
slong division_steps(const struct division *d, const struct ring *ring); /* terms of quotients */

/* In the order's sequence of terms: "2*x^2*y - 3". */
void polynomial_print(const struct polynomial *f, const char *const *letters,
                      const struct ring *ring, FILE *out);
void monomial_print(const exponents a, const char *const *letters, int count, FILE *out);

#endif
