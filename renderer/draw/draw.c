/* SPDX-License-Identifier: MIT */
/* Outputs, tiles and rounds of a picture, whatever draws it. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "draw_internal.h"
#include "pace.h"
#include "protocol/memory.h"

enum {
    /* Of 64, 128, 256 and 512 none was clearly faster on two llvmpipe threads; with this one an
     * urgent picture waits for about a tenth of a second. A GPU wants more work at once. */
    TILE_SOFTWARE = 256,
    TILE_GPU = 512,
    TILE_LEAST = 64,  /* for many samples of all pixels, where that is fast */
    FIRST_ROUND = 4,  /* samples, where a picture is drawn in rounds; */
    ROUND_GROWTH = 4, /* each next one has so many times as many */
    MARGIN = 1,       /* pixels around a tile, which edges are found by */
};

#define BYTES OUT_BYTES, GL_RGBA, GL_UNSIGNED_BYTE, 4
#define FLOATS_1 OUT_FLOATS, GL_RED, GL_FLOAT, 4
#define FLOATS_3 OUT_FLOATS, GL_RGB, GL_FLOAT, 12
#define FLOATS_4 OUT_FLOATS, GL_RGBA, GL_FLOAT, 16

static const struct output_format formats[] = {
    {AOV_COLOR, false, OUT_COLOR, BYTES, STAGE_COUNT},
    {AOV_COLOR, true, OUT_LINEAR, FLOATS_4, STAGE_COUNT},
    {AOV_DEPTH, false, OUT_DEPTH, FLOATS_1, STAGE_MARCH},
    {AOV_DEPTH, true, OUT_DEPTH, FLOATS_1, STAGE_MARCH},
    {AOV_NORMAL, false, OUT_NORMAL, BYTES, STAGE_MARCH},
    {AOV_NORMAL, true, OUT_NORMAL_RAW, FLOATS_3, STAGE_MARCH},
    {AOV_POSITION, true, OUT_POSITION, FLOATS_3, STAGE_MARCH},
    {AOV_ID, false, OUT_ID, BYTES, STAGE_MATERIAL},
    {AOV_ID, true, OUT_ID_RAW, OUT_UINTS, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, STAGE_MATERIAL},
    {AOV_STEPS, false, OUT_STEPS, BYTES, STAGE_MARCH},
    {AOV_STEPS, true, OUT_STEPS_RAW, FLOATS_1, STAGE_MARCH},
    {AOV_ALBEDO, false, OUT_ALBEDO, BYTES, STAGE_MATERIAL},
    {AOV_ALBEDO, true, OUT_ALBEDO_RAW, FLOATS_3, STAGE_MATERIAL},
    {AOV_SPECULAR, false, OUT_SPECULAR, BYTES, STAGE_MATERIAL},
    {AOV_SPECULAR, true, OUT_SPECULAR_RAW, FLOATS_3, STAGE_MATERIAL},
    {AOV_OPTICAL, false, OUT_OPTICAL, BYTES, STAGE_MATERIAL},
    {AOV_OPTICAL, true, OUT_OPTICAL_RAW, FLOATS_4, STAGE_MATERIAL},
    {AOV_SHADOW, false, OUT_SHADOW, BYTES, STAGE_SHADOW},
    {AOV_SHADOW, true, OUT_SHADOW_RAW, FLOATS_3, STAGE_SHADOW},
    {AOV_OCCLUSION, false, OUT_OCCLUSION, BYTES, STAGE_SHADOW},
    {AOV_OCCLUSION, true, OUT_OCCLUSION_RAW, FLOATS_1, STAGE_SHADOW},
};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

const struct output_format *output_format_find(enum aov aov, bool floats)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        if (formats[i].aov == aov && formats[i].floats == floats) {
            return &formats[i];
        }
    }
    return NULL;
}

struct draw *draw_create(const struct gl *gl, bool software, int tile_side)
{
    struct draw *draw = memory_alloc(1, sizeof *draw);

    draw->gl = gl;
    draw->software = software;
    draw->cubes = engine_cubes_create();
    draw->side = tile_side > 0 ? tile_side : software ? TILE_SOFTWARE : TILE_GPU;
    return draw;
}

bool draw_prepare(struct draw *draw, enum shader_kind shader_kind, struct error *err)
{
    if (!draw->prepared[shader_kind]) {
        draw->prepared[shader_kind] = shader_kind == SHADER_FRAGMENT
                                          ? draw_fragment_prepare(draw, err)
                                          : draw_compute_prepare(draw, err);
        draw->gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    }
    return draw->prepared[shader_kind];
}

void draw_destroy(struct draw *draw)
{
    if (!draw) {
        return;
    }
    for (int i = 0; i < SHADER_KINDS * OUTPUT_COUNT; i++) {
        pass_finish(&draw->resolve[i / OUTPUT_COUNT][i % OUTPUT_COUNT], draw->gl);
    }
    if (draw->prepared[SHADER_COMPUTE]) {
        draw_compute_finish(draw);
    }
    if (draw->prepared[SHADER_FRAGMENT]) {
        draw_fragment_finish(draw);
    }
    engine_cubes_destroy(draw->cubes);
    free(draw);
}

void draw_forget(struct draw *draw)
{
    engine_cubes_forget(draw->cubes);
}

void draw_set_pause(struct draw *draw, const struct engine_pause *pause)
{
    draw->pause = *pause;
}

uint64_t draw_compilations(const struct draw *draw)
{
    return draw->compilations;
}

uint64_t draw_rays(const struct draw *draw)
{
    uint64_t together = draw->more_rays;

    for (int i = 0; i < DRAW_SETS; i++) {
        together += draw->rays[i];
    }
    return together;
}

uint64_t draw_pixels(const struct draw *draw)
{
    return draw->pixels;
}

/* --- a picture --- */

int draw_margin(const struct render_settings *settings)
{
    return settings->antialiasing == ANTIALIASING_EDGES ||
                   settings->antialiasing == ANTIALIASING_ADAPTIVE
               ? MARGIN
               : 0;
}

enum draw_set draw_set_of(const struct draw_picture *picture)
{
    return draw_is_sampled(picture) ? DRAW_SET_SAMPLED : DRAW_SET_ONCE;
}

enum program_stage draw_last_stage(const struct draw_picture *picture)
{
    enum program_stage last = STAGE_MARCH;

    for (int i = 0; i < AOV_COUNT; i++) {
        const struct output_format *format = picture->formats[i];
        last = format && format->last > last ? format->last : last;
    }
    return last;
}

uint64_t draw_now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

/* What a tile and its margin fit into. */
static int largest_side(const struct draw *draw, const struct render_settings *settings)
{
    const bool full = settings->antialiasing == ANTIALIASING_FULL;
    int side = draw->side;

    for (int samples = full ? settings->samples : 1; samples > 4 && side > TILE_LEAST;
         samples /= 4) {
        side /= 2;
    }
    return side;
}

int draw_tile_side(const struct draw *draw, const struct draw_picture *picture, int doublings)
{
    const int side = PACE_MIN << doublings, most = largest_side(draw, &picture->settings);

    if (draw_picture_pauses(picture)) {
        return side < most ? side : most;
    }
    return side < most ? side - 2 * draw_margin(&picture->settings) : most - 2 * MARGIN;
}

static const struct draw_backend *backend_of(const struct draw_scene *scene)
{
    return scene->engine                         ? &draw_engine
           : program_is_fragment(scene->program) ? &draw_fragment
                                                 : &draw_compute;
}

bool draw_begin(struct draw *draw, struct draw_picture *out, const struct frame_uniforms *block,
                const struct output_format *const wanted[AOV_COUNT],
                const struct render_settings *settings, const struct draw_scene *scene,
                struct error *err)
{
    struct draw_picture picture = {.backend = backend_of(scene),
                                   .settings = *settings,
                                   .until = settings->samples,
                                   .lights = block->light_count,
                                   .transmissive = block->has_transmissive};

    for (int i = 0; i < AOV_COUNT; i++) {
        picture.formats[i] = wanted[i];
    }
    if (!picture.backend->begin(draw, &picture, scene, block, err)) {
        draw_end(draw, &picture);
        return false;
    }
    *out = picture;
    return true;
}

void draw_end(struct draw *draw, struct draw_picture *picture)
{
    picture->backend->end(draw, picture);
    draw->kept_pixels -= picture->kept_pixels;
    *picture = (struct draw_picture){0};
}

/* --- rounds --- */

void draw_in_rounds(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    const long pixels = (long)region.width * region.height;

    if (picture->settings.samples > FIRST_ROUND && pixels <= DRAW_ROUNDS_PIXELS &&
        draw->kept_pixels + pixels <= DRAW_ROUNDS_TOGETHER) {
        picture->backend->keep(draw, picture, region);
        draw->kept_pixels += picture->kept_pixels = pixels;
        picture->until = FIRST_ROUND;
    }
}

bool draw_next_round(struct draw_picture *picture)
{
    const int all = picture->settings.samples;

    picture->from = picture->until;
    picture->until = ROUND_GROWTH * picture->from < all ? ROUND_GROWTH * picture->from : all;
    return picture->from < all;
}

struct picture_rounds draw_rounds(const struct draw_picture *picture)
{
    struct picture_rounds rounds = {.done = picture->from >= picture->settings.samples, .count = 1};

    for (int samples = FIRST_ROUND; picture->kept_pixels > 0 && samples < picture->settings.samples;
         samples *= ROUND_GROWTH) {
        rounds.count++;
        rounds.done += picture->from >= samples;
    }
    return rounds;
}

bool draw_picture_pauses(const struct draw_picture *picture)
{
    return picture->backend == &draw_engine;
}

bool draw_is_sampled(const struct draw_picture *picture)
{
    return picture->settings.samples > 1 && picture->formats[AOV_COLOR];
}

/* --- a tile --- */

bool draw_tile(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
               struct tile tile, int index, struct error *err)
{
    picture->slots[index].tile = tile;
    return picture->backend->draw(draw, picture, scene, index, err);
}

bool draw_tile_more(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                    int index, struct error *err)
{
    return picture->backend->more(draw, picture, scene, index, err);
}

bool draw_wait(struct draw *draw, struct draw_picture *picture, int index, struct error *err)
{
    return picture->backend->wait(draw, picture, index, err);
}

bool draw_collect(struct draw *draw, struct draw_picture *picture, int index, enum aov aov,
                  uint8_t *to, size_t stride, struct error *err)
{
    return picture->backend->collect(draw, picture, index, aov, to, stride, err);
}
