/* SPDX-License-Identifier: MIT */
/* Equations in double precision, straight from their nodes, without the code that is made of them:
 * tests hold that code against it. Pure. */
#ifndef RENDERER_EQUATION_VALUE_H
#define RENDERER_EQUATION_VALUE_H

#include "protocol/equation.h"

/* A function of the language; near its domain's end as the rules in equation_rules.c say. */
double equation_call(enum equation_name name, double a, double b);
/* left - right, or right - left where the relation is > or >=: negative inside. */
double equation_value(const struct equation *equation, const double p[3], const double *letters);
/* Of an expression in letters alone. `room`: for a number of each of its nodes. */
double equation_expression_value(const struct equation *equation, const double *letters,
                                 double *room);

#endif
