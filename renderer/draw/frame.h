/* SPDX-License-Identifier: MIT */
/* The uniform block that describes a picture: camera, limits, lights, environment. Its layout is
 * that of glsl/frame.glsl. */
#ifndef RENDERER_FRAME_H
#define RENDERER_FRAME_H

#include <stdint.h>

#include "camera.h"
#include "protocol/limits.h"

struct frame_light {
    float place[4], color[4], extent[4];
};

struct frame_block {
    float eye[4], forward[4], right[4], up[4];
    float bounds_min[4], bounds_max[4];
    float zenith[4], horizon[4], ground[4];
    int32_t size[4], modes[4];
    struct frame_light lights[LIMIT_LIGHTS];
};

/* What the field says about where it is. */
struct frame_extent {
    double min[3], max[3]; /* may be infinite */
    double scale;          /* size of what is of interest; occlusion reaches a part of it */
    int loop_trips;        /* loop iterations in one evaluation */
    bool limit_loops;      /* the driver counts iterations: llvmpipe stops at 65,535 */
};

/* Lights, environment and render settings, with the steps that the driver allows. True when these
 * are fewer than the scene asks for. */
bool frame_set_scene(struct frame_block *block, const struct scene *scene,
                     const struct frame_extent *extent);
void frame_set_camera(struct frame_block *block, const struct camera *camera, int width, int height,
                      int samples);

#endif
