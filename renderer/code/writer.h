/* SPDX-License-Identifier: MIT */
/* From a checked tree to GLSL: no name of the author's, no index outside, no operation that drivers
 * may do as they like (glsl/code.glsl).
 *
 * All names begin with that of the whole, as nothing else does: NAME_f2 is function 2, NAME_v3
 * variable 3, NAME_n3 the counter of its loop, NAME_d4 declared parameter 4. */
#ifndef RENDERER_CODE_WRITER_H
#define RENDERER_CODE_WRITER_H

#include <stdio.h>

#include "code.h"
#include "tree.h"

/* code_write(). */
void writer_write(const struct tree *tree, enum code_use use, const char *name, int source_number,
                  FILE *out);

/* --- between the files of the writer --- */

struct code_writer {
    FILE *out;
    const struct tree *tree;
    const char *name;
    int source;
    int line; /* of the author's text, that the driver takes the current one for; 0: unknown */
};

#define PUT(w, ...) fprintf((w)->out, __VA_ARGS__)

void writer_expr(struct code_writer *w, const struct expr *expr);
/* The name that it has in GLSL; returns `out` or a text that stays. */
const char *writer_type(struct type type, char out[TYPE_NAME_BYTES]);
void writer_variable(struct code_writer *w, const struct variable *variable);
void writer_constant(struct code_writer *w, struct type type, const double *value);
void writer_number(struct code_writer *w, enum base base, double number);

#endif
