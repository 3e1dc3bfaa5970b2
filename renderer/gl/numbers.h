/* SPDX-License-Identifier: MIT */
/* The numbers of a field on the device: glsl/numbers.glsl. */
#ifndef RENDERER_NUMBERS_H
#define RENDERER_NUMBERS_H

#include <stddef.h>

#include "gl.h"

enum { NUMBERS_ROW = 256 }; /* vec4s in a row of the texture */

struct numbers {
    GLuint buffer, texture; /* one of them, else 0 */
};

/* Whether numbers come from a texture: where a uniform block is too small, and on llvmpipe, which
 * makes two branches of each number out of a block, and compiles seven times as long.
 *
 * The texture is no buffer texture: Mesa leaves the sampler of these as whoever came before had
 * it, and llvmpipe compiles a program again for each state of its samplers. */
bool numbers_in_texture(const struct gl *gl, bool software, size_t capacity);
/* `count` vec4s, then zeros up to `capacity`, a power of two. */
void numbers_init(struct numbers *out, const struct gl *gl, bool software, const float *values,
                  size_t count, size_t capacity);
/* The same of those from vec4 `first` to before `end` of `values`; the others stay. */
void numbers_update(const struct numbers *numbers, const struct gl *gl, const float *values,
                    size_t first, size_t end);
void numbers_finish(struct numbers *numbers, const struct gl *gl);
void numbers_bind(const struct numbers *numbers, const struct gl *gl);

#endif
