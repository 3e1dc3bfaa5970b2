/* SPDX-License-Identifier: MIT */
#include "draw_engine.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum { PIXEL_BYTES = 4 };

bool engine_draws(const struct frame_block *block, const struct draw_form *const forms[AOV_COUNT],
                  const struct draw_plan *plan)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (forms[i] && (i != AOV_COLOR || forms[i]->floats)) {
            return false;
        }
    }
    return !plan->volumes && !plan->from_camera && !(block->has_clear && plan->clear_depth > 0);
}

static enum engine_smoothing smoothing_of(const struct draw_plan *plan)
{
    switch (plan->antialiasing) {
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

void engine_draw_tile(const struct draw_picture *picture, const struct draw_scene *scene,
                      struct draw_slot *slot)
{
    const struct tile tile = slot->tile;
    const struct engine_sky *skies = scene->environment->skies;
    const struct engine_picture drawn = {.program = scene->engine,
                                         .numbers = scene->values,
                                         .frame = picture->block,
                                         .skies = {&skies[0], &skies[1], &skies[2]},
                                         .smoothing = smoothing_of(&picture->plan),
                                         .samples = picture->plan.samples,
                                         .rays = picture->plan.rays};

    free(slot->pixels);
    slot->pixels = memory_alloc((size_t)tile.width * (size_t)tile.height, PIXEL_BYTES);
    engine_draw(&drawn, tile.x, tile.y, tile.width, tile.height, slot->pixels,
                PIXEL_BYTES * (size_t)tile.width);
}

void engine_collect(const struct draw_slot *slot, uint8_t *to, size_t stride)
{
    const size_t row = PIXEL_BYTES * (size_t)slot->tile.width;

    for (int y = 0; y < slot->tile.height; y++) {
        memcpy(to + (size_t)y * stride, slot->pixels + (size_t)y * row, row);
    }
}
