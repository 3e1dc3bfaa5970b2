/* SPDX-License-Identifier: MIT */
/* The settings of one picture, derived from its quality level, the scene's render settings and the
 * limits of the driver. */
#ifndef RENDERER_RENDER_SETTINGS_H
#define RENDERER_RENDER_SETTINGS_H

#include "frame_uniforms.h"
#include "protocol/picture.h"

/* The settings that are not in the frame block. */
struct render_settings {
    enum antialiasing antialiasing; /* never ANTIALIASING_AUTO */
    int samples;                    /* of a pixel, where it is sampled in full */
    int rays;                       /* of a sample after the first; 0: none */
    int transmission_depth;         /* surfaces that light goes through; 0: none */
    bool volumes;
    bool sparse;     /* even parts of the picture may be interpolated; the engine alone does so */
    bool reflective; /* something reflects: else light is shaded by the simpler program */
};

/* The settings that a request gives. */
struct settings_request {
    int level;       /* enum quality_level; -1: the scene's */
    int samples;     /* along an axis; 0: the level's or the scene's */
    int transparent; /* 1, 0; -1: the scene's */
    bool sparse;     /* where a pixel has one sample: fewer rays than pixels */
    struct section section;
};

/* After frame_uniforms_set_scene and frame_uniforms_set_camera. `render`: the scene's render_type.
 * True when a ray gets fewer steps than the scene or the level asks for, because the driver bounds
 * loops. */
bool render_settings_make(struct render_settings *out_settings, struct frame_uniforms *block,
                          const struct record *render, const struct settings_request *request,
                          const struct scene_bounds *extent);

#endif
