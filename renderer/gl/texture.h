/* SPDX-License-Identifier: MIT */
/* Textures that passes read and write, and the framebuffers that they are drawn into by. */
#ifndef RENDERER_TEXTURE_H
#define RENDERER_TEXTURE_H

#include "gl.h"

/* Kinds of finished pixels. */
enum out_kind { OUT_BYTES /* rgba8 */, OUT_FLOATS /* rgba32f */, OUT_UINTS /* r32ui */, OUT_KINDS };

/* Where finished pixels of a tile are drawn to. */
struct outputs {
    GLuint textures[OUT_KINDS], buffers[OUT_KINDS];
};

/* All have the same state of their sampler: llvmpipe compiles a program again for another one. */
GLuint texture_create(const struct gl *gl, GLenum format, int width, int height);
/* Of the bound texture: room for its levels, each half as large as the one before. */
void texture_allocate(const struct gl *gl, GLenum format, int levels, int width, int height);
GLuint texture_create_layers(const struct gl *gl, GLenum format, int side, int layers);
/* Of the bound texture, with so many levels, a picture of what is around: longitudes meet,
 * latitudes end. */
void texture_set_environment(const struct gl *gl, int levels);
void texture_bind(const struct gl *gl, GLenum unit, GLuint texture);

/* Of the current context alone. 0: the driver cannot draw into these formats. */
GLuint framebuffer_create(const struct gl *gl, const GLuint *textures, int count);

/* False: as framebuffer_create. */
bool outputs_init(struct outputs *out_outputs, const struct gl *gl, int side);
void outputs_finish(struct outputs *outputs, const struct gl *gl);

#endif
