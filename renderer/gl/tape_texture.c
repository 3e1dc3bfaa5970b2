/* SPDX-License-Identifier: MIT */
#include "tape_texture.h"

#include "renderer/glsl/interface.h"
#include "texture.h"

GLuint tape_texture_create(const struct gl *gl, const uint32_t (*texels)[4], size_t count)
{
    const GLsizei rows = (GLsizei)(count / TAPES_ROW);

    gl->ActiveTexture(GL_TEXTURE0 + UNIT_TAPES);
    const GLuint texture = texture_create(gl, GL_RGBA32UI, TAPES_ROW, rows);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, TAPES_ROW, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                      texels);
    return texture;
}

void tape_texture_bind(GLuint texture, const struct gl *gl)
{
    texture_bind(gl, UNIT_TAPES, texture);
}
