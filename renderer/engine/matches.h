/* SPDX-License-Identifier: MIT */
/* After an edit of more than numbers the operations of a field have other indices. This finds those
 * that the field before it had too, so that what is known of them stays (cubes.c). Any thread. */
#ifndef RENDERER_ENGINE_MATCHES_H
#define RENDERER_ENGINE_MATCHES_H

#include "changes.h"

/* A field with its numbers, neither of which is owned. */
struct matches_side {
    const struct engine_program *program;
    const float *params;
};

struct matches {
    uint32_t *now;    /* of each operation before: its index after, or MATCH_NONE */
    size_t before;    /* how many there were */
    uint8_t *changed; /* of each operation after: 1 if none before is the same, with its numbers */
    size_t fresh;     /* how many these are */
    size_t first;     /* of those before that have another index, or are no more; `before`: none */
    bool renumbered;  /* the same shape may have another leaf, or another slot of its material */
};

#define MATCH_NONE ((uint32_t)TAPE_INDEX)

/* The two fields are of programs of one width. The caller calls matches_finish(). */
void matches_find(const struct matches_side *before, const struct matches_side *after,
                  struct matches *out);
void matches_finish(struct matches *matches);

/* Whether any index is another one. */
static inline bool matches_move(const struct matches *matches)
{
    return matches->first < matches->before;
}
/* From indices before to those after. One that is no more becomes MATCH_NONE. Answers whether one
 * may be another index now. */
bool matches_rename(const struct matches *matches, uint32_t *words, size_t count);

#endif
