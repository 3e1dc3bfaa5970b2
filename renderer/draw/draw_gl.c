/* SPDX-License-Identifier: MIT */
#include "draw_gl.h"

#include <stdio.h>
#include <string.h>

#include "renderer/gl/tape_texture.h"
#include "tile_clock.h"

enum { FENCE_WAIT_MS = 60000 }; /* beyond it the device is taken for lost */

/* The resolve pass of a format. */
static bool link_resolve(struct draw *draw, enum shader_kind shader_kind,
                         const struct output_format *format, struct error *err)
{
    static const struct glsl_file met[SHADER_KINDS][2] = {
        [SHADER_COMPUTE] = {{"met_load.glsl", "#include \"met_passes.glsl\"\n"}},
        [SHADER_FRAGMENT] = {{"met_load.glsl", "#include \"met_sample.glsl\"\n"}}};
    struct pass *pass = &draw->resolve[shader_kind][format->output];
    char defines[32];

    if (pass->program != 0) {
        return true;
    }
    snprintf(defines, sizeof defines, "#define OUTPUT %d\n", (int)format->output);
    const struct pass_source source = {
        .defines = defines, .file = "resolve.glsl", .own = met[shader_kind]};
    draw->compilations++;
    return pass_init(pass, draw->gl, &source, err);
}

static void make_slot(const struct draw *draw, struct tile_in_flight *slot,
                      const struct output_format *const wanted[AOV_COUNT])
{
    const struct gl *gl = draw->gl;
    const GLsizeiptr pixels = (GLsizeiptr)draw->side * draw->side;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (wanted[i]) {
            gl->GenBuffers(1, &slot->buffers[i]);
            gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffers[i]);
            gl->BufferData(GL_PIXEL_PACK_BUFFER, pixels * wanted[i]->read_bytes, NULL,
                           GL_STREAM_READ);
        }
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

bool draw_gl_begin(struct draw *draw, struct draw_picture *picture, enum shader_kind shader_kind,
                   const struct frame_uniforms *block, struct error *err)
{
    const struct gl *gl = draw->gl;

    picture->shader_kind = shader_kind;
    if (!draw_prepare(draw, shader_kind, err)) {
        return false;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        if (picture->formats[i] && !link_resolve(draw, shader_kind, picture->formats[i], err)) {
            return false;
        }
    }
    gl->GenBuffers(1, &picture->frame);
    gl->BindBuffer(GL_UNIFORM_BUFFER, picture->frame);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof *block, block, GL_STATIC_DRAW);
    for (int i = 0; i < TILES_IN_FLIGHT; i++) {
        make_slot(draw, &picture->slots[i], picture->formats);
    }
    return gl_check(gl, "making the buffers of a picture", err);
}

void draw_gl_end(struct draw *draw, struct draw_picture *picture)
{
    const struct gl *gl = draw->gl;

    gl->DeleteBuffers(1, &picture->frame);
    gl->DeleteTextures(1, &picture->kept);
    gl->DeleteTextures(1, &picture->kept_counted);
    gl->DeleteFramebuffers(1, &picture->keeper);
    for (int i = 0; i < TILES_IN_FLIGHT; i++) {
        struct tile_in_flight *slot = &picture->slots[i];
        if (slot->fence) {
            gl->DeleteSync(slot->fence);
        }
        gl->DeleteBuffers(AOV_COUNT, slot->buffers);
        gl->DeleteBuffers(1, &slot->rays);
        gl->DeleteQueries(DRAW_MARKS, slot->queries);
    }
}

/* --- rounds --- */

void draw_gl_keep(struct draw *draw, struct draw_picture *picture, struct tile region,
                  GLenum counted)
{
    draw->gl->ActiveTexture(GL_TEXTURE0);
    picture->kept = texture_create(draw->gl, GL_RGBA32F, region.width, region.height);
    picture->kept_counted = texture_create(draw->gl, counted, region.width, region.height);
    draw->gl->GenFramebuffers(1, &picture->keeper);
    picture->left = region.x;
    picture->top = region.y;
}

void draw_gl_copy_kept(const struct gl *gl, const struct draw_picture *picture, struct tile tile,
                       GLuint pixels, GLuint counted, bool back)
{
    const int margin = draw_margin(&picture->settings);
    const int x = tile.x - picture->left, y = tile.y - picture->top;
    const GLuint ours[] = {picture->kept, picture->kept_counted}, targets[] = {pixels, counted};

    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, picture->keeper);
    for (int i = 0; i < 2; i++) {
        texture_bind(gl, UNIT_COUNT, back ? targets[i] : ours[i]);
        gl->FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                                 back ? ours[i] : targets[i], 0);
        if (back) {
            gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, margin, margin, x, y, tile.width, tile.height);
        } else {
            gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, x, y, margin, margin, tile.width, tile.height);
        }
    }
}

/* --- a tile --- */

struct dispatch_args draw_gl_dispatch(const struct draw_picture *picture,
                                      const struct tile_in_flight *slot)
{
    const int margin = draw_margin(&picture->settings);

    return (struct dispatch_args){.x = slot->tile.x - margin,
                                  .y = slot->tile.y - margin,
                                  .width = slot->tile.width + 2 * margin,
                                  .height = slot->tile.height + 2 * margin};
}

void draw_gl_bind(const struct draw *draw, const struct draw_picture *picture,
                  const struct draw_scene *scene)
{
    const struct gl *gl = draw->gl;

    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, picture->frame);
    param_buffer_bind(scene->params, gl);
    if (scene->tapes) {
        tape_texture_bind(scene->tapes, gl);
    }
    environment_bind(scene->environment, gl);
}

/* --- the way back --- */

void draw_gl_read(const struct gl *gl, GLuint buffer, int width, int height, GLenum format,
                  GLenum type)
{
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
    gl->ReadPixels(0, 0, width, height, format, type, NULL);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void draw_gl_resolve(struct draw *draw, const struct draw_picture *picture,
                     const struct tile_in_flight *slot, const struct outputs *outputs,
                     const struct output_format *format)
{
    const struct gl *gl = draw->gl;
    const struct render_settings *settings = &picture->settings;
    const struct dispatch_args dispatch = draw_gl_dispatch(picture, slot);

    gl->Viewport(0, 0, slot->tile.width, slot->tile.height);
    gl->BindFramebuffer(GL_FRAMEBUFFER, outputs->buffers[format->kind]);
    pass_draw(&draw->resolve[picture->shader_kind][format->output], gl, &dispatch,
              PASS_ARGS(struct resolve_args, .margin = draw_margin(settings),
                        .blend_edges = settings->antialiasing == ANTIALIASING_EDGES));
    draw_gl_read(gl, slot->buffers[format->aov], slot->tile.width, slot->tile.height,
                 format->read_format, format->read_type);
}

void draw_gl_send(struct draw *draw, struct tile_in_flight *slot)
{
    slot->fence = draw->gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    draw->gl->Flush();
    slot->samples = 0;
}

bool draw_gl_wait(const struct draw *draw, struct tile_in_flight *slot, struct error *err)
{
    const struct gl *gl = draw->gl;
    const GLenum got = gl->ClientWaitSync(slot->fence, GL_SYNC_FLUSH_COMMANDS_BIT,
                                          (GLuint64)FENCE_WAIT_MS * 1000000);

    gl->DeleteSync(slot->fence);
    slot->fence = NULL;
    if (gl->GetGraphicsResetStatus && gl->GetGraphicsResetStatus() != GL_NO_ERROR) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the graphics device was reset");
    }
    if (got != GL_ALREADY_SIGNALED && got != GL_CONDITION_SATISFIED) {
        return error_set(err, ERROR_UNAVAILABLE, "", "a tile was not drawn within %d s",
                         FENCE_WAIT_MS / 1000);
    }
    tile_clock_fetch(gl, slot);
    return true;
}

bool draw_gl_collect(struct draw *draw, struct draw_picture *picture, int index, enum aov aov,
                     uint8_t *to, size_t stride, struct error *err)
{
    const struct gl *gl = draw->gl;
    struct tile_in_flight *slot = &picture->slots[index];
    const size_t row = (size_t)slot->tile.width * (size_t)picture->formats[aov]->read_bytes;
    const uint64_t start = draw_now_us();
    const uint8_t *from;

    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffers[aov]);
    from = gl->MapBufferRange(GL_PIXEL_PACK_BUFFER, 0,
                              (GLsizeiptr)(row * (size_t)slot->tile.height), GL_MAP_READ_BIT);
    if (from) {
        for (int y = 0; y < slot->tile.height; y++) {
            memcpy(to + (size_t)y * stride, from + (size_t)y * row, row);
        }
        gl->UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    slot->stage_us[FRAME_READ] += draw_now_us() - start;
    return from ? gl_check(gl, "reading pixels", err)
                : error_set(err, ERROR_UNAVAILABLE, "", "the pixels of a tile cannot be mapped");
}
