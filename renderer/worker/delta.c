/* SPDX-License-Identifier: MIT */
#include "delta.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum { PIXEL_BYTES = 4, MOST_CHANGED = 2 }; /* one of so many squares */

struct run {
    size_t first, count; /* squares, by rows from the top */
};

struct delta {
    FILE *out;
    /* The picture that is made: */
    struct image shapes[AOV_COUNT];
    struct encode_params params;
    struct image shape;        /* of its only output; width 0: it is not kept */
    struct picture_file *file; /* of a key; NULL: none so far */
    uint8_t *pixels;           /* NULL: it is not kept */
    int rows, compared;        /* that are in; of these, compared */
    struct run *runs;          /* that have changed */
    size_t run_count, changed;
    /* The last one: */
    uint8_t *last; /* NULL: there is none to build on */
    struct image last_shape;
    struct encode_params last_params;
};

static void *open_delta(void *about)
{
    (void)about;
    return memory_alloc(1, sizeof(struct delta));
}

static void drop(struct delta *delta)
{
    picture_file_destroy(delta->file);
    free(delta->pixels);
    free(delta->runs);
    delta->file = NULL;
    delta->pixels = NULL;
    delta->runs = NULL;
    delta->run_count = delta->changed = 0;
    delta->rows = delta->compared = 0;
}

static void close_delta(void *state)
{
    struct delta *delta = state;

    drop(delta);
    free(delta->last);
    free(delta);
}

/* --- the picture that is made --- */

/* That of its only output, where that is one to be kept. */
static struct image kept_shape(const struct image shapes[AOV_COUNT])
{
    struct image only = {0};
    int outputs = 0;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (shapes[i].width > 0) {
            only = shapes[i];
            outputs++;
        }
    }
    return outputs == 1 && only.format == PIXEL_RGBA8 && only.channels == 3 &&
                   (int64_t)only.width * only.height <= LIMIT_DELTA_PIXELS
               ? only
               : (struct image){0};
}

static size_t stride_of(const struct delta *delta)
{
    return PIXEL_BYTES * (size_t)delta->shape.width;
}

static int squares_along(int pixels)
{
    return (pixels + DELTA_SIDE - 1) / DELTA_SIDE;
}

static size_t squares_of(const struct image *shape)
{
    return (size_t)squares_along(shape->width) * (size_t)squares_along(shape->height);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static bool follows_last(const struct delta *delta)
{
    const struct encode_params *a = &delta->params, *b = &delta->last_params;

    return delta->pixels && delta->last && delta->shape.width == delta->last_shape.width &&
           delta->shape.height == delta->last_shape.height && a->format == b->format &&
           a->quality == b->quality && a->chroma_halved == b->chroma_halved;
}

static bool begin_key(struct delta *delta, struct error *err)
{
    delta->file = picture_file_create(delta->shapes, &delta->params, delta->out, err);
    return delta->file;
}

static bool begin(void *state, const struct image shapes[AOV_COUNT],
                  const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    struct delta *delta = state;

    drop(delta);
    memcpy(delta->shapes, shapes, sizeof delta->shapes);
    delta->params = *params;
    delta->out = out;
    delta->shape = kept_shape(shapes);
    if (delta->shape.width > 0) {
        delta->pixels = memory_alloc((size_t)delta->shape.height, stride_of(delta));
    }
    return (!key && follows_last(delta)) || begin_key(delta, err);
}

/* --- its rows --- */

/* The fourth byte of an opaque pixel means nothing. */
static void keep_rows(struct delta *delta, const struct image *rows)
{
    static const uint8_t opaque[PIXEL_BYTES] = {0, 0, 0, 255};
    uint8_t *to = delta->pixels + (size_t)delta->rows * stride_of(delta);
    uint32_t mask;

    memcpy(&mask, opaque, sizeof mask);
    for (size_t i = 0; i < (size_t)rows->height * stride_of(delta); i += PIXEL_BYTES) {
        uint32_t pixel;

        memcpy(&pixel, (const uint8_t *)rows->pixels + i, sizeof pixel);
        pixel |= mask;
        memcpy(to + i, &pixel, sizeof pixel);
    }
    delta->rows += rows->height;
}

static bool has_changed(const struct delta *delta, int left, int top)
{
    const int width = smaller(DELTA_SIDE, delta->shape.width - left);
    const int end = smaller(top + DELTA_SIDE, delta->shape.height);

    for (int y = top; y < end; y++) {
        const size_t at = (size_t)y * stride_of(delta) + PIXEL_BYTES * (size_t)left;

        if (memcmp(delta->pixels + at, delta->last + at, PIXEL_BYTES * (size_t)width) != 0) {
            return true;
        }
    }
    return false;
}

static void add_changed(struct delta *delta, size_t square)
{
    struct run *run = delta->run_count ? &delta->runs[delta->run_count - 1] : NULL;

    delta->changed++;
    if (run && run->first + run->count == square) {
        run->count++;
        return;
    }
    delta->runs = memory_one_more(delta->runs, delta->run_count, sizeof *delta->runs);
    delta->runs[delta->run_count++] = (struct run){square, 1};
}

/* Rows of squares that are in. */
static void compare(struct delta *delta)
{
    const int across = squares_along(delta->shape.width);

    while (delta->compared < delta->rows &&
           (delta->rows - delta->compared >= DELTA_SIDE || delta->rows == delta->shape.height)) {
        const size_t first = (size_t)(delta->compared / DELTA_SIDE) * (size_t)across;

        for (int i = 0; i < across; i++) {
            if (has_changed(delta, i * DELTA_SIDE, delta->compared)) {
                add_changed(delta, first + (size_t)i);
            }
        }
        delta->compared += DELTA_SIDE;
    }
}

/* All that is in, at once. */
static bool turn_key(struct delta *delta, enum aov aov, struct error *err)
{
    struct image rows = delta->shape;

    rows.height = delta->rows;
    rows.pixels = delta->pixels;
    rows.bytes = (size_t)delta->rows * stride_of(delta);
    return begin_key(delta, err) && picture_file_add(delta->file, aov, &rows, err);
}

static bool add(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    struct delta *delta = state;

    if (delta->pixels) {
        keep_rows(delta, rows);
    }
    if (delta->file) {
        return picture_file_add(delta->file, aov, rows, err);
    }
    compare(delta);
    return MOST_CHANGED * delta->changed <= squares_of(&delta->shape) || turn_key(delta, aov, err);
}

/* --- its bytes --- */

static void put(FILE *out, size_t value)
{
    fputc((int)(value & 255), out);
    fputc((int)(value >> 8 & 255), out);
}

/* As encoders do with what is beyond the border: its last column and row go on. */
static void copy_square(const struct delta *delta, size_t square, uint8_t *to, size_t stride)
{
    const size_t across = (size_t)squares_along(delta->shape.width);
    const int left = (int)(square % across) * DELTA_SIDE, top = (int)(square / across) * DELTA_SIDE;

    for (int y = 0; y < DELTA_SIDE; y++) {
        const uint8_t *row =
            delta->pixels + (size_t)smaller(top + y, delta->shape.height - 1) * stride_of(delta);

        for (int x = 0; x < DELTA_SIDE; x++) {
            const size_t from = (size_t)smaller(left + x, delta->shape.width - 1);

            memcpy(to + (size_t)y * stride + PIXEL_BYTES * (size_t)x, row + PIXEL_BYTES * from,
                   PIXEL_BYTES);
        }
    }
}

/* The squares that have changed, in about as many rows as columns. */
static struct image make_atlas(const struct delta *delta)
{
    const size_t columns = (size_t)ceil(sqrt((double)delta->changed));
    const size_t rows = (delta->changed + columns - 1) / columns;
    const size_t stride = PIXEL_BYTES * DELTA_SIDE * columns;
    struct image atlas = {.width = (int)columns * DELTA_SIDE,
                          .height = (int)rows * DELTA_SIDE,
                          .channels = 3,
                          .format = PIXEL_RGBA8,
                          .bytes = rows * DELTA_SIDE * stride};
    size_t at = 0;

    atlas.pixels = memory_alloc(atlas.bytes, 1);
    for (size_t i = 0; i < delta->run_count; i++) {
        for (size_t k = 0; k < delta->runs[i].count; k++, at++) {
            uint8_t *to = (uint8_t *)atlas.pixels + at / columns * DELTA_SIDE * stride +
                          at % columns * DELTA_SIDE * PIXEL_BYTES;

            copy_square(delta, delta->runs[i].first + k, to, stride);
        }
    }
    return atlas;
}

/* Its colours are not halved: between squares that are no neighbours they would run into each
 * other. */
static bool write_atlas(struct delta *delta, struct error *err)
{
    struct encode_params params = delta->params;
    struct image atlas = make_atlas(delta);
    uint8_t *bytes = NULL;
    size_t length = 0;

    params.chroma_halved = false;
    const bool ok = image_encode(&atlas, &params, &bytes, &length, err);
    if (ok) {
        fwrite(bytes, 1, length, delta->out);
    }
    free(bytes);
    image_finish(&atlas);
    return ok;
}

static bool write_delta(struct delta *delta, struct error *err)
{
    put(delta->out, delta->run_count);
    for (size_t i = 0; i < delta->run_count; i++) {
        put(delta->out, delta->runs[i].first);
        put(delta->out, delta->runs[i].count);
    }
    return delta->changed == 0 || write_atlas(delta, err);
}

/* The file of the whole picture behind it. */
static bool write_whole(const struct delta *delta, size_t *out_bytes, struct error *err)
{
    struct image whole = delta->shape;
    uint8_t *bytes;

    whole.pixels = delta->pixels;
    whole.bytes = (size_t)whole.height * stride_of(delta);
    if (!image_encode(&whole, &delta->params, &bytes, out_bytes, err)) {
        return false;
    }
    fwrite(bytes, 1, *out_bytes, delta->out);
    free(bytes);
    return true;
}

static bool end(void *state, struct stream_packet *out, struct error *err)
{
    struct delta *delta = state;
    size_t whole = 0;
    const bool key = delta->file;
    const bool ok =
        key ? picture_file_end(delta->file, err)
            : write_delta(delta, err) && (!delta->params.whole || write_whole(delta, &whole, err));

    if (ok) {
        *out = (struct stream_packet){delta->params.format, key, whole};
        free(delta->last);
        delta->last = delta->pixels;
        delta->last_shape = delta->shape;
        delta->last_params = delta->params;
        delta->pixels = NULL;
    }
    drop(delta);
    return ok;
}

const struct stream_class delta_stream = {open_delta, begin, add, end, close_delta};
