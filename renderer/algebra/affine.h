/* SPDX-License-Identifier: MIT */
/* The arguments of sin, cos, exp and their like: sums of multiples of letters, of 1 and of pi. */
#ifndef RENDERER_ALGEBRA_AFFINE_H
#define RENDERER_ALGEBRA_AFFINE_H

#include <flint/fmpq.h>
#include <stdbool.h>

#include "protocol/equation.h"
#include "protocol/surface.h"

/* Letters, 1 and pi. */
enum { AFFINE_ONE = SURFACE_LETTERS, AFFINE_PI, AFFINE_TERMS };

struct affine {
    fmpq_t of[AFFINE_TERMS]; /* multiples of each letter, of 1, of pi */
};

void affine_init(struct affine *a); /* 0 */
void affine_clear(struct affine *a);
/* False: this node is no such sum with rational multiples. */
bool affine_read(struct affine *out, const struct equation *equation, uint16_t node);
/* The decimal fraction that was written: 0.1 is 1/10. */
void affine_number(fmpq_t out, double value);

#endif
