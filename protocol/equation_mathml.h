/* SPDX-License-Identifier: MIT */
/* Equations typeset: MathML (Core) of the tree, with as few parentheses as possible. Pure.
 *
 * The text is a <math> of rows between which a line may be broken: terms of the outermost sums, and
 * factors in parentheses of these. Sums and products behind LIMIT_TYPESET_NODES nodes end with an
 * ellipsis. */
#ifndef PROTOCOL_EQUATION_MATHML_H
#define PROTOCOL_EQUATION_MATHML_H

#include "equation.h"

struct equation_mathml {
    const struct equation *equation;
    const char *const *letters;
    const struct equation_definitions *definitions; /* of equation_read_written, or NULL */
};

/* The caller frees each. One of the definitions, `name := ...`: */
char *equation_mathml_definition(const struct equation_mathml *m, int which);
/* The left side. */
char *equation_mathml_expression(const struct equation_mathml *m);
/* Both sides with their relation. */
char *equation_mathml(const struct equation_mathml *m);

#endif
