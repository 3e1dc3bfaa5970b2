/* SPDX-License-Identifier: MIT */
/* GLSL of the calls that instructions are: what they ask of their functions, with their numbers. */
#ifndef RENDERER_SHADER_CALLS_H
#define RENDERER_SHADER_CALLS_H

#include <stdio.h>

#include "field.h"

/* Surfaces that were never mixed are vec3 h (distance, leaf, slot); mixed ones are m. Where there
 * are shaders, o is the point in the space of the shape that h is of. */
struct shader_writer {
    FILE *out;
    const struct field *field;
    bool surface;
    bool mixed[FIELD_SLOTS_MAX]; /* slot holds m, not h */
};

/* What a code declares, in the block that starts at vec4 `first` of what `base` begins to read. */
void shader_write_places(const struct shader_writer *w, const struct field_code *code,
                         const char *base, uint32_t first);
void shader_write_vec4s(const struct shader_writer *w, uint32_t first, int count);
/* "d3", or the distance of the surface in slot 3. */
void shader_write_distance(const struct shader_writer *w, uint16_t slot);
void shader_write_local(const struct shader_writer *w, const struct field_instruction *in);
/* Where a user's function is asked. */
void shader_write_code_point(const struct shader_writer *w, const struct field_instruction *in);
void shader_write_shape(struct shader_writer *w, const struct field_instruction *in);
void shader_write_call(const struct shader_writer *w, const struct field_instruction *in,
                       const char *suffix);
/* "P(7).y" */
void shader_write_number(const struct shader_writer *w, uint32_t index);
void shader_write_domain_call(const struct shader_writer *w, const struct field_instruction *in,
                              const char *suffix, const char *extra);
void shader_write_codes(const struct shader_writer *w, const struct field_code *codes, size_t count,
                        const char *prefix, int first_source);

#endif
