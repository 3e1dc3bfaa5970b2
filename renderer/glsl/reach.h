/* SPDX-License-Identifier: MIT */
/* The part of a GLSL text that its main() needs: for people who read it, or paste it elsewhere. */
#ifndef RENDERER_REACH_H
#define RENDERER_REACH_H

#include <stdio.h>

/* Writes `text` without functions, structs, variables and macros that main() does not reach, the
 * comments on them, lines that #ifdef and #ifndef leave out, #line, and licences of single files.
 * A macro in capitals that stands alone declares something. The text itself is used up. */
void glsl_write_reached(FILE *out, char *text);

#endif
