/* SPDX-License-Identifier: MIT */
/* Pictures drawn by compute shaders: passes over a tile. */
#include <string.h>

#include "draw_gl.h"
#include "tile_clock.h"
#include "wavefront.h"

void draw_compute_finish(struct draw *draw)
{
    static_programs_finish(&draw->static_programs, draw->gl);
    for (int i = 0; i < DRAW_SETS; i++) {
        targets_finish(&draw->targets[i], draw->gl);
    }
    memset(&draw->static_programs, 0, sizeof draw->static_programs);
    memset(draw->targets, 0, sizeof draw->targets);
}

bool draw_compute_prepare(struct draw *draw, struct error *err)
{
    bool ok = true;

    for (int i = 0; ok && i < DRAW_SETS; i++) {
        ok = targets_init(&draw->targets[i], draw->gl, draw->side, err);
    }
    if (!ok || !static_programs_init(&draw->static_programs, draw->gl, err)) {
        draw_compute_finish(draw);
        return false;
    }
    draw->compilations += STATIC_COUNT;
    return true;
}

static bool begin(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_uniforms *block, struct error *err)
{
    (void)scene;
    return draw_gl_begin(draw, picture, SHADER_COMPUTE, block, err);
}

static void keep_rounds(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    draw_gl_keep(draw, picture, region, GL_RG32F);
}

/* The tile's sums: from the targets, or back into them. */
static void keep(const struct wavefront *wavefront, const struct draw_picture *picture, bool back)
{
    /* What shaders have written is copied by a framebuffer. */
    wavefront->gl->MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    draw_gl_copy_kept(wavefront->gl, picture, wavefront->slot->tile, wavefront->targets->pixels,
                      wavefront->targets->counted, back);
}

/* --- a tile --- */

/* Those outputs that wait for nothing after the stages from `first` to `last`. */
static void resolve_after(struct draw *draw, struct wavefront *wavefront,
                          const struct draw_picture *picture, enum program_stage first,
                          enum program_stage last)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct output_format *format = picture->formats[i];
        if (format && format->last >= first && format->last <= last) {
            targets_bind_static(wavefront->targets, wavefront->gl, &wavefront->targets->eye,
                                &wavefront->targets->eye);
            draw_gl_resolve(draw, picture, wavefront->slot, &wavefront->targets->outputs, format);
        }
    }
    wavefront_mark(wavefront, FRAME_RESOLVE);
}

static void draw_passes(struct draw *draw, struct wavefront *wavefront,
                        const struct draw_picture *picture)
{
    const enum program_stage last = draw_last_stage(picture);

    wavefront_find(wavefront, last);
    resolve_after(draw, wavefront, picture, STAGE_MARCH, STAGE_MATERIAL);
    if (last >= STAGE_SHADOW) {
        wavefront_shadow(wavefront);
        resolve_after(draw, wavefront, picture, STAGE_SHADOW, STAGE_SHADOW);
    }
    if (last == STAGE_COUNT) {
        wavefront_shade(wavefront);
    }
    if (last == STAGE_COUNT && wavefront->settings->antialiasing == ANTIALIASING_ADAPTIVE) {
        wavefront_detect_edges(wavefront);
    }
}

static struct wavefront make_wavefront(const struct draw *draw, struct draw_picture *picture,
                                       const struct draw_scene *scene, int index)
{
    struct tile_in_flight *slot = &picture->slots[index];

    return (struct wavefront){
        .gl = draw->gl,
        .software = draw->software,
        .targets = &draw->targets[draw_set_of(picture)],
        .static_programs = &draw->static_programs,
        .program = scene->program,
        .settings = &picture->settings,
        .lights = picture->lights,
        .transmissive = picture->transmissive,
        .tile = draw_gl_dispatch(picture, slot),
        .slot = slot,
    };
}

/* All samples are there, or none is wanted: the tile's pixels start on their way back. */
static void finish_tile(struct draw *draw, struct wavefront *wavefront,
                        const struct draw_picture *picture)
{
    resolve_after(draw, wavefront, picture, STAGE_COUNT, STAGE_COUNT);
    if (picture->kept && picture->until < picture->settings.samples) {
        keep(wavefront, picture, false);
    }
    draw_gl_send(draw, wavefront->slot);
}

static bool draw_tile_passes(struct draw *draw, struct draw_picture *picture,
                             const struct draw_scene *scene, int index, struct error *err)
{
    struct wavefront wavefront = make_wavefront(draw, picture, scene, index);

    targets_bind(wavefront.targets, draw->gl);
    draw_gl_bind(draw, picture, scene);
    tile_clock_start(draw->gl, draw->software, wavefront.slot);
    if (picture->from > 0) {
        keep(&wavefront, picture, true);
        wavefront_resume(&wavefront, picture->from);
        wavefront.slot->samples = picture->from;
        return gl_check(draw->gl, "going on with a tile", err);
    }
    draw_passes(draw, &wavefront, picture);
    if (draw_is_sampled(picture)) {
        wavefront.slot->samples = 1;
    } else {
        finish_tile(draw, &wavefront, picture);
    }
    return gl_check(draw->gl, "drawing a tile", err);
}

static bool sample_again(struct draw *draw, struct draw_picture *picture,
                         const struct draw_scene *scene, int index, struct error *err)
{
    struct wavefront wavefront = make_wavefront(draw, picture, scene, index);
    struct tile_in_flight *slot = wavefront.slot;

    targets_bind(wavefront.targets, draw->gl);
    draw_gl_bind(draw, picture, scene);
    tile_clock_resume(draw->gl, draw->software, wavefront.slot);
    if (!wavefront_resample(&wavefront, slot->samples) || ++slot->samples == picture->until) {
        finish_tile(draw, &wavefront, picture);
    }
    return gl_check(draw->gl, "drawing a tile again", err);
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
    struct tile_in_flight *slot = &picture->slots[index];
    const uint64_t start = draw_now_us();

    if (!draw_gl_wait(draw, slot, err)) {
        return false;
    }
    if (picture->settings.rays > 0) {
        count_rays(draw, draw_set_of(picture));
    }
    slot->stage_us[FRAME_READ] += draw_now_us() - start;
    return true;
}

const struct draw_backend draw_compute = {
    begin, draw_gl_end, keep_rounds, draw_tile_passes, sample_again, wait_for_tile, draw_gl_collect,
};
