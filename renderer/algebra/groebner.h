/* SPDX-License-Identifier: MIT */
/* Groebner bases by Buchberger's algorithm: Cox, Little, O'Shea, "Ideals, Varieties, and
 * Algorithms", 2.7 to 2.10, with both criteria; the sugar strategy is that of Giovini, Mora, Niesi,
 * Robbiano, Traverso, "One sugar cube, please", 1991. The next pair is that of the
 * least common multiple (normal), that of the least sugar and then as normal (sugar), or the oldest
 * (first). One thread. */
#ifndef RENDERER_ALGEBRA_GROEBNER_H
#define RENDERER_ALGEBRA_GROEBNER_H

#include "polynomial.h"

enum pair_outcome {
    PAIR_COPRIME, /* left out by the first criterion: no common factor of the leading monomials */
    PAIR_CHAIN,   /* left out by the second: a third element, whose pairs with both were seen */
    PAIR_ZERO,    /* its S-polynomial reduces to 0 */
    PAIR_ADDED,   /* the rest became an element */
    PAIR_OUTCOMES,
};
extern const char *const outcome_names[PAIR_OUTCOMES];

struct groebner_params {
    enum pair_strategy strategy;
    bool coprime, chain; /* criteria */
    /* Ends at the first element without the first `until` letters; 0: at a basis. */
    int until;
};

struct groebner_step {
    int i, j; /* elements, from 0 */
    enum pair_outcome outcome;
    ulong degree, sugar; /* degree of the least common multiple */
    slong divisions;     /* steps of the division */
    size_t waiting;      /* pairs */
    int element;         /* that was added */
};

struct groebner_counts {
    size_t pairs, of[PAIR_OUTCOMES];
    slong divisions;
    ulong degree; /* the greatest of a pair that was divided */
};

struct groebner {
    const struct ring *ring;
    struct polynomial *elements;
    ulong *sugar;
    int count;
    struct groebner_counts counts;
    struct pair *pairs; /* those that wait, the next one last */
    size_t waiting;
    unsigned char *waits; /* of each two elements */
};

void groebner_init(struct groebner *g, const struct ring *ring);
void groebner_clear(struct groebner *g);
/* Takes the value of `f`, which is 0 then. 0 is left out. */
void groebner_add(struct groebner *g, struct polynomial *f);
/* Makes the elements a basis of their ideal. `tell` may be NULL. */
void groebner_complete(struct groebner *g, const struct groebner_params *params,
                       void (*tell)(void *data, const struct groebner *g,
                                    const struct groebner_step *step),
                       void *data);
/* Of a basis: the reduced one, with the least leading monomial first. */
void groebner_reduce(struct groebner *g);
/* Whether all S-polynomials of the elements reduce to 0, without any criterion. */
bool groebner_is_basis(const struct groebner *g);
/* Whether the first `letters` letters are in none of its terms. */
bool groebner_is_free(const struct groebner *g, int element, int letters);

#endif
