/* SPDX-License-Identifier: MIT */
/* Proves that the equation of a node `implicit` is that of the parametric surface beside it: the
 * parts put into it give 0 over the whole numbers, it is irreducible over the rationals, and the
 * parts make a surface (certificate.h). One thread. */
#ifndef RENDERER_ALGEBRA_VERIFY_H
#define RENDERER_ALGEBRA_VERIFY_H

#include "coverage.h"
#include "protocol/record.h"
#include "protocol/surface.h"

struct verdict {
    enum surface_verdict verdict;
    struct error reason;      /* where it is verified its message tells degree and terms */
    struct coverage coverage; /* where it is verified: within the node's clip */
};

/* `params` are those of an `implicit`. */
void verify(const struct record *params, struct verdict *out);

#endif
