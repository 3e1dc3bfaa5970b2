/* SPDX-License-Identifier: MIT */
/* The params of a field on the device: glsl/params.glsl. */
#ifndef RENDERER_PARAM_BUFFER_H
#define RENDERER_PARAM_BUFFER_H

#include <stddef.h>

#include "gl.h"

struct param_buffer {
    GLuint buffer, texture; /* one of them, else 0 */
};

/* Whether numbers come from a texture: where a uniform block is too small, and on llvmpipe, which
 * makes two branches of each number out of a block, and compiles seven times as long.
 *
 * The texture is no buffer texture: Mesa leaves the sampler of these as whoever came before had
 * it, and llvmpipe compiles a program again for each state of its samplers. */
bool param_buffer_in_texture(const struct gl *gl, bool software, size_t capacity);
/* `count` vec4s, then zeros up to `capacity`, a power of two. */
void param_buffer_init(struct param_buffer *out, const struct gl *gl, bool in_texture,
                       const float *values, size_t count, size_t capacity);
/* The same of those from vec4 `first` to before `end` of `values`; the others stay. */
void param_buffer_update(const struct param_buffer *params, const struct gl *gl,
                         const float *values, size_t first, size_t end);
void param_buffer_finish(struct param_buffer *params, const struct gl *gl);
void param_buffer_bind(const struct param_buffer *params, const struct gl *gl);

#endif
