/* SPDX-License-Identifier: MIT */
/* GLSL text of a field program. Pure: no GL, no numbers in the text (they come through N). */
#ifndef RENDERER_SHADER_H
#define RENDERER_SHADER_H

#include "field.h"

/* Names in glsl/, to be put before the text. They read the macro N_ANY(i): vec4 number i, where i
 * need not be a constant. */
#define FIELD_GLSL_FILES                                                                           \
    "points.glsl", "shapes.glsl", "solids.glsl", "flat.glsl", "fractals.glsl", "operations.glsl",  \
        "modifiers.glsl", "noise.glsl", "warps.glsl", "code.glsl", "user.glsl", "guard.glsl",      \
        "through.glsl"

/* `float map(vec3 p)`: the distance. Caller frees.
 *
 * The text calls functions of FIELD_GLSL_FILES and a macro N(i), which gives the vec4 number i of
 * field->numbers; i is a constant. */
char *shader_map(const struct field *field);

/* `void surface(vec3 p, Shading at, out Surface s)`: leaf and material at a hit (glsl/surface.glsl;
 * object_position is filled in). Calls functions of glsl/mixture.glsl, and N_ANY(i) where i is not
 * constant. USER_SHADERS must be defined where field->shader_count > 0. Both texts may stand in one
 * program. */
char *shader_surface(const struct field *field);

#endif
