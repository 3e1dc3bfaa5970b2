/* SPDX-License-Identifier: MIT */
#ifndef RENDERER_SPMD_CALLS_H
#define RENDERER_SPMD_CALLS_H

#include <stdbool.h>
#include <stdio.h>

/* A kernel in GLSL for each row of builtin_table, base and size; or, of each, a line of C,
 * CALL_ROW(row, base, size, gives one number, function). */
void spmd_write_calls(FILE *out, bool table);

#endif
