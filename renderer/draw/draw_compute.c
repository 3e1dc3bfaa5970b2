/* SPDX-License-Identifier: MIT */
/* Pictures drawn by compute shaders: passes over a tile. */
#include <string.h>

#include "draw_gl.h"
#include "tile_clock.h"
#include "wave.h"

void draw_compute_finish(struct draw *draw)
{
    common_finish(&draw->common, draw->gl);
    for (int i = 0; i < DRAW_SETS; i++) {
        targets_finish(&draw->targets[i], draw->gl);
    }
    memset(&draw->common, 0, sizeof draw->common);
    memset(draw->targets, 0, sizeof draw->targets);
}

bool draw_compute_prepare(struct draw *draw, struct error *err)
{
    bool ok = true;

    for (int i = 0; ok && i < DRAW_SETS; i++) {
        ok = targets_init(&draw->targets[i], draw->gl, draw->side, err);
    }
    if (!ok || !common_init(&draw->common, draw->gl, err)) {
        draw_compute_finish(draw);
        return false;
    }
    draw->compilations += COMMON_COUNT;
    return true;
}

static bool begin(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_block *block, struct error *err)
{
    (void)scene;
    return draw_gl_begin(draw, picture, ROAD_COMPUTE, block, err);
}

static void keep_rounds(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    draw_gl_keep(draw, picture, region, GL_RG32F);
}

/* The tile's sums: from the targets, or back into them. */
static void keep(const struct wave *wave, const struct draw_picture *picture, bool back)
{
    draw_gl_copy_kept(wave->gl, picture, wave->slot->tile, wave->targets->pixels,
                      wave->targets->counted, back);
}

/* --- a tile --- */

/* Those outputs that wait for nothing after the stages from `first` to `last`. */
static void resolve_after(struct draw *draw, struct wave *wave, const struct draw_picture *picture,
                          enum program_stage first, enum program_stage last)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct draw_form *form = picture->forms[i];
        if (form && form->last >= first && form->last <= last) {
            targets_bind_common(wave->targets, wave->gl, &wave->targets->eye, &wave->targets->eye);
            draw_gl_resolve(draw, picture, wave->slot, &wave->targets->outputs, form);
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

static struct wave make_wave(const struct draw *draw, struct draw_picture *picture,
                             const struct draw_scene *scene, int index)
{
    struct draw_slot *slot = &picture->slots[index];
    return (struct wave){
        .gl = draw->gl,
        .software = draw->software,
        .targets = &draw->targets[draw_set_of(picture)],
        .common = &draw->common,
        .program = scene->program,
        .plan = &picture->plan,
        .lights = picture->lights,
        .clear = picture->clear,
        .tile = draw_gl_place(picture, slot),
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
    draw_gl_send(draw, wave->slot);
}

static bool draw_tile_passes(struct draw *draw, struct draw_picture *picture,
                             const struct draw_scene *scene, int index, struct error *err)
{
    struct wave wave = make_wave(draw, picture, scene, index);

    targets_bind(wave.targets, draw->gl);
    draw_gl_bind(draw, picture, scene);
    tile_clock_start(draw->gl, draw->software, wave.slot);
    if (picture->from > 0) {
        keep(&wave, picture, true);
        wave_resume(&wave, picture->from);
        wave.slot->samples = picture->from;
        return gl_check(draw->gl, "going on with a tile", err);
    }
    draw_passes(draw, &wave, picture);
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

    targets_bind(wave.targets, draw->gl);
    draw_gl_bind(draw, picture, scene);
    tile_clock_resume(draw->gl, draw->software, wave.slot);
    if (!wave_sample_again(&wave, slot->samples) || ++slot->samples == picture->until) {
        finish_tile(draw, &wave, picture);
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
    struct draw_slot *slot = &picture->slots[index];
    const uint64_t start = draw_now_us();

    if (!draw_gl_wait(draw, slot, err)) {
        return false;
    }
    if (picture->plan.rays > 0) {
        count_rays(draw, draw_set_of(picture));
    }
    slot->stage_us[FRAME_READ] += draw_now_us() - start;
    return true;
}

const struct draw_backend draw_compute = {
    begin, draw_gl_end, keep_rounds, draw_tile_passes, sample_again, wait_for_tile, draw_gl_collect,
};
