/* SPDX-License-Identifier: MIT */
/* Fills the uniform block that describes a picture: camera, limits, lights, environment. */
#ifndef RENDERER_FRAME_UNIFORMS_H
#define RENDERER_FRAME_UNIFORMS_H

#include <stdint.h>

#include "camera.h"
#include "renderer/field/section.h"
#include "renderer/glsl/interface.h"

/* The bounds of the field. */
struct scene_bounds {
    double min[3], max[3];                           /* may be infinite */
    double transmissive_min[3], transmissive_max[3]; /* of what light goes through */
    bool transmissive;                               /* whether there is any */
    bool reflective;  /* something reflects, or light goes through it */
    bool estimates;   /* some shapes estimate their distance: glsl/field_mask.glsl */
    bool rise;        /* some distances are bounds, as of shapes that are scaled along an axis */
    double scale;     /* size of what is of interest; occlusion reaches a part */
    double step;      /* where rays begin and end is rounded outwards to it */
    int loop_trips;   /* loop iterations in one evaluation */
    bool limit_loops; /* the driver counts iterations: llvmpipe stops at 65,535 */
};

/* Lights, volumes, environment, and those render settings that no level changes. */
void frame_uniforms_set_scene(struct frame_uniforms *block, const struct scene *scene,
                              const struct scene_bounds *extent);
/* The camera for a picture of this size; with it the lens. */
void frame_uniforms_set_camera(struct frame_uniforms *block, const struct camera *camera, int width,
                               int height);
void frame_uniforms_set_section(struct frame_uniforms *block, const struct section *section);

#endif
