/* SPDX-License-Identifier: MIT */
#include "seen.h"

#include <stdlib.h>
#include <string.h>

#include "cubes.h"

#include "protocol/memory.h"

#define SEEN_PIXELS (1 << 22) /* of a picture that is kept */
#define SEEN_PART 4           /* of the bytes of all cubes, one picture may have a fourth */

struct shown {
    enum output kind;
    int bytes; /* of a pixel */
    uint8_t *pixels;
};

struct seen_picture {
    struct engine_picture key; /* what it points to is not looked at */
    struct frame_uniforms frame;
    struct shown outputs[AOV_COUNT];
    size_t output_count;
    int width, height;
    int across, down;            /* blocks */
    struct seen_square **blocks; /* what each shows; NULL: nothing yet */
    size_t bytes, most;          /* of it; no square is kept beyond that */
};

/* --- a picture --- */

static int bytes_of(const struct engine_output *output)
{
    return output->channels * (output->floats ? (int)sizeof(float) : 1);
}

static bool is_alike(const struct seen_picture *seen, const struct engine_picture *picture)
{
    const struct engine_picture *key = &seen->key;

    return key->surroundings == picture->surroundings && key->smoothing == picture->smoothing &&
           key->margin == picture->margin && key->rays == picture->rays &&
           key->transmission_depth == picture->transmission_depth &&
           key->shadows == picture->shadows && key->lights == picture->lights &&
           key->sparse == picture->sparse &&
           memcmp(&seen->frame, picture->frame, sizeof seen->frame) == 0;
}

static bool shows(const struct seen_picture *seen, const struct engine_output *outputs,
                  size_t count)
{
    bool same = seen->output_count == count;

    for (size_t i = 0; same && i < count; i++) {
        same = seen->outputs[i].kind == outputs[i].kind &&
               seen->outputs[i].bytes == bytes_of(&outputs[i]);
    }
    return same;
}

static int blocks_in(int pixels)
{
    return (pixels + SQUARE_BLOCK - 1) / SQUARE_BLOCK;
}

static struct seen_picture *create(const struct engine_picture *picture,
                                   const struct engine_output *outputs, size_t count)
{
    const int width = picture->frame->camera.size[0], height = picture->frame->camera.size[1];
    struct seen_picture *seen = memory_alloc(1, sizeof *seen);

    seen->most = cubes_bytes_most() / SEEN_PART;
    seen->key = *picture;
    seen->frame = *picture->frame;
    seen->width = width;
    seen->height = height;
    seen->across = blocks_in(width);
    seen->down = blocks_in(height);
    seen->blocks = memory_alloc((size_t)seen->across * (size_t)seen->down, sizeof *seen->blocks);
    seen->output_count = count;
    for (size_t i = 0; i < count; i++) {
        const size_t bytes = (size_t)width * (size_t)height * (size_t)bytes_of(&outputs[i]);
        seen->outputs[i] =
            (struct shown){outputs[i].kind, bytes_of(&outputs[i]), memory_alloc(bytes, 1)};
        seen->bytes += bytes;
    }
    return seen;
}

static size_t square_bytes(const struct seen_square *square)
{
    return sizeof *square + square->count * sizeof square->used[0] + square->bytes_of_values;
}

static void let_go(struct seen_picture *seen, struct seen_square *square)
{
    if (square && --square->blocks == 0) {
        seen->bytes -= square_bytes(square);
        free(square->values);
        free(square);
    }
}

static void destroy(struct seen_picture *seen)
{
    if (!seen) {
        return;
    }
    for (int i = 0; i < seen->across * seen->down; i++) {
        let_go(seen, seen->blocks[i]);
    }
    for (size_t i = 0; i < seen->output_count; i++) {
        free(seen->outputs[i].pixels);
    }
    free(seen->blocks);
    free(seen);
}

/* --- those of a field --- */

bool seen_has(const struct seen *seen, const struct engine_picture *picture)
{
    bool has = false;

    for (int i = 0; i < SEEN_PICTURES; i++) {
        has = has || (seen->pictures[i] && is_alike(seen->pictures[i], picture));
    }
    return has;
}

struct seen_picture *seen_open(struct seen *seen, const struct engine_picture *picture,
                               const struct engine_output *outputs, size_t count)
{
    const int width = picture->frame->camera.size[0], height = picture->frame->camera.size[1];
    struct seen_picture **const all = seen->pictures, *found;
    int at = 0;

    if (width > SEEN_PIXELS / height) {
        return NULL;
    }
    while (at < SEEN_PICTURES - 1 &&
           !(all[at] && is_alike(all[at], picture) && shows(all[at], outputs, count))) {
        at++;
    }
    found = all[at];
    if (!found || !is_alike(found, picture) || !shows(found, outputs, count)) {
        destroy(found);
        found = create(picture, outputs, count);
    }
    memmove(all + 1, all, (size_t)at * sizeof *all);
    all[0] = found;
    return found;
}

static bool meets(const struct material_set *a, const struct material_set *b)
{
    uint64_t both = 0;

    for (int i = 0; i < MATERIAL_SET / 64; i++) {
        both |= a->bits[i] & b->bits[i];
    }
    return both;
}

void seen_repaint(struct seen *seen, const struct material_set *materials)
{
    for (int i = 0; i < SEEN_PICTURES; i++) {
        struct seen_picture *picture = seen->pictures[i];
        for (int k = 0; picture && k < picture->across * picture->down; k++) {
            struct seen_square *square = picture->blocks[k];
            if (square && meets(&square->materials, materials)) {
                square->stale = true;
            }
        }
    }
}

size_t seen_bytes(const struct seen *seen)
{
    size_t bytes = 0;

    for (int i = 0; i < SEEN_PICTURES; i++) {
        bytes += seen->pictures[i] ? seen->pictures[i]->bytes : 0;
    }
    return bytes;
}

void seen_finish(struct seen *seen)
{
    for (int i = 0; i < SEEN_PICTURES; i++) {
        destroy(seen->pictures[i]);
        seen->pictures[i] = NULL;
    }
}

/* --- what is right --- */

bool seen_has_changed(const struct cells *spaces, uint32_t word, uint32_t edit)
{
    const struct cells *cells = &spaces[word >> NOTED_SPACE & 3];
    const struct cell_news *news = &cells->news[word & ((1 << NOTED_SPACE) - 1)];

    return ((word & NOTED_RUN) && news->run > edit) || ((word & NOTED_FOUND) && news->found > edit);
}

struct seen_square *seen_next(const struct seen_picture *seen, size_t *at)
{
    const size_t blocks = (size_t)seen->across * (size_t)seen->down;
    struct seen_square *square = NULL;

    while (!square && *at < blocks) {
        const size_t block = (*at)++;
        square = seen->blocks[block];
        if (square && ((block % (size_t)seen->across > 0 && seen->blocks[block - 1] == square) ||
                       (block >= (size_t)seen->across &&
                        seen->blocks[block - (size_t)seen->across] == square))) {
            square = NULL; /* it was there before */
        }
    }
    return square;
}

static bool is_right(const struct seen_square *square, const struct cubes *cubes)
{
    return square->edit == cubes->edit && !square->stale;
}

/* All blocks that a rectangle has pixels of. */
static bool is_known(const struct seen_picture *seen, const struct cubes *cubes,
                     struct engine_rect rect)
{
    bool known = true;

    for (int y = rect.y / SQUARE_BLOCK; y <= (rect.y + rect.height - 1) / SQUARE_BLOCK; y++) {
        for (int x = rect.x / SQUARE_BLOCK; x <= (rect.x + rect.width - 1) / SQUARE_BLOCK; x++) {
            const struct seen_square *square = seen->blocks[y * seen->across + x];
            known = known && square && is_right(square, cubes);
        }
    }
    return known;
}

/* Who drew it before; -1: nobody. */
static int thread_of(const struct seen_picture *seen, struct engine_rect rect)
{
    const struct seen_square *square =
        seen->blocks[rect.y / SQUARE_BLOCK * seen->across + rect.x / SQUARE_BLOCK];

    return square ? square->thread : -1;
}

static void copy_pixels(const struct seen_picture *seen, const struct engine_work *work,
                        struct engine_rect rect, bool back)
{
    for (size_t o = 0; o < seen->output_count; o++) {
        const struct engine_output *output = &work->outputs[o];
        const size_t bytes = (size_t)seen->outputs[o].bytes, row = bytes * (size_t)rect.width;
        for (int y = rect.y; y < rect.y + rect.height; y++) {
            uint8_t *ours = seen->outputs[o].pixels +
                            bytes * ((size_t)y * (size_t)seen->width + (size_t)rect.x);
            uint8_t *theirs = output->pixels + (size_t)(y - work->tile.y) * output->stride +
                              bytes * (size_t)(rect.x - work->tile.x);
            memcpy(back ? ours : theirs, back ? theirs : ours, row);
        }
    }
}

/* --- parts that are drawn --- */

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Puts a square to the part beside it where both make a rectangle. */
static void join(struct engine_part *parts, size_t *count, const struct engine_part *square,
                 int side)
{
    struct engine_part *last = *count > 0 ? &parts[*count - 1] : NULL;
    const struct engine_rect rect = square->rect;

    if (last && last->thread == square->thread && last->rect.y == rect.y &&
        last->rect.x + last->rect.width == rect.x && last->rect.width + rect.width <= side) {
        last->rect.width += rect.width;
        return;
    }
    parts[(*count)++] = *square;
}

static bool stands_on(const struct engine_part *upper, const struct engine_part *lower, int side)
{
    return upper->thread == lower->thread && upper->rect.x == lower->rect.x &&
           upper->rect.width == lower->rect.width &&
           upper->rect.y + upper->rect.height == lower->rect.y &&
           upper->rect.height + lower->rect.height <= side;
}

/* Rows of squares that stand on each other, and are equally wide, become one part. */
static size_t pile_up(struct engine_part *parts, size_t count, int side)
{
    size_t kept = 0;

    for (size_t i = 0; i < count; i++) {
        size_t k = 0;
        while (k < kept && !stands_on(&parts[k], &parts[i], side)) {
            k++;
        }
        if (k < kept) {
            parts[k].rect.height += parts[i].rect.height;
        } else {
            parts[kept++] = parts[i];
        }
    }
    return kept;
}

size_t seen_divide(struct seen_picture *seen, const struct cubes *cubes,
                   const struct engine_work *work, int side, struct engine_part **out)
{
    const struct engine_rect tile = work->tile;
    const int across = (tile.width + SQUARE - 1) / SQUARE;
    const int down = (tile.height + SQUARE - 1) / SQUARE;
    size_t count = 0;

    *out = memory_alloc((size_t)across * (size_t)down, sizeof **out);
    for (int y = 0; y < tile.height; y += SQUARE) {
        for (int x = 0; x < tile.width; x += SQUARE) {
            struct engine_part square = {{tile.x + x, tile.y + y, smaller(SQUARE, tile.width - x),
                                          smaller(SQUARE, tile.height - y)},
                                         -1,
                                         false};
            if (is_known(seen, cubes, square.rect)) {
                copy_pixels(seen, work, square.rect, false);
            } else {
                square.thread = thread_of(seen, square.rect);
                join(*out, &count, &square, side);
            }
        }
    }
    return pile_up(*out, count, side);
}

/* From the first block that lies in a stretch of pixels to before the first behind it. */
static void find_whole(int from, int length, int all, int *out_first, int *out_end)
{
    const int end = from + length;

    *out_first = blocks_in(from);
    *out_end = end == all ? blocks_in(end) : end / SQUARE_BLOCK;
}

void seen_take(struct seen_picture *seen, struct seen_square *square,
               const struct engine_work *work)
{
    const struct engine_rect rect = square->rect;
    int left, right, top, bottom;

    find_whole(rect.x, rect.width, seen->width, &left, &right);
    find_whole(rect.y, rect.height, seen->height, &top, &bottom);
    copy_pixels(seen, work, rect, true);
    square->blocks = 1; /* held here */
    seen->bytes += square_bytes(square);
    const bool keeps = seen->bytes <= seen->most;
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            struct seen_square **block = &seen->blocks[y * seen->across + x];
            let_go(seen, *block);
            *block = keeps ? square : NULL;
            square->blocks += keeps;
        }
    }
    let_go(seen, square);
}

/* --- what a part is made of --- */

void noted_grow(struct noted *noted)
{
    noted->room = noted->room ? 2 * noted->room : 1024;
    noted->cubes = memory_resize(noted->cubes, noted->room, sizeof *noted->cubes);
}

struct noted_value *noted_value_add(struct noted *noted, int count)
{
    const struct noted_value value = {.count = (uint16_t)count};
    const size_t bytes = noted_value_bytes(&value);

    if (noted->value_room - noted->value_bytes < bytes) {
        noted->value_room = 2 * (noted->value_room + bytes);
        noted->values = memory_resize(noted->values, noted->value_room, 1);
    }
    struct noted_value *added = (void *)(noted->values + noted->value_bytes);
    noted->value_bytes += bytes;
    *added = value;
    return added;
}

size_t noted_bytes(const struct noted *noted)
{
    return noted->value_room + noted->room * sizeof *noted->cubes;
}

void noted_finish(struct noted *noted)
{
    free(noted->cubes);
    free(noted->values);
    free(noted->made);
}
