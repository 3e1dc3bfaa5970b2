/* SPDX-License-Identifier: MIT */
/* The last pictures of a field, in squares of pixels, each with what it was made of: the cubes that
 * its rays used, and the materials that they met. After an edit of numbers a square is drawn again
 * only where one of these has changed since. The rays of other squares take the same steps as
 * before, and their pixels are copied. With other lights, another camera or another bound of the
 * whole field, all is drawn.
 *
 * Of the drawing thread, but for `struct noted`, which each thread that draws has for itself. */
#ifndef RENDERER_ENGINE_SEEN_H
#define RENDERER_ENGINE_SEEN_H

#include "changes.h"
#include "protocol/picture.h"

enum {
    SQUARE = 16,       /* pixels to a side, of one that is not cut off */
    SQUARES = 4,       /* in a row of a part, which a thread draws at a time */
    SQUARE_BLOCK = 8,  /* squares begin and end at multiples of this */
    SEEN_PICTURES = 3, /* of a field */
};

/* Distances of the field at some points. */
struct noted_value {
    uint32_t cube;     /* around them: noted_word() */
    uint16_t count;    /* of points */
    uint16_t squares;  /* as in `struct noted` */
    float mask;        /* field_mask of the question: glsl/field_mask.glsl */
    float points[][4]; /* x, y, z and the distance */
};
static inline size_t noted_value_bytes(const struct noted_value *value)
{
    return sizeof *value + value->count * sizeof value->points[0];
}

struct seen_square {
    int blocks; /* of SQUARE_BLOCK pixels that show it */
    struct engine_rect rect;
    uint32_t edit;  /* the newest one for which it is known to be valid */
    uint32_t times; /* cubes_times() of its thread when it was drawn */
    uint8_t thread;
    bool stale; /* a material of it has changed */
    struct material_set materials;
    size_t count, bytes_of_values;
    char *values;    /* each a struct noted_value */
    uint32_t used[]; /* cubes: noted_word(), with NOTED_RUN and NOTED_FOUND */
};

struct seen {
    struct seen_picture *pictures[SEEN_PICTURES]; /* the last used first; NULL: none */
};

/* Whether a kept picture differs from this one by edits of numbers alone. */
bool seen_has(const struct seen *seen, const struct engine_picture *picture);
/* That picture, or a new one without a square. NULL: it is too large to be kept. */
struct seen_picture *seen_open(struct seen *seen, const struct engine_picture *picture,
                               const struct engine_output *outputs, size_t count);
/* Squares with one of these materials are stale. */
void seen_repaint(struct seen *seen, const struct material_set *materials);
size_t seen_bytes(const struct seen *seen);
void seen_finish(struct seen *seen);

/* Whether a cube of a square has changed since. */
bool seen_has_changed(const struct cells *spaces, uint32_t word, uint32_t edit);
/* Each square of it once. `*at`: 0 at first; NULL: there are no more. */
struct seen_square *seen_next(const struct seen_picture *seen, size_t *at);
/* Copies the valid squares of a tile to the outputs. `*out` becomes the parts that have to be
 * drawn, each at most `side` wide and high; the caller frees it. Returns their number. */
size_t seen_divide(struct seen_picture *seen, const struct cubes *cubes,
                   const struct engine_work *work, int side, struct engine_part **out);
/* Takes a square that was drawn, and its pixels from the outputs. Where the picture has as much as
 * it may have, the square is unknown. */
void seen_take(struct seen_picture *seen, struct seen_square *square,
               const struct engine_work *work);

/* --- what a part of a picture is made of --- */

enum {
    NOTED_SPACE = 24,
    NOTED_RUN = 1 << 26,
    NOTED_FOUND = 1 << 27,
    NOTED_VALUES = 1 << 22, /* bytes of a part; then cubes are noted instead */
};

static inline uint32_t noted_word(uint32_t space, uint32_t cube)
{
    return space << NOTED_SPACE | cube;
}

struct noted {
    uint32_t part;    /* its number, which no other of the thread's cubes has */
    uint16_t squares; /* that the vector's pixels are for, a bit for each */
    uint32_t *cubes;
    size_t count, room;
    char *values; /* each a struct noted_value */
    size_t value_bytes, value_room;
    struct material_set materials[SQUARES * SQUARES];
    struct seen_square **made; /* that were not taken yet */
    size_t made_count;
};

void noted_grow(struct noted *noted);
static inline void noted_add(struct noted *noted, uint32_t space, uint32_t cube)
{
    if (noted->count == noted->room) {
        noted_grow(noted);
    }
    noted->cubes[noted->count++] = noted_word(space, cube);
}
/* One more, of so many points. */
struct noted_value *noted_value_add(struct noted *noted, int count);
size_t noted_bytes(const struct noted *noted);
void noted_finish(struct noted *noted);

#endif
