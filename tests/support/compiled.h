/* SPDX-License-Identifier: MIT */
/* Scenes compiled to fields, for tests that have no use for one that does not compile. */
#ifndef TESTS_SUPPORT_COMPILED_H
#define TESTS_SUPPORT_COMPILED_H

#include "renderer/field/field.h"

/* Ends the program where the scene does not compile. The caller unrefs. */
struct field *compile_field(const struct scene *scene);
/* The tree as JSON, for messages of failure. Caller frees. */
char *root_text(const struct scene *scene);

#endif
