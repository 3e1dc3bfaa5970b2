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

/* Runs the passes of the camera's rays up to stage `last`, which comes before shadows. */
void wavefront_find(struct wavefront *wavefront, enum program_stage last);
/* Computes the part of each light and of the environment that reaches their hits. */
void wavefront_shadow(struct wavefront *wavefront);
/* Adds the light of these rays, and of all rays that follow them, to the pixels. */
void wavefront_shade(struct wavefront *wavefront);
/* Lists the pixels that the settings sample again. */
void wavefront_detect_edges(struct wavefront *wavefront);
/* Prepares more samples of a tile that has so many. Its pixels are in the targets again. */
void wavefront_resume(struct wavefront *wavefront, int samples);
/* Draws another sample of all pixels, or of the listed ones. False: none is listed. */
bool wavefront_resample(struct wavefront *wavefront, int sample);

#endif
