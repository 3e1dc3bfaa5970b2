/* SPDX-License-Identifier: MIT */
/* The letters and generators of an ideal, from the record that asks for it. One thread. */
#ifndef RENDERER_ALGEBRA_IDEAL_H
#define RENDERER_ALGEBRA_IDEAL_H

#include <flint/fmpz_mpoly.h>

#include "order.h"

struct ideal {
    char *names;                                     /* the letters, with NULs between them */
    const char *letters[LIMIT_GROEBNER_LETTERS + 1]; /* in `names`; NULL at the end */
    struct order_params order;
    ulong prime;
    fmpz_mpoly_ctx_t plain; /* the letters */
    fmpz_mpoly_t generators[LIMIT_GROEBNER_GENERATORS];
    int count;
    fmpz_mpoly_t dividend; /* without its denominator */
    fmpz_t denominator;
    bool divides; /* there is one */
};

/* False: `err` names the member, and the line and column of a polynomial. Nothing has to be cleared
 * then. */
bool ideal_read(struct ideal *out, const struct record *asked, struct error *err);
void ideal_clear(struct ideal *ideal);

#endif
