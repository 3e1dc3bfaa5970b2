/* SPDX-License-Identifier: MIT */
/* The passes that do not depend on a scene's structure. Compiled once per context. */
#ifndef RENDERER_STATIC_PROGRAMS_H
#define RENDERER_STATIC_PROGRAMS_H

#include "renderer/gl/pass.h"

enum static_pass {
    STATIC_CAMERA,       /* first rays */
    STATIC_TRANSMISSION, /* light through transmissive objects */
    STATIC_SHADE,        /* light along rays, and the rays that follow */
    STATIC_PLAIN,        /* the same where nothing reflects: a third of the time */
    STATIC_ACCUMULATE,   /* samples to pixels */
    STATIC_EDGE_DETECT,  /* which pixels are sampled again */
    STATIC_RESAMPLE,     /* the same in a later round */
    STATIC_COUNT
};

struct static_programs {
    struct pass passes[STATIC_COUNT];
};

bool static_programs_init(struct static_programs *out_programs, const struct gl *gl,
                          struct error *err);
void static_programs_finish(struct static_programs *programs, const struct gl *gl);

#endif
