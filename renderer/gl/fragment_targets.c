/* SPDX-License-Identifier: MIT */
#include "fragment_targets.h"

#include "targets.h"

static bool make_buffers(struct fragment_targets *targets, const struct gl *gl)
{
    GLuint *buffers = targets->buffers;

    buffers[FRAGMENT_STARTS] = framebuffer_create(gl, &targets->starts, 1);
    buffers[FRAGMENT_SAMPLES] = framebuffer_create(gl, targets->samples, SAMPLE_TEXTURE_COUNT);
    buffers[FRAGMENT_MASK] = framebuffer_create(gl, &targets->mask, 1);
    buffers[FRAGMENT_RAYS] = framebuffer_create(gl, &targets->rays, 1);
    for (int i = 0; i < FRAGMENT_TARGETS; i++) {
        if (!buffers[i]) {
            return false;
        }
    }
    return outputs_init(&targets->outputs, gl, targets->side);
}

bool fragment_targets_init(struct fragment_targets *out_targets, const struct gl *gl, int side,
                           struct error *err)
{
    const int blocks = targets_starts_side(side);
    struct fragment_targets targets = {.side = side};

    for (int i = 0; i < SAMPLE_TEXTURE_COUNT; i++) {
        targets.samples[i] = texture_create(gl, GL_RGBA32F, side, side);
    }
    targets.starts = texture_create(gl, GL_R32F, blocks, blocks);
    targets.mask = texture_create(gl, GL_R32F, side, side);
    targets.rays = texture_create(gl, GL_R32F, side, 1);
    const bool complete = make_buffers(&targets, gl);
    gl->Disable(GL_DITHER);
    gl->GenVertexArrays(1, &targets.vertices);
    if (gl_check(gl, "making targets of fragment shaders", err) &&
        (complete ||
         error_set(err, ERROR_UNAVAILABLE, "", "the driver cannot draw into the formats needed"))) {
        *out_targets = targets;
        return true;
    }
    fragment_targets_finish(&targets, gl);
    return false;
}

void fragment_targets_finish(struct fragment_targets *targets, const struct gl *gl)
{
    gl->DeleteFramebuffers(FRAGMENT_TARGETS, targets->buffers);
    gl->DeleteTextures(SAMPLE_TEXTURE_COUNT, targets->samples);
    gl->DeleteTextures(1, &targets->starts);
    gl->DeleteTextures(1, &targets->mask);
    gl->DeleteTextures(1, &targets->rays);
    outputs_finish(&targets->outputs, gl);
    gl->DeleteVertexArrays(1, &targets->vertices);
    *targets = (struct fragment_targets){0};
}

void fragment_targets_bind(const struct fragment_targets *targets, const struct gl *gl)
{
    static const GLenum units[] = {
#define X(name, unit) [name] = unit,
        SAMPLE_TEXTURES(X)
#undef X
    };

    gl->BindVertexArray(targets->vertices);
    for (int i = 0; i < SAMPLE_TEXTURE_COUNT; i++) {
        texture_bind(gl, units[i], targets->samples[i]);
    }
    texture_bind(gl, UNIT_STARTS, targets->starts);
    texture_bind(gl, UNIT_MASK, targets->mask);
}

void fragment_targets_clear(const struct fragment_targets *targets, const struct gl *gl)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->buffers[FRAGMENT_SAMPLES]);
    gl->Clear(GL_COLOR_BUFFER_BIT);
}

/* Blocks lie where they do in the whole picture, so a tile may touch one more than it is long. */
static int blocks_of(int length)
{
    return (length + 2 * BLOCK_SIDE - 1) / BLOCK_SIDE;
}

void fragment_targets_draw(const struct fragment_targets *targets, const struct gl *gl,
                           enum fragment_target target, const struct pass *pass,
                           const struct dispatch_args *dispatch, struct pass_args args)
{
    const bool starts = target == FRAGMENT_STARTS;
    const int width = starts ? blocks_of(dispatch->width) : dispatch->width;
    const int height = starts                    ? blocks_of(dispatch->height)
                       : target == FRAGMENT_RAYS ? 1
                                                 : dispatch->height;

    gl->BindFramebuffer(GL_FRAMEBUFFER, targets->buffers[target]);
    gl->Viewport(0, 0, width, height);
    if (target == FRAGMENT_SAMPLES) {
        gl->Enable(GL_BLEND);
        gl->BlendFunc(GL_ONE, GL_ONE);
    }
    pass_draw(pass, gl, dispatch, args);
    gl->Disable(GL_BLEND);
}
