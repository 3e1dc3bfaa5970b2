/* SPDX-License-Identifier: MIT */
/* Times the stages of a tile: on a GPU by timer queries, on the CPU by waiting for all work. */
#ifndef RENDERER_TILE_CLOCK_H
#define RENDERER_TILE_CLOCK_H

#include "draw.h"

void tile_clock_start(const struct gl *gl, bool software, struct tile_in_flight *slot);
/* Resumes the same tile. The time in between is not counted. */
void tile_clock_resume(const struct gl *gl, bool software, struct tile_in_flight *slot);
/* Adds the time since the last mark to `stage`. */
void tile_clock_mark(const struct gl *gl, bool software, struct tile_in_flight *slot,
                     enum frame_stage stage);
/* When the tile is there. */
void tile_clock_fetch(const struct gl *gl, struct tile_in_flight *slot);

#endif
