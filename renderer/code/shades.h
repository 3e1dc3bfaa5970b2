/* SPDX-License-Identifier: MIT */
/* Shaders of the registry (protocol/nodes.h, shader_types) whose colour depends on the place: their
 * code, as users write theirs. */
#ifndef RENDERER_CODE_SHADES_H
#define RENDERER_CODE_SHADES_H

#include <stdbool.h>

struct shade {
    const char *shader; /* name of the row, whose parameters the code reads */
    bool unlit;         /* the colour is what is seen; else lights fall on it */
    /* The parameter, the first one, with an equation, whose function_at (equation_code.h) the text
     * calls; it is y where none is given. NULL: none. */
    const char *function;
    const char *text;
};

const struct shade *shade_find(const char *shader); /* NULL: it needs no code */

#endif
