/* SPDX-License-Identifier: MIT */
/* Pictures drawn by the engine. */
#include <stdlib.h>
#include <string.h>

#include "draw_internal.h"
#include "protocol/memory.h"
#include "renderer/engine/engine.h"

static enum engine_smoothing smoothing_of(const struct render_settings *settings)
{
    switch (settings->antialiasing) {
    case ANTIALIASING_EDGES:
        return ENGINE_BLEND;
    case ANTIALIASING_ADAPTIVE:
        return ENGINE_ADAPTIVE;
    case ANTIALIASING_FULL:
        return ENGINE_FULL;
    default:
        return ENGINE_PLAIN;
    }
}

/* Only light is interpolated, and only as bytes; and distances beside it. */
static bool is_sparse(const struct draw_picture *picture)
{
    const struct output_format *color = picture->formats[AOV_COLOR];

    for (int i = 0; i < AOV_COUNT; i++) {
        if (picture->formats[i] && i != AOV_COLOR && i != AOV_DEPTH) {
            return false;
        }
    }
    return picture->settings.sparse && color && !color->floats;
}

static bool begin(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_uniforms *block, struct error *err)
{
    const struct engine_map *maps = scene->environment->maps;
    const struct render_settings *settings = &picture->settings;
    const enum program_stage last = draw_last_stage(picture);

    (void)err;
    picture->block = memory_alloc(1, sizeof *block);
    *picture->block = *block;
    picture->canvas = engine_canvas_create(
        draw->cubes,
        &(struct engine_picture){
            .program = scene->engine,
            .params = scene->values,
            .frame = picture->block,
            .maps = {&maps[0], &maps[1], &maps[2]},
            .surroundings = scene->environment->key,
            .smoothing = smoothing_of(settings),
            .margin = draw_margin(settings),
            .rays = settings->rays,
            .transmission_depth = block->has_transmissive ? settings->transmission_depth : 0,
            .shadows = last >= STAGE_SHADOW,
            .lights = last == STAGE_COUNT,
            .sparse = is_sparse(picture),
        });
    return true;
}

static void keep(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    (void)draw;
    engine_canvas_keep(picture->canvas,
                       (struct engine_rect){region.x, region.y, region.width, region.height});
}

static void clear_slot(struct tile_in_flight *slot)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        free(slot->pixels[i]);
        slot->pixels[i] = NULL;
    }
}

static void end(struct draw *draw, struct draw_picture *picture)
{
    (void)draw;
    for (int i = 0; i < TILES_IN_FLIGHT; i++) {
        clear_slot(&picture->slots[i]);
    }
    engine_canvas_destroy(picture->canvas);
    free(picture->block);
}

/* Of one row of the tile. */
static size_t row_bytes(const struct output_format *format, struct tile tile)
{
    return (size_t)format->read_bytes * (size_t)tile.width;
}

/* An output of the tile, which has room in the slot. */
static struct engine_output output_of(const struct tile_in_flight *slot,
                                      const struct output_format *format)
{
    const bool floats = format->kind != OUT_BYTES;

    return (struct engine_output){.kind = format->output,
                                  .channels = format->read_bytes / (floats ? 4 : 1),
                                  .floats = floats,
                                  .pixels = slot->pixels[format->aov],
                                  .stride = row_bytes(format, slot->tile)};
}

/* Until the tile is drawn, or a pause is wanted. */
static bool go_on(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  int index, struct error *err)
{
    struct tile_in_flight *slot = &picture->slots[index];
    const struct engine_rect tile = {slot->tile.x, slot->tile.y, slot->tile.width,
                                     slot->tile.height};
    const uint64_t start = draw_now_us();
    struct engine_output outputs[AOV_COUNT];
    size_t count = 0;

    (void)scene;
    (void)err;
    for (int i = 0; i < AOV_COUNT; i++) {
        if (picture->formats[i]) {
            outputs[count++] = output_of(slot, picture->formats[i]);
        }
    }
    const struct engine_drawn drawn = engine_draw(picture->canvas, tile, picture->from,
                                                  picture->until, outputs, count, &draw->pause);
    draw->more_rays += drawn.rays;
    draw->pixels += drawn.pixels;
    slot->paused = drawn.paused;
    slot->stage_us[FRAME_SHADE] += draw_now_us() - start;
    return true;
}

/* With all samples of the round. */
static bool draw_samples(struct draw *draw, struct draw_picture *picture,
                         const struct draw_scene *scene, int index, struct error *err)
{
    struct tile_in_flight *slot = &picture->slots[index];

    clear_slot(slot);
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct output_format *format = picture->formats[i];
        if (format) {
            slot->pixels[i] =
                memory_alloc((size_t)slot->tile.height, row_bytes(format, slot->tile));
        }
    }
    memset(slot->stage_us, 0, sizeof slot->stage_us);
    const uint64_t drawn = draw->pixels;
    const bool ok = go_on(draw, picture, scene, index, err);
    picture->copied += (uint64_t)slot->tile.width * (uint64_t)slot->tile.height;
    picture->copied -= draw->pixels - drawn;
    return ok;
}

static bool wait(struct draw *draw, struct draw_picture *picture, int slot, struct error *err)
{
    (void)draw;
    (void)picture;
    (void)slot;
    (void)err;
    return true;
}

static bool collect(struct draw *draw, struct draw_picture *picture, int index, enum aov aov,
                    uint8_t *to, size_t stride, struct error *err)
{
    const struct tile_in_flight *slot = &picture->slots[index];
    const size_t row = row_bytes(picture->formats[aov], slot->tile);

    (void)draw;
    (void)err;
    for (int y = 0; y < slot->tile.height; y++) {
        memcpy(to + (size_t)y * stride, slot->pixels[aov] + (size_t)y * row, row);
    }
    return true;
}

const struct draw_backend draw_engine = {begin, end, keep, draw_samples, go_on, wait, collect};
