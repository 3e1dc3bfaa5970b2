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
     * the argument is from x.x to x.y. With two arguments: mat3 jet_NAME(mat3 a, mat3 b). */
    const char *range;
};
extern const struct equation_rule equation_rules[EQUATION_FUNCTIONS];
/* Of 1 / x, which is no function of the language. */
extern const struct equation_rule equation_reciprocal;

/* What they all call. Jets are what value and slopes are in a box: the least slopes along x, y and
 * z, the greatest, and (least value, greatest value, 0). Nothing exceeds EQUATION_HUGE. */
extern const char equation_jets[];
#define EQUATION_HUGE "1e18"

#endif
