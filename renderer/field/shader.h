/* SPDX-License-Identifier: MIT */
/* GLSL text of a field program. Pure: no GL, no numbers in the text (they come through N). */
#ifndef RENDERER_SHADER_H
#define RENDERER_SHADER_H

#include "field.h"

/* `float map(vec3 p)`: the distance. Caller frees.
 *
 * The text includes what it calls, and numbers.glsl for N(i), the vec4 number i of field->numbers,
 * where i is a constant, and N_ANY(i), where it need not be. */
char *shader_map(const struct field *field);

/* `void surface(vec3 p, Shading at, out Surface s)`: leaf and material at a hit (glsl/surface.glsl;
 * object_position is filled in). USER_SHADERS must be defined where field->shader_count > 0. Both
 * texts may stand in one program. */
char *shader_surface(const struct field *field);

#endif
