/* SPDX-License-Identifier: MIT */
/* Materials in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_MATERIALS_H
#define RENDERER_FIELD_MATERIALS_H

#include "builder.h"

/* The slot of a material; 0, the default, where the scene has none of this name. */
size_t field_material_slot(const struct scene *scene, const char *name);
/* The slot of the environment's floor. */
size_t field_floor_slot(const struct scene *scene);
/* Compiles the shaders of materials that are used: before all else. The caller frees
 * b->material_shaders. */
void field_add_material_shaders(struct builder *b);
/* Whether light goes through the material in a slot, at some places at least. */
bool field_material_transmissive(const struct builder *b, size_t slot);
/* What a shader's surface is as a material's numbers, which are there already. */
void field_put_surface(double to[FIELD_MATERIAL_NUMBERS], const struct code_surface *surface);

/* Everything behind the blocks of instructions: all materials with their shaders, and the lists of
 * points. */
void field_add_materials(struct builder *b);

/* The numbers of a material of the scene, and of the floor's, whose slot is there. */
void field_put_material(struct builder *b, size_t slot);
void field_put_floor(const struct builder *b);
/* Numbers of the C evaluator that materials before this slot have. */
size_t field_material_arguments(const struct builder *b, size_t slot);

#endif
