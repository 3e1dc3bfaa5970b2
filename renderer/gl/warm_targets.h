/* SPDX-License-Identifier: MIT */
/* Targets for the first run of a program on a compiling thread. Drivers do most of their work in
 * that run. Created when a program of its kind is first compiled. */
#ifndef RENDERER_WARM_TARGETS_H
#define RENDERER_WARM_TARGETS_H

#include "fragment_targets.h"
#include "program.h"
#include "tape_texture.h"
#include "targets.h"

enum { WARM_MAPS = 3 };

struct warm_targets {
    bool has_passes, has_fragment; /* whether those are there: */
    struct targets passes;
    struct fragment_targets fragment;
    GLuint maps[WARM_MAPS]; /* with the state of an environment's */
    GLuint tapes;           /* without any operation */
};

/* `fragment`: for fragment shaders. */
bool warm_targets_prepare(struct warm_targets *targets, const struct gl *gl, bool fragment,
                          struct error *err);
void warm_targets_finish(struct warm_targets *targets, const struct gl *gl);
/* One work group, or a few fragments. */
void warm_targets_run(const struct warm_targets *targets, const struct gl *gl,
                      enum program_stage stage, const struct pass *pass);

#endif
