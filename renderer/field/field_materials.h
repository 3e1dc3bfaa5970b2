/* SPDX-License-Identifier: MIT */
/* Materials in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_MATERIALS_H
#define RENDERER_FIELD_MATERIALS_H

#include "builder.h"

/* The slot of a material; 0, the default, where the scene has none of this name. */
size_t field_material_slot(const struct scene *scene, const char *name);
/* The slot of the environment's floor. */
size_t field_floor_slot(const struct scene *scene);
/* Whether light goes through the material in a slot. */
bool field_material_clear(const struct scene *scene, size_t slot);

/* Everything behind the blocks of instructions: all materials with their shaders, and the lists of
 * points. */
void field_add_materials(struct builder *b);

#endif
