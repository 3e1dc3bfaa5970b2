/* SPDX-License-Identifier: MIT */
#include "guide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "protocol/memory.h"
#include "renderer/field/field.h"

enum {
    MOST_NODES = 65535, /* of one guide; further ones are nothing */
    FAST = 3,           /* of zlib's levels: runs of equal pixels gain little from more */
    DEPTH_STEP = 4,     /* of so many pixels and rows the first one has a depth */
    NEAREST = 65535,    /* a depth; 1 is the farthest, 0 nothing */
};
#define LEAST_PART 1e-6 /* the nearest distance, relative to the farthest one, at least */

struct guide {
    struct field *field;
    FILE *out;
    uint32_t *nodes; /* numbers of the field by index - 1 */
    size_t node_count;
    uint16_t *indices; /* by number of the field; 0: not seen yet */
    size_t index_count;
    int width;
    uint8_t *pixels; /* of the whole picture, two bytes each; depths follow */
    size_t length, taken;
    float *distances; /* where a depth is told */
    int depth_width, depth_height;
    int row; /* the next one of the distances */
};

static void *open_guide(void *about)
{
    struct guide *guide = memory_alloc(1, sizeof *guide);

    guide->field = field_ref(about);
    return guide;
}

static void forget(struct guide *guide)
{
    free(guide->nodes);
    free(guide->indices);
    free(guide->pixels);
    free(guide->distances);
    *guide = (struct guide){.field = guide->field};
}

static bool begin_guide(void *state, const struct image shapes[AOV_COUNT],
                        const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    const struct image *shape = &shapes[AOV_ID], *depth = &shapes[AOV_DEPTH];
    struct guide *guide = state;

    (void)params;
    (void)key; /* each is one */
    forget(guide);
    if (shape->format != PIXEL_UINT32 || shape->width == 0 || depth->format != PIXEL_FLOAT ||
        depth->width == 0) {
        return error_set(err, ERROR_INTERNAL, "guide", "needs raw ids and distances");
    }
    guide->out = out;
    guide->width = shape->width;
    guide->depth_width = (shape->width + DEPTH_STEP - 1) / DEPTH_STEP;
    guide->depth_height = (shape->height + DEPTH_STEP - 1) / DEPTH_STEP;
    guide->distances = memory_alloc((size_t)guide->depth_width * (size_t)guide->depth_height,
                                    sizeof *guide->distances);
    guide->length = 2 * ((size_t)shape->width * (size_t)shape->height +
                         (size_t)guide->depth_width * (size_t)guide->depth_height);
    guide->pixels = memory_alloc(guide->length, 1);
    return true;
}

static void make_room(struct guide *guide, uint32_t number)
{
    const size_t count = 2 * (size_t)number + 64;

    guide->indices = memory_resize(guide->indices, count, sizeof *guide->indices);
    memset(guide->indices + guide->index_count, 0,
           (count - guide->index_count) * sizeof *guide->indices);
    guide->index_count = count;
}

/* What stands for a node in this guide; 0: no node. */
static uint16_t index_of(struct guide *guide, uint32_t number)
{
    if (number >= guide->index_count) {
        make_room(guide, number);
    }
    if (guide->indices[number] == 0 && guide->node_count < MOST_NODES &&
        field_leaf_id(guide->field, number)) {
        guide->nodes = memory_one_more(guide->nodes, guide->node_count, sizeof *guide->nodes);
        guide->nodes[guide->node_count++] = number;
        guide->indices[number] = (uint16_t)guide->node_count;
    }
    return guide->indices[number];
}

static void add_numbers(struct guide *guide, const struct image *rows)
{
    const uint32_t *numbers = rows->pixels;

    for (size_t i = 0; i < rows->bytes / sizeof *numbers; i++) {
        const uint16_t index = numbers[i] ? index_of(guide, numbers[i]) : 0;

        guide->pixels[guide->taken++] = (uint8_t)(index & 255);
        guide->pixels[guide->taken++] = (uint8_t)(index >> 8);
    }
}

static void add_distances(struct guide *guide, const struct image *rows)
{
    for (int y = 0; y < rows->height; y++, guide->row++) {
        const float *from = (const float *)rows->pixels + (ptrdiff_t)y * guide->width;
        float *to = guide->distances + (ptrdiff_t)(guide->row / DEPTH_STEP) * guide->depth_width;

        for (int i = 0; i < guide->depth_width && guide->row % DEPTH_STEP == 0; i++) {
            to[i] = from[i * DEPTH_STEP];
        }
    }
}

static bool add_rows(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    (void)err;
    if (aov == AOV_ID) {
        add_numbers(state, rows);
    } else {
        add_distances(state, rows);
    }
    return true;
}

/* --- depths --- */

/* 0 and 0 where nothing is hit. */
struct span {
    float nearest, farthest;
};

static struct span span_of(const float *distances, size_t count)
{
    struct span span = {INFINITY, 0};

    for (size_t i = 0; i < count; i++) {
        if (isfinite(distances[i])) {
            span.nearest = fminf(span.nearest, distances[i]);
            span.farthest = fmaxf(span.farthest, distances[i]);
        }
    }
    if (span.farthest <= 0) {
        return (struct span){0};
    }
    span.nearest = fmaxf(span.nearest, (float)LEAST_PART * span.farthest);
    return span;
}

/* Equal steps of the logarithm: everywhere the same part of the distance, however near or far
 * something else is. */
static uint16_t depth_of(float distance, const struct span *span, double per_fold)
{
    if (!isfinite(distance)) {
        return 0;
    }
    const double fold = fmax((double)distance, span->nearest) / span->nearest;

    return (uint16_t)lround(NEAREST - log(fold) * per_fold);
}

static uint16_t depth_at(const uint16_t *depths, int width, int x, int y)
{
    return x < 0 || y < 0 ? 0 : depths[(ptrdiff_t)y * width + x];
}

/* Each as its difference from the plane through its neighbours to the left and above, the sign in
 * the lowest bit: all low bytes, then all high ones. */
static void put_depths(const struct guide *guide, const uint16_t *depths, uint8_t *out)
{
    const int width = guide->depth_width, height = guide->depth_height;
    uint8_t *low = out, *high = out + (ptrdiff_t)width * height;

    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const int guess = depth_at(depths, width, x - 1, y) +
                              depth_at(depths, width, x, y - 1) -
                              depth_at(depths, width, x - 1, y - 1);
            const uint16_t apart = (uint16_t)(depth_at(depths, width, x, y) - guess);
            const uint16_t folded = (uint16_t)((apart << 1) ^ (apart & 0x8000 ? 0xffff : 0));

            *low++ = (uint8_t)(folded & 255);
            *high++ = (uint8_t)(folded >> 8);
        }
    }
}

static struct span add_depths(struct guide *guide)
{
    const size_t count = (size_t)guide->depth_width * (size_t)guide->depth_height;
    const struct span span = span_of(guide->distances, count);
    const double folds = span.nearest > 0 ? log((double)span.farthest / span.nearest) : 0;
    const double per_fold = folds > 0 ? (NEAREST - 1) / folds : 0;
    uint16_t *depths = memory_alloc(count, sizeof *depths);

    for (size_t i = 0; i < count; i++) {
        depths[i] = depth_of(guide->distances[i], &span, per_fold);
    }
    put_depths(guide, depths, guide->pixels + guide->taken);
    free(depths);
    return span;
}

/* --- the end --- */

static void write_float(float value, FILE *out)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++) {
        fputc((int)(bits >> (8 * i) & 255), out);
    }
}

static void write_names(const struct guide *guide)
{
    fputc((int)(guide->node_count & 255), guide->out);
    fputc((int)(guide->node_count >> 8), guide->out);
    for (size_t i = 0; i < guide->node_count; i++) {
        const char *id = field_leaf_id(guide->field, guide->nodes[i]);

        fputc((int)strlen(id), guide->out);
        fputs(id, guide->out);
    }
}

static bool end_guide(void *state, struct stream_packet *out, struct error *err)
{
    struct guide *guide = state;
    uLongf length = compressBound((uLong)guide->length);
    uint8_t *bytes = memory_alloc(length, 1);
    const struct span span = add_depths(guide);
    const bool ok = compress2(bytes, &length, guide->pixels, (uLong)guide->length, FAST) == Z_OK;

    if (ok) {
        write_names(guide);
        write_float(span.nearest, guide->out);
        write_float(span.farthest, guide->out);
        fwrite(bytes, 1, length, guide->out);
    } else {
        error_set(err, ERROR_INTERNAL, "guide", "cannot be compressed");
    }
    free(bytes);
    forget(guide);
    *out = (struct stream_packet){.codec = CODEC_GUIDE, .key = true};
    return ok;
}

static void close_guide(void *state)
{
    struct guide *guide = state;

    forget(guide);
    field_unref(guide->field);
    free(guide);
}

const struct stream_class guide_stream = {open_guide, begin_guide, add_rows, end_guide,
                                          close_guide};
