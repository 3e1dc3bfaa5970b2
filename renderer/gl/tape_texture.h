/* SPDX-License-Identifier: MIT */
/* The tapes of a field on the device: TAPE_NUMBERS in glsl/interface.h. */
#ifndef RENDERER_TAPE_TEXTURE_H
#define RENDERER_TAPE_TEXTURE_H

#include <stddef.h>
#include <stdint.h>

#include "gl.h"

/* `count` texels, whole rows. The caller deletes the texture. */
GLuint tape_texture_create(const struct gl *gl, const uint32_t (*texels)[4], size_t count);
void tape_texture_bind(GLuint texture, const struct gl *gl);

#endif
