/* SPDX-License-Identifier: MIT */
/* Finds the operations and the materials whose numbers an edit has changed. */
#ifndef RENDERER_ENGINE_CHANGES_H
#define RENDERER_ENGINE_CHANGES_H

#include "engine_internal.h"

/* A set of materials by their slots. Slots that are equal modulo MATERIAL_SET share a bit. */
enum { MATERIAL_SET = 256 };
struct material_set {
    uint64_t bits[MATERIAL_SET / 64];
};

static inline void material_set_add(struct material_set *set, unsigned slot)
{
    set->bits[slot % MATERIAL_SET / 64] |= UINT64_C(1) << slot % 64;
}

/* Where an operation's own numbers lie. */
struct extent {
    uint32_t first, end; /* vec4s; empty: it has none */
};

/* The list of points of a shape, which lies behind the materials. */
struct points_list {
    size_t place; /* the number that tells where it begins; 0: there is none */
    struct extent extent;
};
struct points_list changes_points_of(const struct engine_program *program, size_t index,
                                     const float *params);

/* Finds the extents of all operations of a program, which owns them. */
void changes_find_extents(struct engine_program *program);

/* For each operation of the program, 1 if its numbers differ in `after`, else 0. The caller frees
 * it. NULL: not known, because numbers have changed that belong to no operation. */
uint8_t *changes_of_operations(const struct engine_program *program, const float *before,
                               const float *after);
size_t changes_count(const struct engine_program *program, const uint8_t *changed);
/* Whether what is made of all of them costs less anew than renewed. */
bool changes_are_many(const struct engine_program *program, size_t count);
/* Adds the materials of a field whose numbers differ in the other. False: they have other ones, or
 * other shaders. */
bool changes_of_materials(const struct field *field, const float *before, const struct field *other,
                          const float *after, struct material_set *out);

#endif
