/* SPDX-License-Identifier: MIT */
#include "param_buffer.h"

#include <stdlib.h>
#include <string.h>

#include "pass.h"
#include "protocol/memory.h"
#include "texture.h"

bool param_buffer_in_texture(const struct gl *gl, bool software, size_t capacity)
{
    GLint bytes = 0;

    gl->GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &bytes);
    return software || capacity * 16 > (size_t)bytes;
}

static GLuint make_texture(const struct gl *gl, const float *values, size_t capacity)
{
    const GLsizei width = capacity < PARAMS_ROW ? (GLsizei)capacity : PARAMS_ROW;
    const GLsizei height = (GLsizei)(capacity / (size_t)width);

    gl->ActiveTexture(GL_TEXTURE0 + UNIT_PARAMS);
    const GLuint texture = texture_create(gl, GL_RGBA32F, width, height);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, values);
    return texture;
}

static GLuint make_buffer(const struct gl *gl, const float *values, size_t capacity)
{
    GLuint buffer = 0;

    gl->GenBuffers(1, &buffer);
    gl->BindBuffer(GL_UNIFORM_BUFFER, buffer);
    gl->BufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)(16 * capacity), values, GL_STATIC_DRAW);
    return buffer;
}

void param_buffer_init(struct param_buffer *out, const struct gl *gl, bool in_texture,
                       const float *values, size_t count, size_t capacity)
{
    float *padded = memory_alloc(capacity, 16);

    if (count > 0) {
        memcpy(padded, values, count * 16);
    }
    *out = (struct param_buffer){0};
    if (in_texture) {
        out->texture = make_texture(gl, padded, capacity);
    } else {
        out->buffer = make_buffer(gl, padded, capacity);
    }
    free(padded);
}

/* Rows of the texture, or part of one. */
static void put_rows(const struct gl *gl, const float *values, size_t first, size_t width,
                     size_t height)
{
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, (GLint)(first % PARAMS_ROW), (GLint)(first / PARAMS_ROW),
                      (GLsizei)width, (GLsizei)height, GL_RGBA, GL_FLOAT, values + 4 * first);
}

/* What is left of a row, whole rows, and the beginning of one. */
static void put_in_texture(const struct gl *gl, const float *values, size_t first, size_t end)
{
    while (first < end) {
        const size_t left = end - first, column = first % PARAMS_ROW;
        const size_t width = column + left > PARAMS_ROW ? PARAMS_ROW - column : left;
        const size_t height = width == PARAMS_ROW ? left / PARAMS_ROW : 1;

        put_rows(gl, values, first, width, height);
        first += width * height;
    }
}

void param_buffer_update(const struct param_buffer *params, const struct gl *gl,
                         const float *values, size_t first, size_t end)
{
    if (params->texture) {
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_PARAMS);
        gl->BindTexture(GL_TEXTURE_2D, params->texture);
        put_in_texture(gl, values, first, end);
    } else {
        gl->BindBuffer(GL_UNIFORM_BUFFER, params->buffer);
        gl->BufferSubData(GL_UNIFORM_BUFFER, (GLintptr)(16 * first),
                          (GLsizeiptr)(16 * (end - first)), values + 4 * first);
    }
}

void param_buffer_finish(struct param_buffer *params, const struct gl *gl)
{
    if (params->buffer) {
        gl->DeleteBuffers(1, &params->buffer);
    }
    if (params->texture) {
        gl->DeleteTextures(1, &params->texture);
    }
    *params = (struct param_buffer){0};
}

void param_buffer_bind(const struct param_buffer *params, const struct gl *gl)
{
    if (params->texture) {
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_PARAMS);
        gl->BindTexture(GL_TEXTURE_2D, params->texture);
    } else {
        gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_PARAMS, params->buffer);
    }
}
