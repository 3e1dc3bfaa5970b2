/* SPDX-License-Identifier: MIT */
/* Code in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_CODE_H
#define RENDERER_FIELD_CODE_H

#include "builder.h"

/* The index of the code in the field's list for this use, where it is added unless it is there
 * already; -1 and the builder's error, which names `place`, where it does not compile. */
int field_code_add(struct builder *b, enum code_use use, const char *text,
                   const struct param *params, const char *place);

/* BUILDER_HASH_START, or what was hashed before, with a text behind it. */
uint64_t field_text_hash(uint64_t state, const char *text);

/* What a node of type `field` runs. */
struct field_call {
    const char *text;
    const struct param *params; /* what it declares, */
    const struct value *values; /* and what the node gives; both borrowed */
    double lipschitz;
    const double *size;
    char place[ERROR_PLACE_BYTES]; /* of the text */
};
/* False: it names no code, so it is empty space. */
bool field_call_of(const struct scene *scene, const struct node *node, struct field_call *out);

/* The shader of the material in a slot, -1: none, and what it reads. */
int field_shader_numbers(const struct field *field, size_t slot, double *out_n);

#endif
