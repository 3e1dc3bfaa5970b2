/* SPDX-License-Identifier: MIT */
/* Fills the uniform block that describes a picture: camera, limits, lights, environment. */
#ifndef RENDERER_FRAME_H
#define RENDERER_FRAME_H

#include <stdint.h>

#include "camera.h"
#include "renderer/glsl/interface.h"

/* What the field says about where it is. */
struct frame_extent {
    double min[3], max[3];             /* may be infinite */
    double clear_min[3], clear_max[3]; /* of what light goes through */
    bool clear;                        /* whether there is any */
    bool mirrors;                      /* something mirrors, or light goes through it */
    double scale;                      /* size of what is of interest; occlusion reaches a part */
    int loop_trips;                    /* loop iterations in one evaluation */
    bool limit_loops;                  /* the driver counts iterations: llvmpipe stops at 65,535 */
};

/* Lights, volumes, environment, and those render settings that no level changes. */
void frame_set_scene(struct frame_block *block, const struct scene *scene,
                     const struct frame_extent *extent);
/* The camera for a picture of this size; with it the lens. */
void frame_set_camera(struct frame_block *block, const struct camera *camera, int width,
                      int height);

#endif
