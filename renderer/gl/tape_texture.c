/* SPDX-License-Identifier: MIT */
#include "tape_texture.h"

#include "renderer/glsl/interface.h"
#include "texture.h"

GLuint tape_texture_create(const struct gl *gl, size_t rows)
{
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_TAPES);
    return texture_create(gl, GL_RGBA32UI, TAPES_ROW, (GLsizei)rows);
}

void tape_texture_write(GLuint texture, const struct gl *gl, size_t first, size_t count,
                        const uint32_t (*texels)[4])
{
    tape_texture_bind(texture, gl);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, (GLint)first, TAPES_ROW, (GLsizei)count, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, texels);
}

void tape_texture_bind(GLuint texture, const struct gl *gl)
{
    texture_bind(gl, UNIT_TAPES, texture);
}
