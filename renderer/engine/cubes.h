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
    struct trunk *trunk;                            /* what they share; NULL: nothing */
    struct noted noted[ENGINE_THREADS];             /* what its part of a picture depends on */
    float *params;                                  /* numbers that the cubes are valid for */
    uint32_t edit;                                  /* counts changes of `params` */
    bool renewed;                                   /* for the picture that has them now */
    struct seen seen;
};

/* Gives the caller the kept cubes of this program that fit the picture best, renewed for its
 * numbers, or new ones. `*out_picture` becomes a number above 0 that no other picture has. */
struct cubes *cubes_take(struct engine_cubes *kept, const struct engine_picture *picture,
                         uint32_t *out_picture);
/* Keeps the cubes for the next picture, or frees them. */
void cubes_give(struct engine_cubes *kept, struct engine_program *program, struct cubes *cubes);
/* For all that are kept: LIMIT_CUBES_BYTES, or less on a small machine. */
size_t cubes_bytes_most(void);
/* How often a thread's cubes were made anew, all in all. */
static inline uint32_t cubes_times(const struct cells spaces[ENGINE_SPACES])
{
    return spaces[0].times + spaces[1].times + spaces[2].times;
}

#endif
