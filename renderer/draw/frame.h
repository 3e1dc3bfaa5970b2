/* SPDX-License-Identifier: MIT */
/* The uniform block that describes a picture: camera, limits, lights, environment. Its layout is
 * that of glsl/frame.glsl. */
#ifndef RENDERER_FRAME_H
#define RENDERER_FRAME_H

#include <stdint.h>

#include "camera.h"
#include "protocol/limits.h"

/* Values of glsl/frame.glsl. */
enum { LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT };
enum { SKY_GRADIENT, SKY_SOLID, SKY_IMAGE };
enum { VOLUME_BOX, VOLUME_ELLIPSOID };
enum { /* bits */
       EFFECT_SHADOWS = 1,
       EFFECT_REFLECTIONS = 2,
       EFFECT_REFRACTIONS = 4,
       EFFECT_SUN = 8,
       EFFECT_TRANSPARENT = 16,
};

struct frame_light {
    float place[4], color[4], extent[4], axis[4];
};

struct frame_volume {
    float place[4], extent[4], color[4], emission[4], noise[4], source[4];
};

struct frame_block {
    float eye[4], forward[4], right[4], up[4];
    float bounds_min[4], bounds_max[4], clear_min[4], clear_max[4];
    float zenith[4], horizon[4], ground[4], panorama[4];
    float fog_color[4], fog_shape[4];
    int32_t size[4], modes[4], effects[4], counts[4];
    struct frame_light lights[LIMIT_LIGHTS];
    struct frame_volume volumes[LIMIT_VOLUMES];
};

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
