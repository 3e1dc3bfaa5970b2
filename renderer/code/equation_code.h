/* SPDX-License-Identifier: MIT */
/* Implicit equations as distance functions in the language of users' code, so that C, the engine
 * and GLSL run one text.
 *
 * At a point the function's value f and gradient g are computed, by dual numbers. |f| / |g|, which
 * is Newton's step, bounds the distance neither from above nor from below. In a box around the
 * point, with this step as half of its length, intervals give what the slope is at most: M. No
 * point of the surface is nearer than the lesser of |f| / M and the step (the mean value theorem;
 * Mitchell, Robust ray intersection with interval arithmetic, Graphics Interface 1990, for the
 * intervals). Where the step is short M is hardly above |g|, so rays converge as fast as Newton's
 * method. The bound has no bounded slope itself: engines may not prune by it. */
#ifndef RENDERER_EQUATION_CODE_H
#define RENDERER_EQUATION_CODE_H

#include "protocol/equation.h"

/* What is made of the surface. */
struct equation_form {
    bool sheet; /* so thick as the number `thickness` says; else what is behind it, solid */
    bool ball;  /* cut by one of the number `radius`; else the caller cuts it by a box */
};

/* The text of float sdf(vec3 p). It reads the declared numbers vec3 size, float radius, float
 * thickness, and the equation's letters. The caller frees it. */
char *equation_code(const struct equation *equation, const char *const *letters,
                    struct equation_form form);

#endif
