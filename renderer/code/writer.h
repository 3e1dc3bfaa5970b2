/* SPDX-License-Identifier: MIT */
/* From a checked tree to GLSL: no name of the author's, no index outside, no operation that drivers
 * may do as they like (glsl/code.glsl). */
#ifndef RENDERER_CODE_WRITER_H
#define RENDERER_CODE_WRITER_H

#include <stdio.h>

#include "code.h"
#include "tree.h"

/* code_write(). */
void writer_write(const struct tree *tree, enum code_use use, const char *name, int source_number,
                  FILE *out);

#endif
