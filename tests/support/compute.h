/* SPDX-License-Identifier: MIT */
/* Compute shaders of tests, put together out of texts. */
#ifndef TESTS_SUPPORT_COMPUTE_H
#define TESTS_SUPPORT_COMPUTE_H

#include "renderer/gl/gl.h"

/* The text of a file of renderer/glsl/, which has to be there. */
const char *compute_file(const char *name);

/* One program of all the texts; 0 and `err`, with the driver's words, where it does not compile. */
GLuint compute_link(const struct gl *gl, const char *const *texts, int count, struct error *err);

#endif
