/* SPDX-License-Identifier: MIT */
/* A field as data for an interpreter of shaders: cubes of space with the operations that matter in
 * each, made at once. glsl/interface.h has the layout, glsl/tapes_run.glsl reads it. */
#ifndef RENDERER_ENGINE_TAPES_H
#define RENDERER_ENGINE_TAPES_H

#include "engine.h"
#include "renderer/field/vocabulary.h"

struct engine_tapes {
    uint32_t (*texels)[4]; /* whole rows of TAPES_ROW */
    size_t count;
    size_t cubes, words; /* of all spaces */
};

/* `params`: numbers of the program's field, or of another of its structure. Any thread. */
void engine_tapes_make(const struct engine_program *program, const float *params,
                       const struct engine_extent *extent, const struct vocabulary *vocabulary,
                       struct engine_tapes *out);
void engine_tapes_finish(struct engine_tapes *tapes);

#endif
