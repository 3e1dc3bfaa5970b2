/* SPDX-License-Identifier: MIT */
/* The passes over the samples of one tile. Rays go in wavefronts: all samples at once, one ray
 * each, then those samples that want another ray. Private to draw_compute.c. */
#ifndef RENDERER_WAVEFRONT_H
#define RENDERER_WAVEFRONT_H

#include "draw.h"
#include "static_programs.h"

/* A tile being drawn. */
struct wavefront {
    const struct gl *gl;
    bool software;
    const struct targets *targets;
    const struct static_programs *static_programs;
    const struct program *program;
    const struct render_settings *settings;
    int lights;
    bool transmissive;           /* light goes through something */
    struct dispatch_args tile;   /* with its margin */
    int sample;                  /* of each pixel */
    struct tile_in_flight *slot; /* takes the time */
};

/* Time spent since the last mark goes to `stage`. */
void wavefront_mark(struct wavefront *wavefront, enum frame_stage stage);

/* First rays of all samples, as far as stage `last`, which is before shadows. */
void wavefront_find(struct wavefront *wavefront, enum program_stage last);
/* What of lights and environment reaches them. */
void wavefront_shadow(struct wavefront *wavefront);
/* Their light, with that of all rays that follow, is added to the pixels. */
void wavefront_shade(struct wavefront *wavefront);
/* Lists the pixels that the settings sample again. */
void wavefront_detect_edges(struct wavefront *wavefront);
/* For a tile that was left with so many samples, its pixels in the targets again: what comes before
 * more of them. */
void wavefront_resume(struct wavefront *wavefront, int samples);
/* All of it again for another sample of all pixels, or of those listed; false: there are none. */
bool wavefront_resample(struct wavefront *wavefront, int sample);

#endif
