/* SPDX-License-Identifier: MIT */
/* Where the time of a tile goes: on a GPU by queries in its queue, on the CPU after all work. */
#ifndef RENDERER_TILE_CLOCK_H
#define RENDERER_TILE_CLOCK_H

#include "draw.h"

void tile_clock_start(const struct gl *gl, bool software, struct tile_in_flight *slot);
/* The same tile later: what was between is no time of it. */
void tile_clock_resume(const struct gl *gl, bool software, struct tile_in_flight *slot);
/* Time spent since the last mark goes to `stage`. */
void tile_clock_mark(const struct gl *gl, bool software, struct tile_in_flight *slot,
                     enum frame_stage stage);
/* When the tile is there. */
void tile_clock_fetch(const struct gl *gl, struct tile_in_flight *slot);

#endif
