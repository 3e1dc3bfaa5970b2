/* SPDX-License-Identifier: MIT */
/* The passes over the samples of one tile. Rays go in waves: all samples at once, one ray each,
 * then those samples that want another ray. Private to draw_compute.c. */
#ifndef RENDERER_WAVE_H
#define RENDERER_WAVE_H

#include "common.h"
#include "draw.h"

/* A tile being drawn. */
struct wave {
    const struct gl *gl;
    bool software;
    const struct targets *targets;
    const struct common *common;
    const struct program *program;
    const struct draw_plan *plan;
    int lights;
    bool clear;             /* light goes through something */
    struct pass_place tile; /* with its margin */
    int sample;             /* of each pixel */
    struct draw_slot *slot; /* takes the time */
};

/* Time spent since the last mark goes to `stage`. */
void wave_mark(struct wave *wave, enum frame_stage stage);

/* First rays of all samples, as far as stage `last`, which is before shadows. */
void wave_find(struct wave *wave, enum program_stage last);
/* What of lights and environment reaches them. */
void wave_shadow(struct wave *wave);
/* Their light, with that of all rays that follow, is added to the pixels. */
void wave_shade(struct wave *wave);
/* Lists the pixels that the plan samples again. */
void wave_find_edges(struct wave *wave);
/* For a tile that was left with so many samples, its pixels in the targets again: what comes before
 * more of them. */
void wave_resume(struct wave *wave, int samples);
/* All of it again for another sample of all pixels, or of those listed; false: there are none. */
bool wave_sample_again(struct wave *wave, int sample);

#endif
