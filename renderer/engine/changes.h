/* SPDX-License-Identifier: MIT */
/* Which numbers an edit has changed: of which operations, and of which materials. */
#ifndef RENDERER_ENGINE_CHANGES_H
#define RENDERER_ENGINE_CHANGES_H

#include "engine_internal.h"

/* A set of materials by their slots. Slots so many apart share a place. */
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

/* For each operation of the program, which owns them from then on. */
void changes_find_extents(struct engine_program *program);

/* For each operation of the program whether it has other numbers in `after`: 0 or 1. The caller
 * frees it. NULL: not known, since numbers have changed that belong to none. */
uint8_t *changes_of_operations(const struct engine_program *program, const float *before,
                               const float *after);
/* Adds the materials that have other numbers. */
void changes_of_materials(const struct engine_program *program, const float *before,
                          const float *after, struct material_set *out);

#endif
