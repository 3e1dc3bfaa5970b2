/* SPDX-License-Identifier: MIT */
/* Textures and framebuffers of a tile. */
#include "targets.h"

#include "pass.h"

static GLuint make_texture(const struct gl *gl, GLenum format, int width, int height)
{
    GLuint texture = 0;

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

static GLuint make_buffer(const struct gl *gl, GLuint texture)
{
    const GLenum attachment = GL_COLOR_ATTACHMENT0;
    GLuint buffer = 0;

    gl->GenFramebuffers(1, &buffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, buffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
    gl->DrawBuffers(1, &attachment);
    return buffer;
}

static bool check_buffer(const struct gl *gl, GLuint buffer)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, buffer);
    return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

/* A whole number of work groups. */
static int starts_side(int samples)
{
    const int side = GROUP_SIDE * BLOCK_SIDE;

    return (samples + side - 1) / side * GROUP_SIDE;
}

bool targets_init(struct targets *out_targets, const struct gl *gl, int width, int height,
                  struct error *err)
{
    static const GLenum formats[OUT_KINDS] = {GL_RGBA8, GL_RGBA32F, GL_R32UI};
    struct targets targets = {.width = width, .height = height};
    bool complete = true;

    targets.geometry = make_texture(gl, GL_RGBA32F, width, height);
    targets.matter = make_texture(gl, GL_RGBA32UI, width, height);
    targets.more = make_texture(gl, GL_RGBA32UI, width, height);
    targets.radiance = make_texture(gl, GL_RGBA32F, width, height);
    targets.starts = make_texture(gl, GL_R32F, starts_side(width), starts_side(height));
    for (int i = 0; i < OUT_KINDS; i++) {
        targets.out[i] = make_texture(gl, formats[i], width, height);
        targets.out_buffers[i] = make_buffer(gl, targets.out[i]);
        complete = complete && check_buffer(gl, targets.out_buffers[i]);
    }
    /* The same state in every context: drivers compile anew for another one. */
    gl->Disable(GL_DITHER);
    gl->GenVertexArrays(1, &targets.vertices);
    gl->BindVertexArray(targets.vertices);
    if (!gl_check(gl, "making targets", err)) {
        goto fail;
    }
    if (!complete) {
        error_set(err, ERROR_UNAVAILABLE, "", "the driver cannot draw into the formats needed");
        goto fail;
    }
    *out_targets = targets;
    return true;
fail:
    targets_finish(&targets, gl);
    return false;
}

void targets_finish(struct targets *targets, const struct gl *gl)
{
    const GLuint textures[] = {targets->geometry, targets->matter, targets->more, targets->radiance,
                               targets->starts};

    gl->DeleteFramebuffers(OUT_KINDS, targets->out_buffers);
    gl->DeleteTextures(5, textures);
    gl->DeleteTextures(OUT_KINDS, targets->out);
    gl->DeleteVertexArrays(1, &targets->vertices);
    *targets = (struct targets){0};
}

void targets_bind(const struct targets *targets, const struct gl *gl)
{
    const struct {
        GLuint texture;
        GLenum unit;
        GLuint image;
        GLenum format;
    } rows[] = {
        {targets->geometry, UNIT_GEOMETRY, IMAGE_GEOMETRY, GL_RGBA32F},
        {targets->matter, UNIT_MATTER, IMAGE_MATTER, GL_RGBA32UI},
        {targets->more, UNIT_MORE, IMAGE_MORE, GL_RGBA32UI},
        {targets->radiance, UNIT_RADIANCE, IMAGE_RADIANCE, GL_RGBA32F},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + rows[i].unit);
        gl->BindTexture(GL_TEXTURE_2D, rows[i].texture);
        gl->BindImageTexture(rows[i].image, rows[i].texture, 0, GL_FALSE, 0, GL_WRITE_ONLY,
                             rows[i].format);
    }
    gl->BindImageTexture(IMAGE_STARTS, targets->starts, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
}
