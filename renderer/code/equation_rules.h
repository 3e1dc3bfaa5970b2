/* SPDX-License-Identifier: MIT */
/* One row for each function of equations. Private to equation_code.c and its table. */
#ifndef RENDERER_EQUATION_RULES_H
#define RENDERER_EQUATION_RULES_H

#include "protocol/equation.h"

/* In texts $ is the argument. */
struct equation_rule {
    const char *value; /* of a number */
    const char *slope; /* its derivative there; NULL: the function has two arguments */
    /* vec4 range_NAME(vec2 x): what value (x, y) and slope (z, w) are at least and at most while
     * the argument is from x.x to x.y. With two arguments: vec4 dual_NAME(vec4 a, vec4 b) of their
     * (gradient, value), and mat3 jet_NAME(mat3 a, mat3 b). */
    const char *range; /* empty: they are in jets.h */
};
extern const struct equation_rule equation_rules[EQUATION_FUNCTIONS];
/* Of 1 / x, which is no function of the language. */
extern const struct equation_rule equation_reciprocal;

/* What they call: the least and the greatest size in an interval. */
extern const char equation_sizes[];

#endif
