/* SPDX-License-Identifier: MIT */
/* Pictures drawn by the device: passes over a tile, timing, read-back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_parts.h"
#include "protocol/memory.h"
#include "wave.h"

enum {
    /* Of 64, 128, 256 and 512 none was clearly faster on two llvmpipe threads; with this one an
     * urgent picture waits for about a tenth of a second. A GPU wants more work at once. */
    TILE_SOFTWARE = 256,
    TILE_GPU = 512,
    FENCE_WAIT_MS = 60000, /* beyond it the device is taken for lost */
};

struct draw *draw_create(const struct gl *gl, bool software, int tile_side)
{
    struct draw *draw = memory_alloc(1, sizeof *draw);

    draw->gl = gl;
    draw->software = software;
    draw->side = tile_side > 0 ? tile_side : software ? TILE_SOFTWARE : TILE_GPU;
    return draw;
}

static void forget_targets(struct draw *draw)
{
    common_finish(&draw->common, draw->gl);
    for (int i = 0; i < DRAW_SETS; i++) {
        targets_finish(&draw->targets[i], draw->gl);
    }
    memset(&draw->common, 0, sizeof draw->common);
    memset(draw->targets, 0, sizeof draw->targets);
}

bool draw_prepare(struct draw *draw, struct error *err)
{
    bool ok = true;

    if (draw->prepared) {
        return true;
    }
    for (int i = 0; ok && i < DRAW_SETS; i++) {
        ok = targets_init(&draw->targets[i], draw->gl, draw->side, err);
    }
    if (!ok || !common_init(&draw->common, draw->gl, err)) {
        forget_targets(draw);
        return false;
    }
    draw->prepared = true;
    draw->compilations += COMMON_COUNT;
    draw->gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    return true;
}

void draw_destroy(struct draw *draw)
{
    if (!draw) {
        return;
    }
    for (size_t i = 0; i < OUTPUT_COUNT; i++) {
        pass_finish(&draw->resolve[i], draw->gl);
    }
    forget_targets(draw);
    free(draw);
}

uint64_t draw_compilations(const struct draw *draw)
{
    return draw->compilations;
}

uint64_t draw_rays(const struct draw *draw)
{
    uint64_t together = draw->engine_rays;

    for (int i = 0; i < DRAW_SETS; i++) {
        together += draw->rays[i];
    }
    return together;
}

/* The resolve pass of a form. */
static struct pass *resolve_pass(struct draw *draw, const struct draw_form *form, struct error *err)
{
    struct pass *pass = &draw->resolve[form->output];
    char defines[32];

    if (pass->program == 0) {
        snprintf(defines, sizeof defines, "#define OUTPUT %d\n", (int)form->output);
        const struct pass_source source = {.defines = defines, .file = "resolve.glsl"};
        if (!pass_init(pass, draw->gl, &source, err)) {
            return NULL;
        }
        draw->compilations++;
    }
    return pass;
}

static void make_slot(const struct draw *draw, struct draw_slot *slot,
                      const struct draw_form *const wanted[AOV_COUNT])
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

static bool begin(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_block *block, struct error *err)
{
    const struct gl *gl = draw->gl;

    (void)scene;
    if (!draw_prepare(draw, err)) {
        return false;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        if (picture->forms[i] && !resolve_pass(draw, picture->forms[i], err)) {
            return false;
        }
    }
    gl->GenBuffers(1, &picture->frame);
    gl->BindBuffer(GL_UNIFORM_BUFFER, picture->frame);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof *block, block, GL_STATIC_DRAW);
    for (int i = 0; i < DRAW_SLOTS; i++) {
        make_slot(draw, &picture->slots[i], picture->forms);
    }
    return gl_check(gl, "making the buffers of a picture", err);
}

static void end(struct draw *draw, struct draw_picture *picture)
{
    const struct gl *gl = draw->gl;

    gl->DeleteBuffers(1, &picture->frame);
    gl->DeleteTextures(1, &picture->kept);
    gl->DeleteTextures(1, &picture->kept_counted);
    for (int i = 0; i < DRAW_SLOTS; i++) {
        struct draw_slot *slot = &picture->slots[i];
        if (slot->fence) {
            gl->DeleteSync(slot->fence);
        }
        gl->DeleteBuffers(AOV_COUNT, slot->buffers);
        gl->DeleteQueries(DRAW_MARKS, slot->queries);
    }
}

/* --- rounds --- */

static GLuint make_kept(const struct gl *gl, GLenum format, struct tile region)
{
    GLuint texture = 0;

    gl->GenTextures(1, &texture);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, format, region.width, region.height);
    return texture;
}

static void keep_rounds(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    picture->kept = make_kept(draw->gl, GL_RGBA32F, region);
    picture->kept_counted = make_kept(draw->gl, GL_R32F, region);
    picture->left = region.x;
    picture->top = region.y;
}

/* The tile's pixels and how many samples they have: from the targets, or back into them. */
static void keep(const struct wave *wave, const struct draw_picture *picture, bool back)
{
    const struct tile tile = wave->slot->tile;
    const int margin = draw_margin(wave->plan);
    const int x = tile.x - picture->left, y = tile.y - picture->top;
    const GLuint ours[] = {picture->kept, picture->kept_counted};
    const GLuint targets[] = {wave->targets->pixels, wave->targets->counted};

    for (int i = 0; i < 2; i++) {
        if (back) {
            wave->gl->CopyImageSubData(ours[i], GL_TEXTURE_2D, 0, x, y, 0, targets[i],
                                       GL_TEXTURE_2D, 0, margin, margin, 0, tile.width, tile.height,
                                       1);
        } else {
            wave->gl->CopyImageSubData(targets[i], GL_TEXTURE_2D, 0, margin, margin, 0, ours[i],
                                       GL_TEXTURE_2D, 0, x, y, 0, tile.width, tile.height, 1);
        }
    }
}

/* --- a tile --- */

/* One output becomes pixels and starts on its way back. */
static void resolve(struct draw *draw, const struct wave *wave, const struct draw_form *form)
{
    const struct gl *gl = draw->gl;
    const struct draw_slot *slot = wave->slot;
    const struct draw_plan *plan = wave->plan;

    targets_bind_common(wave->targets, gl, &wave->targets->eye, &wave->targets->eye);
    gl->Viewport(0, 0, slot->tile.width, slot->tile.height);
    gl->BindFramebuffer(GL_FRAMEBUFFER, wave->targets->out_buffers[form->kind]);
    pass_draw(&draw->resolve[form->output], gl, &wave->tile,
              PASS_ARGS(struct resolve_args, .margin = draw_margin(plan),
                        .blend_edges = plan->antialiasing == ANTIALIASING_EDGES));
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffers[form->aov]);
    gl->ReadPixels(0, 0, slot->tile.width, slot->tile.height, form->read_format, form->read_type,
                   NULL);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

/* Those outputs that wait for nothing after the stages from `first` to `last`. */
static void resolve_after(struct draw *draw, struct wave *wave, const struct draw_picture *picture,
                          enum program_stage first, enum program_stage last)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct draw_form *form = picture->forms[i];
        if (form && form->last >= first && form->last <= last) {
            resolve(draw, wave, form);
        }
    }
    wave_mark(wave, FRAME_RESOLVE);
}

static void draw_passes(struct draw *draw, struct wave *wave, const struct draw_picture *picture)
{
    const enum program_stage last = draw_last_stage(picture);

    wave_find(wave, last);
    resolve_after(draw, wave, picture, STAGE_MARCH, STAGE_MATTER);
    if (last >= STAGE_SHADOW) {
        wave_shadow(wave);
        resolve_after(draw, wave, picture, STAGE_SHADOW, STAGE_SHADOW);
    }
    if (last == STAGE_COUNT) {
        wave_shade(wave);
    }
    if (last == STAGE_COUNT && wave->plan->antialiasing == ANTIALIASING_ADAPTIVE) {
        wave_find_edges(wave);
    }
}

static bool draw_from_camera(struct wave *wave, struct program *program, struct error *err)
{
    const struct pass *pass = program_from_camera(program, err);

    if (!pass) {
        return false;
    }
    wave_from_camera(wave, pass);
    return true;
}

static enum draw_set set_of(const struct draw_picture *picture)
{
    return draw_is_sampled(picture) ? DRAW_SET_SAMPLED : DRAW_SET_ONCE;
}

static void bind_scene(const struct draw *draw, const struct draw_picture *picture,
                       const struct draw_scene *scene)
{
    const struct gl *gl = draw->gl;

    targets_bind(&draw->targets[set_of(picture)], gl);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, picture->frame);
    numbers_bind(scene->numbers, gl);
    environment_bind(scene->environment, gl);
}

static struct wave make_wave(const struct draw *draw, struct draw_picture *picture,
                             const struct draw_scene *scene, int index)
{
    struct draw_slot *slot = &picture->slots[index];
    const int margin = draw_margin(&picture->plan);

    return (struct wave){
        .gl = draw->gl,
        .software = draw->software,
        .targets = &draw->targets[set_of(picture)],
        .common = &draw->common,
        .program = scene->program,
        .plan = &picture->plan,
        .lights = picture->lights,
        .clear = picture->clear,
        .linear = picture->forms[AOV_COLOR] && picture->forms[AOV_COLOR]->floats,
        .tile = {.x = slot->tile.x - margin,
                 .y = slot->tile.y - margin,
                 .width = slot->tile.width + 2 * margin,
                 .height = slot->tile.height + 2 * margin},
        .slot = slot,
    };
}

/* All samples are there, or none is wanted: the tile's pixels start on their way back. */
static void finish_tile(struct draw *draw, struct wave *wave, const struct draw_picture *picture)
{
    resolve_after(draw, wave, picture, STAGE_COUNT, STAGE_COUNT);
    if (picture->kept && picture->until < picture->plan.samples) {
        keep(wave, picture, false);
    }
    wave->slot->fence = draw->gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    draw->gl->Flush();
    wave->slot->samples = 0;
}

static bool draw_tile_passes(struct draw *draw, struct draw_picture *picture,
                             const struct draw_scene *scene, int index, struct error *err)
{
    const struct draw_plan *plan = &picture->plan;
    struct wave wave = make_wave(draw, picture, scene, index);

    bind_scene(draw, picture, scene);
    wave_start_clock(&wave);
    if (picture->from > 0) {
        keep(&wave, picture, true);
        wave_resume(&wave, picture->from);
        wave.slot->samples = picture->from;
        return gl_check(draw->gl, "going on with a tile", err);
    }
    if (!plan->from_camera) {
        draw_passes(draw, &wave, picture);
    } else if (!draw_from_camera(&wave, scene->program, err)) {
        return false;
    }
    if (draw_is_sampled(picture)) {
        wave.slot->samples = 1;
    } else {
        finish_tile(draw, &wave, picture);
    }
    return gl_check(draw->gl, "drawing a tile", err);
}

static bool sample_again(struct draw *draw, struct draw_picture *picture,
                         const struct draw_scene *scene, int index, struct error *err)
{
    struct wave wave = make_wave(draw, picture, scene, index);
    struct draw_slot *slot = wave.slot;

    bind_scene(draw, picture, scene);
    wave_resume_clock(&wave);
    if (!wave_sample_again(&wave, slot->samples) || ++slot->samples == picture->until) {
        finish_tile(draw, &wave, picture);
    }
    return gl_check(draw->gl, "drawing a tile again", err);
}

/* --- the way back --- */

static bool wait_fence(const struct draw *draw, struct draw_slot *slot, struct error *err)
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
    return true;
}

static void fetch_times(const struct draw *draw, struct draw_slot *slot)
{
    GLuint64 before = 0;

    for (int i = 0; i < slot->marks; i++) {
        GLuint64 ns = 0;
        draw->gl->GetQueryObjectui64v(slot->queries[i], GL_QUERY_RESULT, &ns);
        if (i > 0) {
            slot->stage_us[slot->stages[i]] += (ns - before) / 1000;
        }
        before = ns;
    }
}

/* The counter in the stack's head runs through all tiles, and over. */
static void count_rays(struct draw *draw, enum draw_set set)
{
    uint32_t count = 0;

    draw->gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, draw->targets[set].stack);
    draw->gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof count, &count);
    draw->rays[set] += count - (uint32_t)draw->rays[set];
}

static bool wait_for_tile(struct draw *draw, struct draw_picture *picture, int index,
                          struct error *err)
{
    struct draw_slot *slot = &picture->slots[index];
    const uint64_t start = draw_now_us();

    if (!wait_fence(draw, slot, err)) {
        return false;
    }
    fetch_times(draw, slot);
    if (picture->plan.rays > 0) {
        count_rays(draw, set_of(picture));
    }
    slot->stage_us[FRAME_READ] += draw_now_us() - start;
    return true;
}

static bool read_back(struct draw *draw, struct draw_picture *picture, int index, enum aov aov,
                      uint8_t *to, size_t stride, struct error *err)
{
    const struct gl *gl = draw->gl;
    struct draw_slot *slot = &picture->slots[index];
    const size_t row = (size_t)slot->tile.width * (size_t)picture->forms[aov]->read_bytes;
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

const struct draw_backend draw_device = {
    begin, end, keep_rounds, draw_tile_passes, sample_again, wait_for_tile, read_back,
};
