/* SPDX-License-Identifier: MIT */
/* Asks functions of renderer/glsl/ about numbers, in a compute shader on the best device. Whatever
 * goes wrong fails the test with its message. */
#ifndef TESTS_SUPPORT_FORMULA_H
#define TESTS_SUPPORT_FORMULA_H

#include "renderer/gl/egl.h"
#include "renderer/gl/gl.h"

struct formula {
    struct egl egl;
    struct gl gl;
};

/* A question and its answer. */
struct formula_row {
    float a[4], b[4], c[4];
    float out[4];
};

void formula_init(struct formula *formula);
void formula_finish(struct formula *formula);

/* `text` has `vec4 ask(vec4 a, vec4 b, vec4 c)`, and includes what that calls. */
void formula_run(struct formula *formula, const char *text, struct formula_row *rows, size_t count);

#endif
