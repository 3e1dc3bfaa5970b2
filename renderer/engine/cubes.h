/* SPDX-License-Identifier: MIT */
/* Cubes of space with what of a field matters in each (cells.c), and the last pictures made of them
 * (seen.h). They are kept from picture to picture of a program. Another view, or other materials,
 * find most of what they need. After an edit of other numbers, cubes are renewed where these matter
 * (renew.c). No pixel depends on them. Of the drawing thread. */
#ifndef RENDERER_ENGINE_CUBES_H
#define RENDERER_ENGINE_CUBES_H

#include "seen.h"

struct cubes {
    struct cells of[ENGINE_THREADS][ENGINE_SPACES]; /* each thread has its own */
    struct noted noted[ENGINE_THREADS];             /* what it draws is made of */
    float *params;                                  /* of the field, that they are right for */
    uint32_t edit;                                  /* how often these changed */
    bool renewed;                                   /* for the picture that has them */
    struct seen seen;
};

/* Those that were kept for this program and are nearest to what the picture needs, renewed for its
 * numbers, or new ones: the caller's. In `*out_picture` a number above 0 that no other has. */
struct cubes *cubes_take(struct engine_cubes *kept, const struct engine_picture *picture,
                         uint32_t *out_picture);
/* Keeps them, or frees them. */
void cubes_give(struct engine_cubes *kept, struct engine_program *program, struct cubes *cubes);
/* All that a thread's cubes were made anew. */
static inline uint32_t cubes_times(const struct cells spaces[ENGINE_SPACES])
{
    return spaces[0].times + spaces[1].times + spaces[2].times;
}

#endif
