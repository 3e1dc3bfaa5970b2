/* SPDX-License-Identifier: MIT */
/* The value of an expression as a fraction of polynomials: sums, products, quotients and whole
 * powers. What a letter, an axis or a call is, the caller knows. One thread. */
#ifndef RENDERER_ALGEBRA_EXPRESSION_H
#define RENDERER_ALGEBRA_EXPRESSION_H

#include "fraction.h"
#include "protocol/equation.h"

struct expression {
    const struct equation *equation;
    const fmpz_mpoly_ctx_struct *ring;
    /* Of each other operation, into a fraction that is 0; false: `err` is filled. */
    bool (*leaf)(void *data, const struct equation_node *node, struct fraction *out);
    void *data;
    struct error *err;
};

/* Of a text before it is read: longer numbers would be rounded. False: `err` is filled. */
bool expression_check_digits(const char *text, const char *place, struct error *err);
/* Of the node `root`; false: `err` is filled. */
bool expression_value(const struct expression *e, uint16_t root, struct fraction *out);
/* Tells why a leaf makes no polynomial; false. */
bool expression_refuse(const struct equation_node *node, struct error *err);

#endif
