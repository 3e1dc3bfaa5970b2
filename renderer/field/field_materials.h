/* SPDX-License-Identifier: MIT */
/* Materials in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_MATERIALS_H
#define RENDERER_FIELD_MATERIALS_H

#include "builder.h"

/* The slot of a material; 0, the default, where the scene has none of this name. */
size_t field_material_slot(const struct scene *scene, const char *name);

/* Everything behind the blocks of instructions: all materials with their shaders, and the lists of
 * points. Slots of materials whose shader does not compile stay as the default. */
void field_add_materials(struct builder *b);

#endif
