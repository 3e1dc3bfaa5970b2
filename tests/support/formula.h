/* SPDX-License-Identifier: MIT */
/* Asks functions of renderer/glsl/ about numbers, in a compute shader on the best device. Whatever
 * goes wrong fails the test with its message. */
#ifndef TESTS_SUPPORT_FORMULA_H
#define TESTS_SUPPORT_FORMULA_H

#include "renderer/gl/gl.h"

/* A question and its answer. */
struct formula_row {
    float a[4], b[4], c[4];
    float out[4];
};

/* Around a group of tests. */
int formula_start(void **state);
int formula_end(void **state);
/* Between the two. */
const struct gl *formula_gl(void);

/* `text` has `vec4 ask(vec4 a, vec4 b, vec4 c)`, and includes what that calls. The surface of the
 * field is leaf 1 everywhere. */
void formula_run(const char *text, struct formula_row *rows, size_t count);

#endif
