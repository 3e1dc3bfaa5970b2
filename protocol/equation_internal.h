/* SPDX-License-Identifier: MIT */
/* Nodes of an equation while it is read. Private to equation*.c. */
#ifndef PROTOCOL_EQUATION_INTERNAL_H
#define PROTOCOL_EQUATION_INTERNAL_H

#include "equation.h"

extern const char *const equation_axes[]; /* x, y and z; NULL at the end */

/* Where a name is in a list that ends with NULL; -1: nowhere. */
int equation_name_in(const char *const *names, const char *name);
/* Of functions, then composites; -1: it is none. */
int equation_function_of(const char *name, int *out_arguments);
/* What is said of a name that is none, with what may be meant. `plain`: x, y and z are none. */
void equation_unknown(const char *const *letters, bool plain, const char *name, bool called,
                      char out[EQUATION_MESSAGE_BYTES]);

/* A text that grows. */
struct equation_text {
    char *text;
    size_t length, room;
};
void equation_put(struct equation_text *out, const char *text);
/* The shortest text that strtod reads as `value`, with 15 or 17 digits. */
void equation_number_text(double value, char out[32]);

/* The index of a node like this one, which is added unless it is there. False: there are too
 * many, LIMIT_EQUATION_NODES, or LIMIT_EQUATION_WEIGHT of them written out. */
bool equation_add(struct equation *equation, struct equation_node node, uint16_t *out);

/* Functions that are written by others; `pow` is an operator. */
enum equation_composite {
    EQUATION_HYPOT,
    EQUATION_CLAMP,
    EQUATION_MIX,
    EQUATION_LOG2,
    EQUATION_POW,
    EQUATION_FRACT,
    EQUATION_MOD,
    EQUATION_STEP,
    EQUATION_SMOOTHSTEP,
    EQUATION_CHEB, /* its first argument is known, and whole */
    EQUATION_COMPOSITES,
};
extern const struct equation_function equation_composites[EQUATION_COMPOSITES];
/* Its nodes for these arguments, all but pow(). False: they are too many. */
bool equation_compose(struct equation *equation, enum equation_composite which, const uint16_t *in,
                      uint16_t *out);

#endif
