/* SPDX-License-Identifier: MIT */
/* Cubes that were made before any ray asked (explore.c), and stay for other numbers of their field
 * (explore_again.c). Tapes and cubes that are no longer used leave their places to new ones. What
 * has changed is told by rows, as an interpreter's texture has them (TAPES_ROW in
 * glsl/interface.h). Of one thread at a time. */
#ifndef RENDERER_ENGINE_EXPLORED_H
#define RENDERER_ENGINE_EXPLORED_H

#include "engine_internal.h"

enum { TAPE_SIZES = 512, CUBES_IN_ROW = TAPES_ROW, WORDS_IN_ROW = 4 * TAPES_ROW };

/* Places that are free. */
struct places {
    uint32_t *at;
    size_t count, room;
};

struct row_marks {
    uint8_t *of;
    size_t count;
};

struct explored {
    struct cells cells;              /* without what children leave out */
    bool limited;                    /* smaller cubes were too many: these cannot be renewed */
    struct places tapes[TAPE_SIZES]; /* for each size of a tape */
    struct places children;          /* of eight cubes */
    size_t free_words;               /* of all places of tapes */
    struct row_marks cubes, words;   /* rows with something new */
};

/* Words that a tape takes; `*out_number`: among the sizes that there are. */
uint32_t explored_size(uint32_t count, int *out_number);
/* A free place for a tape. False: there is none of its size. */
bool explored_take_place(struct explored *explored, uint32_t count, uint32_t *out_tape);
void explored_free_tape(struct explored *explored, uint32_t tape, uint32_t count);
/* The children of a cube, which are the last cubes of all and have none themselves, go to a free
 * place, if there is one. */
void explored_put_children(struct explored *explored, struct cell *parent);
void explored_free_children(struct explored *explored, struct cell *parent);
void explored_mark_cube(struct explored *explored, size_t at);
void explored_mark_words(struct explored *explored, uint32_t tape, uint32_t count);
void explored_finish(struct explored *explored);

#endif
