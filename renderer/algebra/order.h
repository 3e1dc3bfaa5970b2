/* SPDX-License-Identifier: MIT */
/* Orders of monomials as matrices M without negative numbers: x^a is above x^b where M a is above
 * M b in the first row that differs, and lexicographic where no row does (Robbiano, "Term orderings
 * on the polynomial ring", 1985). lex: the first letter that differs. grlex: the total degree, then
 * lex. grevlex: the total degree, then the last letter that differs, less of which is above.
 * Pure. */
#ifndef RENDERER_ALGEBRA_ORDER_H
#define RENDERER_ALGEBRA_ORDER_H

#include <stdbool.h>

#include "protocol/ideal.h"
#include "protocol/limits.h"

struct order_params {
    enum order_kind kind;
    int letters;
    /* The first letters, above all others in any power: an order that eliminates them. Each of the
     * two blocks is ordered by `kind`. */
    int eliminate;
    /* Compared before all else, where not all are 0. With weights, letters are eliminated from
     * ideals alone that are homogeneous in them. */
    unsigned weights[LIMIT_GROEBNER_LETTERS];
};

enum { ORDER_ROWS = LIMIT_GROEBNER_LETTERS + 2 };

struct order {
    int letters, rows;
    unsigned long matrix[ORDER_ROWS][LIMIT_GROEBNER_LETTERS];
};

void order_make(struct order *out, const struct order_params *params);
/* Below 0: x^a is below x^b; 0: they are equal. */
int order_compare(const struct order *order, const unsigned long *a, const unsigned long *b);
/* A row of the matrix times the exponents. */
unsigned long order_image(const struct order *order, int row, const unsigned long *exponents);

#endif
