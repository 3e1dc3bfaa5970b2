/* SPDX-License-Identifier: MIT */
#include "texture.h"

enum { ATTACHMENTS_MAX = 8 }; /* that OpenGL promises */

static void set_filter(const struct gl *gl, GLenum target)
{
    gl->TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static int half(int length)
{
    return length > 1 ? length / 2 : 1;
}

void texture_allocate(const struct gl *gl, GLenum format, int levels, int width, int height)
{
    const bool whole = format == GL_R32UI || format == GL_RGBA32UI;

    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
    for (int level = 0; level < levels; level++) {
        gl->TexImage2D(GL_TEXTURE_2D, level, (GLint)format, width, height, 0,
                       whole ? GL_RGBA_INTEGER : GL_RGBA, whole ? GL_UNSIGNED_INT : GL_FLOAT, NULL);
        width = half(width);
        height = half(height);
    }
}

GLuint texture_create(const struct gl *gl, GLenum format, int width, int height)
{
    GLuint texture = 0;

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    set_filter(gl, GL_TEXTURE_2D);
    texture_allocate(gl, format, 1, width, height);
    return texture;
}

GLuint texture_create_layers(const struct gl *gl, GLenum format, int side, int layers)
{
    GLuint texture = 0;

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    gl->TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, format, side, side, layers);
    set_filter(gl, GL_TEXTURE_2D_ARRAY);
    return texture;
}

void texture_set_environment(const struct gl *gl, int levels)
{
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                      levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void texture_bind(const struct gl *gl, GLenum unit, GLuint texture)
{
    gl->ActiveTexture(GL_TEXTURE0 + unit);
    gl->BindTexture(GL_TEXTURE_2D, texture);
}

GLuint framebuffer_create(const struct gl *gl, const GLuint *textures, int count)
{
    GLenum attachments[ATTACHMENTS_MAX];
    GLuint buffer = 0;

    gl->GenFramebuffers(1, &buffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, buffer);
    for (int i = 0; i < count; i++) {
        attachments[i] = (GLenum)(GL_COLOR_ATTACHMENT0 + i);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, textures[i], 0);
    }
    gl->DrawBuffers(count, attachments);
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        gl->DeleteFramebuffers(1, &buffer);
        return 0;
    }
    return buffer;
}

bool outputs_init(struct outputs *out_outputs, const struct gl *gl, int side)
{
    static const GLenum formats[OUT_KINDS] = {GL_RGBA8, GL_RGBA32F, GL_R32UI};
    bool complete = true;

    for (int i = 0; i < OUT_KINDS; i++) {
        out_outputs->textures[i] = texture_create(gl, formats[i], side, side);
        out_outputs->buffers[i] = framebuffer_create(gl, &out_outputs->textures[i], 1);
        complete = complete && out_outputs->buffers[i] != 0;
    }
    return complete;
}

void outputs_finish(struct outputs *outputs, const struct gl *gl)
{
    gl->DeleteFramebuffers(OUT_KINDS, outputs->buffers);
    gl->DeleteTextures(OUT_KINDS, outputs->textures);
    *outputs = (struct outputs){0};
}
