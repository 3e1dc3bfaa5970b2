/* SPDX-License-Identifier: MIT */
/* The passes that know nothing of a scene's shape: compiled once for a context. */
#ifndef RENDERER_COMMON_H
#define RENDERER_COMMON_H

#include "renderer/gl/pass.h"

enum common_pass {
    COMMON_CAMERA, /* first rays */
    COMMON_CLEAR,  /* light through clear things */
    COMMON_SHADE,  /* light along rays, and the rays that follow */
    COMMON_PLAIN,  /* the same where nothing mirrors: a third of the time */
    COMMON_GATHER, /* samples to pixels */
    COMMON_EDGES,  /* which pixels are sampled again */
    COMMON_AGAIN,  /* the same in a later round */
    COMMON_COUNT
};

struct common {
    struct pass passes[COMMON_COUNT];
};

bool common_init(struct common *out_common, const struct gl *gl, struct error *err);
void common_finish(struct common *common, const struct gl *gl);

#endif
