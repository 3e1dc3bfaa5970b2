/* SPDX-License-Identifier: MIT */
#include "guide.h"

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "protocol/memory.h"
#include "renderer/field/field.h"

enum {
    MOST_NODES = 65535, /* of one guide; further ones are nothing */
    FAST = 3,           /* of zlib's levels: runs of equal pixels gain little from more */
};

struct guide {
    struct field *field;
    FILE *out;
    uint32_t *nodes; /* numbers of the field by index - 1 */
    size_t node_count;
    uint16_t *indices; /* by number of the field; 0: not seen yet */
    size_t index_count;
    uint8_t *pixels; /* of the whole picture, two bytes each */
    size_t length, taken;
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
    *guide = (struct guide){.field = guide->field};
}

static bool begin_guide(void *state, const struct image shapes[AOV_COUNT],
                        const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    const struct image *shape = &shapes[AOV_ID];
    struct guide *guide = state;

    (void)params;
    (void)key; /* each is one */
    forget(guide);
    if (shape->format != PIXEL_UINT32 || shape->width == 0) {
        return error_set(err, ERROR_INTERNAL, "guide", "needs raw ids");
    }
    guide->out = out;
    guide->length = (size_t)shape->width * (size_t)shape->height * 2;
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
        guide->nodes = memory_resize(guide->nodes, guide->node_count + 1, sizeof *guide->nodes);
        guide->nodes[guide->node_count++] = number;
        guide->indices[number] = (uint16_t)guide->node_count;
    }
    return guide->indices[number];
}

static bool add_rows(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    const uint32_t *numbers = rows->pixels;
    struct guide *guide = state;

    (void)aov;
    (void)err;
    for (size_t i = 0; i < rows->bytes / sizeof *numbers; i++) {
        const uint16_t index = numbers[i] ? index_of(guide, numbers[i]) : 0;

        guide->pixels[guide->taken++] = (uint8_t)(index & 255);
        guide->pixels[guide->taken++] = (uint8_t)(index >> 8);
    }
    return true;
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
    const bool ok = compress2(bytes, &length, guide->pixels, (uLong)guide->length, FAST) == Z_OK;

    if (ok) {
        write_names(guide);
        fwrite(bytes, 1, length, guide->out);
    } else {
        error_set(err, ERROR_INTERNAL, "guide", "cannot be compressed");
    }
    free(bytes);
    forget(guide);
    *out = (struct stream_packet){CODEC_GUIDE, true};
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
