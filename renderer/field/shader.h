/* SPDX-License-Identifier: MIT */
/* GLSL text of a field program. Pure: no GL, no numbers in the text (they come through P). */
#ifndef RENDERER_SHADER_H
#define RENDERER_SHADER_H

#include <stdio.h>

#include "field.h"

/* `float map(vec3 p)`: the distance. Caller frees.
 *
 * The text includes what it calls, and params.glsl for P(i), the vec4 number i of field->params,
 * where i is a constant, and P_ANY(i), where it need not be. */
char *shader_map(const struct field *field);

/* `void surface(vec3 p, Shading at, out Surface s)`: leaf and material at a hit (glsl/surface.glsl;
 * object_position is filled in). USER_SHADERS must be defined where field->shader_count > 0. Both
 * texts may stand in one program. */
char *shader_surface(const struct field *field);

/* What one kind of instruction does, as a function of its own, whose numbers are own_param(i) from
 * 0 on: what an interpreter of field programs calls (renderer/engine).
 *
 *   SHAPE float(vec3 p)   COMBINE, SHARE float(float a, float b)   CHANGE float(float d)
 *   MAP, FIRST, LAST vec3(vec3 p)   CELL vec3(vec3 p, vec3 cell)   AFTER float(float d, vec3 p) */
#define SHADER_KERNELS(X)                                                                          \
    X(SHAPE) X(COMBINE) X(SHARE) X(CHANGE) X(MAP) X(FIRST) X(LAST) X(CELL) X(AFTER)
enum shader_kernel {
#define X(NAME) KERNEL_##NAME,
    SHADER_KERNELS(X)
#undef X
};

/* Whether instructions of this type have that. */
bool shader_has_kernel(const struct node_type *type, enum shader_kernel kernel);
/* `choices`: as of struct field_instruction. */
void shader_kernel(FILE *out, const char *name, const struct node_type *type, uint32_t choices,
                   enum shader_kernel kernel);
/* The same of a shape by one of the field's codes, which shader_functions writes. */
void shader_code_kernel(FILE *out, const char *name, const struct field *field, uint32_t code);
void shader_functions(FILE *out, const struct field *field);
/* ask_shader() of glsl/mixing.glsl, with all shaders of the field; nothing where it has none. */
void shader_ask(FILE *out, const struct field *field);
/* The same of users' distance functions: kernel_code_point(vec3 p), where one is asked, and
 * kernel_code_shape(float d, vec3 p), the distance after its answer. */
void shader_code_kernels(FILE *out);

#endif
