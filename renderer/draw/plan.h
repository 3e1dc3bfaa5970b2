/* SPDX-License-Identifier: MIT */
/* What a picture takes, out of its quality level, the scene's render settings, and what the driver
 * allows. */
#ifndef RENDERER_PLAN_H
#define RENDERER_PLAN_H

#include "frame.h"
#include "protocol/picture.h"

/* What of a picture is no number in its frame block. */
struct draw_plan {
    enum antialiasing antialiasing; /* never ANTIALIASING_AUTO */
    int samples;                    /* of a pixel, where it is sampled in full */
    int rays;                       /* of a sample after the first; 0: none */
    int clear_depth;                /* surfaces that light goes through; 0: none */
    bool volumes;
    bool sparse;  /* even parts of the picture may be interpolated; the engine alone does so */
    bool mirrors; /* something may mirror: else light is shaded by the simpler program */
};

/* What is asked of one picture. */
struct plan_wish {
    int level;       /* enum quality_level; -1: the scene's */
    int samples;     /* along an axis; 0: the level's or the scene's */
    int transparent; /* 1, 0; -1: the scene's */
    bool sparse;     /* where a pixel has one sample: fewer rays than pixels */
};

/* After frame_set_scene and frame_set_camera. `render`: the scene's render_type. True when a ray
 * gets fewer steps than the scene or the level asks for, because the driver bounds loops. */
bool plan_make(struct draw_plan *out_plan, struct frame_block *block, const struct record *render,
               const struct plan_wish *wish, const struct frame_extent *extent);

#endif
