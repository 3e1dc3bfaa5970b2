/* SPDX-License-Identifier: MIT */
/* Code in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_CODE_H
#define RENDERER_FIELD_CODE_H

#include "builder.h"
#include "renderer/code/equation_code.h"

/* The index of the code in the field's list for this use, where it is added unless it is there
 * already; -1 and the builder's error, which names `place`, where it does not compile. */
int field_code_add(struct builder *b, enum code_use use, const char *text,
                   const struct param *params, const char *place);
/* The same for our shader that calls the function of an equation (renderer/code/shades.h). It is
 * found by the equation's text. */
int field_map_add(struct builder *b, const char *equation, const char *shade,
                  const struct param *params, const char *place);
/* The same for the distance of an equation that is no polynomial, which reads so many vec4s. */
int field_equation_add(struct builder *b, const struct equation *equation,
                       struct equation_form form, int vectors, const char *place);

/* The caller frees it. NULL, and the builder's error: the text cannot be read. */
struct equation *field_read_equation(struct builder *b, const char *text, const char *place);

/* BUILDER_HASH_START, or what was hashed before, with a text behind it. */
uint64_t field_text_hash(uint64_t state, const char *text);

/* What a node runs that has code or an equation. */
struct field_call {
    const char *text;
    bool is_equation;
    struct equation_form form;  /* of an equation */
    double ball[3];             /* full lengths of the box around it, where it is cut by a ball */
    const struct param *params; /* what code declares; of an equation those from `size` on, */
    const struct value *values; /* and what the node gives; both borrowed */
    double lipschitz;
    const double *size;
    double extent;                 /* of an equation's clip; of code 0 */
    char place[ERROR_PLACE_BYTES]; /* of the text */
};
/* False: it has none, so it is empty space or another shape. `out` stays where it is. */
bool field_call_of(const struct scene *scene, const struct node *node, struct field_call *out);

/* The shader of the material in a slot, -1: none, and what it reads. */
int field_shader_numbers(const struct field *field, size_t slot, double *out_n);

#endif
