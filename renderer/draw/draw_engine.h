/* SPDX-License-Identifier: MIT */
/* Tiles that renderer/engine draws. Private to draw.c. */
#ifndef RENDERER_DRAW_ENGINE_H
#define RENDERER_DRAW_ENGINE_H

#include "draw.h"

/* Whether it can. */
bool engine_draws(const struct frame_block *block, const struct draw_form *const forms[AOV_COUNT],
                  const struct draw_plan *plan);
/* All samples of the slot's tile, into slot->pixels. */
void engine_draw_tile(const struct draw_picture *picture, const struct draw_scene *scene,
                      struct draw_slot *slot);
/* Rows of it to `to`, which are `stride` bytes apart. */
void engine_collect(const struct draw_slot *slot, uint8_t *to, size_t stride);

#endif
