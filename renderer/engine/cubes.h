/* SPDX-License-Identifier: MIT */
/* Cubes of space with what of a field matters in each (cells.c). They are kept from picture to
 * picture while the numbers of shapes and operations stay: another view, or other materials, find
 * most of what they need. No pixel depends on them. Of the drawing thread. */
#ifndef RENDERER_ENGINE_CUBES_H
#define RENDERER_ENGINE_CUBES_H

#include "engine_internal.h"

struct cubes {
    struct cells of[ENGINE_THREADS][ENGINE_SPACES]; /* each thread has its own */
};

/* Those that were kept for this program and these numbers of it, or new ones: the caller's. In
 * `*out_numbers` what names the numbers, in `*out_picture` a number above 0 that no other has. */
struct cubes *cubes_take(struct engine_cubes *kept, const struct engine_program *program,
                         const float *params, uint64_t *out_numbers, uint32_t *out_picture);
/* Keeps them, or frees them. */
void cubes_give(struct engine_cubes *kept, struct engine_program *program, uint64_t numbers,
                struct cubes *cubes);

#endif
