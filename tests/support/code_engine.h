/* SPDX-License-Identifier: MIT */
/* Fields and users' code by the engine, at points. */
#ifndef TESTS_SUPPORT_CODE_ENGINE_H
#define TESTS_SUPPORT_CODE_ENGINE_H

#include "renderer/field/field.h"

/* The distances by the widest vectors; fails the test where others give other bits. */
void engine_agree(const struct field *field, const float (*points)[3], size_t count, float *out);
/* The same of a scene that consists of this distance function, which declares nothing. */
void code_engine_run(const char *text, const float (*points)[3], size_t count, float *out);

#endif
