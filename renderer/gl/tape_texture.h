/* SPDX-License-Identifier: MIT */
/* The tapes of a field on the device: TAPE_NUMBERS in glsl/interface.h. */
#ifndef RENDERER_TAPE_TEXTURE_H
#define RENDERER_TAPE_TEXTURE_H

#include <stddef.h>
#include <stdint.h>

#include "gl.h"

/* Of so many rows, with nothing in them. The caller deletes the texture. */
GLuint tape_texture_create(const struct gl *gl, size_t rows);
/* `count` rows from one on. */
void tape_texture_write(GLuint texture, const struct gl *gl, size_t first, size_t count,
                        const uint32_t (*texels)[4]);
void tape_texture_bind(GLuint texture, const struct gl *gl);

#endif
