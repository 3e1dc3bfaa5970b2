/* SPDX-License-Identifier: MIT */
/* Equations of each kind, for suites that look at what is made of them. */
#ifndef TESTS_SUPPORT_EQUATION_ROWS_H
#define TESTS_SUPPORT_EQUATION_ROWS_H

#include "protocol/equation.h"
#include "renderer/field/field.h"
#include "tests/support/random_scene.h"

/* `function`: the row of equation_functions that it is for; EQUATION_FUNCTIONS: none. */
struct equation_row {
    enum equation_name function;
    const char *text;
};
extern const struct equation_row equation_rows[];
extern const size_t equation_rows_count;

/* Their letters, and what these are. */
extern const char *const equation_rows_letters[];
extern const double equation_rows_values[];

/* The caller frees it. */
struct equation *equation_rows_read(const char *text);
/* A scene of an `implicit` with more parameters than its equation and `a`. `around`: what the node
 * stands in, before and behind it. The caller releases the field. */
struct field *equation_rows_field_in(const char *const around[2], const char *text,
                                     const char *more);
struct field *equation_rows_field(const char *text, const char *more);
/* In a cube around the origin. Floats hold it. */
void equation_rows_point(struct random *random, double half, double out[3]);
/* EQUATION_CASES, or so many. */
int equation_rows_cases(int usual);

#endif
