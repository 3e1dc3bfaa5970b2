/* SPDX-License-Identifier: MIT */
/* A field as data for an interpreter of shaders: cubes of space with the operations that matter in
 * each. glsl/interface.h has the layout, glsl/tapes_run.glsl reads it. The cubes stay, and are
 * renewed for other numbers of the field (explore_again.c); they equal new ones. Of one thread. */
#ifndef RENDERER_ENGINE_TAPES_H
#define RENDERER_ENGINE_TAPES_H

#include "engine.h"
#include "renderer/field/vocabulary.h"

struct engine_tapes;

/* `params`: numbers of the program's field, or of another of its structure; they are copied.
 * Takes a reference of the program. */
struct engine_tapes *engine_tapes_create(struct engine_program *program, const float *params,
                                         const struct engine_extent *extent,
                                         const struct vocabulary *vocabulary);
void engine_tapes_destroy(struct engine_tapes *tapes); /* NULL: nothing */
/* Makes them those of other numbers, where little has changed. False: new ones have to be made, and
 * these destroyed. */
bool engine_tapes_renew(struct engine_tapes *tapes, const struct engine_program *program,
                        const float *params, const struct engine_extent *extent);

/* Of the texture that holds them, TAPES_ROW texels each. */
size_t engine_tapes_rows(const struct engine_tapes *tapes);
/* Tells which rows are others than when this was last called: `count` rows from one on. */
typedef void engine_tapes_hear(void *data, size_t first, size_t count, const uint32_t (*texels)[4]);
void engine_tapes_tell(struct engine_tapes *tapes, engine_tapes_hear *hear, void *data);

/* Of all spaces, with places that are free. */
struct engine_tapes_size {
    size_t cubes, words;
};
struct engine_tapes_size engine_tapes_size(const struct engine_tapes *tapes);

#endif
