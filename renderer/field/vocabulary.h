/* SPDX-License-Identifier: MIT */
/* The kinds of instructions that a field has. Fields with the same kinds, as far as their slots go,
 * are run by one interpreter: glsl/tapes_run.glsl. Pure: no GL. */
#ifndef RENDERER_VOCABULARY_H
#define RENDERER_VOCABULARY_H

#include "field.h"

/* What calls a function of its own. */
struct vocabulary_kind {
    enum field_op op; /* SHAPE, COMBINE, DISTANCE, WARP, AFTER or LOOP */
    const struct node_type *type;
    uint32_t choices; /* as of struct field_instruction */
    bool code;        /* FIELD_SHAPE: of users' code, which is `choices` */
};

struct vocabulary {
    struct vocabulary_kind *kinds; /* ordered by op, type and choices */
    size_t count;
    int points, distances, loops; /* room for slots and nested loops, rounded up */
};

struct vocabulary vocabulary_of(const struct field *field);
void vocabulary_finish(struct vocabulary *vocabulary);
/* Equal for equal texts of an interpreter; `field`: whose codes these contain. */
uint64_t vocabulary_hash(const struct vocabulary *vocabulary, const struct field *field);
/* The index of the kind of an instruction; 0 where it needs none. */
size_t vocabulary_find(const struct vocabulary *vocabulary, const struct vocabulary_kind *kind);

/* The texts of an interpreter, for the places of shader_map and shader_surface. Numbers come from a
 * texture. They depend on the vocabulary and the codes of the field alone. Caller frees. */
char *vocabulary_map(const struct vocabulary *vocabulary, const struct field *field);
char *vocabulary_surface(const struct vocabulary *vocabulary, const struct field *field);

#endif
