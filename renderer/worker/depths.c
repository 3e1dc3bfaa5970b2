/* SPDX-License-Identifier: MIT */
#include "depths.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "delta.h"
#include "protocol/memory.h"

enum {
    MOST_BLOCKS = 16384, /* of a picture; then its blocks are wider */
    NEAREST = 255,       /* a depth; 0 is nothing, or too far to move */
    TIMES_MEAN = 16,     /* what is nearer than so is as near as that */
    FAST = 3,            /* of zlib's levels */
};

struct depths {
    struct stream_encoder *picture;
    FILE *out;
    float *distances; /* the least of each block */
    int width, side, across, down;
    int row; /* the next one of pixels */
};

static void *open_behind(const struct stream_class *class)
{
    struct depths *depths = memory_alloc(1, sizeof *depths);

    depths->picture = stream_encoder_open(class, NULL);
    return depths;
}

static void *open_depths(void *about)
{
    (void)about;
    return open_behind(&picture_stream);
}

static void *open_depths_delta(void *about)
{
    (void)about;
    return open_behind(&delta_stream);
}

static void divide(struct depths *depths, const struct image *shape)
{
    depths->side = 1;
    do {
        depths->across = (shape->width + depths->side - 1) / depths->side;
        depths->down = (shape->height + depths->side - 1) / depths->side;
        depths->side *= 2;
    } while ((int64_t)depths->across * depths->down > MOST_BLOCKS);
    depths->side /= 2;
    depths->width = shape->width;
}

static size_t count_of(const struct depths *depths)
{
    return (size_t)depths->across * (size_t)depths->down;
}

static bool begin(void *state, const struct image shapes[AOV_COUNT],
                  const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    struct depths *depths = state;
    struct image color[AOV_COUNT] = {[AOV_COLOR] = shapes[AOV_COLOR]};

    if (key) {
        stream_encoder_ask_key(depths->picture);
    }
    if (shapes[AOV_DEPTH].format != PIXEL_FLOAT || shapes[AOV_DEPTH].width == 0) {
        return error_set(err, ERROR_INTERNAL, "depths", "need raw distances");
    }
    divide(depths, &shapes[AOV_DEPTH]);
    depths->out = out;
    depths->row = 0;
    free(depths->distances);
    depths->distances = memory_alloc(count_of(depths), sizeof *depths->distances);
    for (size_t i = 0; i < count_of(depths); i++) {
        depths->distances[i] = INFINITY;
    }
    return stream_encoder_begin(depths->picture, color, params, out, err);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static void add_distances(struct depths *depths, const struct image *rows)
{
    const float *from = rows->pixels;

    for (int y = 0; y < rows->height; y++, depths->row++) {
        float *to = depths->distances + (ptrdiff_t)(depths->row / depths->side) * depths->across;
        for (int x = 0; x < depths->width; to++) {
            float least = *to;
            for (const int end = smaller(x + depths->side, depths->width); x < end; x++, from++) {
                const float distance = fabsf(*from); /* below 0: from inside of something */
                least = distance < least ? distance : least;
            }
            *to = least;
        }
    }
}

static bool add(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    struct depths *depths = state;

    if (aov == AOV_COLOR) {
        return stream_encoder_add(depths->picture, aov, rows, err);
    }
    add_distances(depths, rows);
    return true;
}

/* What has the depth NEAREST; 0: nothing is hit. A blade of grass before the eye takes the steps of
 * no landscape. */
static float nearest_of(const struct depths *depths)
{
    double sum = 0, most = 0;
    size_t hits = 0;

    for (size_t i = 0; i < count_of(depths); i++) {
        const double inverse = 1 / fmax((double)depths->distances[i], FLT_MIN);
        sum += inverse;
        most = fmax(most, inverse);
        hits += inverse > 0;
    }
    return hits ? (float)(1 / fmin(most, TIMES_MEAN * sum / (double)hits)) : 0;
}

/* Each as its difference from the plane through its neighbours to the left and above. */
static void put_depths(const struct depths *depths, float nearest, uint8_t *out)
{
    const int across = depths->across;
    uint8_t *all = memory_alloc(count_of(depths), 1);

    for (int i = 0; i < across * depths->down; i++) {
        const int left = i % across > 0 ? all[i - 1] : 0, above = i >= across ? all[i - across] : 0;
        const int corner = i % across > 0 && i >= across ? all[i - across - 1] : 0;
        const float part = nearest / depths->distances[i];

        all[i] = (uint8_t)(NEAREST * (part < 1 ? part : 1) + 0.5F);
        out[i] = (uint8_t)(all[i] - left - above + corner);
    }
    free(all);
}

static void put(FILE *out, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        fputc((int)(value >> 8 * i & 255), out);
    }
}

static bool write_depths(const struct depths *depths, struct error *err)
{
    const float nearest = nearest_of(depths);
    uLongf length = compressBound((uLong)count_of(depths));
    uint8_t *plain = memory_alloc(count_of(depths), 1), *bytes = memory_alloc(length, 1);
    uint32_t bits;

    put_depths(depths, nearest, plain);
    const bool ok = compress2(bytes, &length, plain, (uLong)count_of(depths), FAST) == Z_OK;
    if (ok) {
        memcpy(&bits, &nearest, sizeof bits);
        fwrite(bytes, 1, length, depths->out);
        put(depths->out, bits, 4);
        put(depths->out, (uint32_t)depths->side, 2);
        put(depths->out, (uint32_t)length, 4);
    } else {
        error_set(err, ERROR_INTERNAL, "depths", "cannot be compressed");
    }
    free(plain);
    free(bytes);
    return ok;
}

static bool end(void *state, struct stream_packet *out, struct error *err)
{
    struct depths *depths = state;

    const bool ok = stream_encoder_end(depths->picture, out, err) && write_depths(depths, err);

    if (!ok) {
        stream_encoder_ask_key(depths->picture); /* it may have ended well */
    }
    return ok;
}

static void close_depths(void *state)
{
    struct depths *depths = state;

    stream_encoder_close(depths->picture);
    free(depths->distances);
    free(depths);
}

const struct stream_class depths_stream = {open_depths, begin, add, end, close_depths};
const struct stream_class depths_delta_stream = {open_depths_delta, begin, add, end, close_depths};
