/* SPDX-License-Identifier: MIT */
/* NPY, version 1.0: the raw values with a header that NumPy reads (numpy.lib.format). */
#include <string.h>

#include "encode.h"

enum { ALIGNMENT = 64, HEAD_BYTES = 10 };

static const char *type_name(enum pixel_format format)
{
    switch (format) {
    case PIXEL_RGBA8:
        return "|u1";
    case PIXEL_GRAY16:
        return "<u2";
    case PIXEL_FLOAT:
        return "<f4";
    case PIXEL_UINT32:
        return "<u4";
    }
    return "|u1";
}

static void *begin(const struct image *shape, const struct encode_params *params, FILE *out,
                   struct error *err)
{
    char head[3 * ALIGNMENT], sides[48];
    size_t length, padded;

    (void)params;
    (void)err;
    snprintf(sides, sizeof sides, shape->channels > 1 ? "%d, %d, %d" : "%d, %d", shape->height,
             shape->width, shape->channels);
    memset(head, ' ', sizeof head);
    length =
        HEAD_BYTES + (size_t)snprintf(head + HEAD_BYTES, sizeof head - HEAD_BYTES,
                                      "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }",
                                      type_name(shape->format), sides);
    padded = (length + 1 + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    memcpy(head, "\x93NUMPY\x01\x00", 8);
    head[8] = (char)((padded - HEAD_BYTES) & 255);
    head[9] = (char)((padded - HEAD_BYTES) >> 8);
    head[length] = ' '; /* the end of the text */
    head[padded - 1] = '\n';
    fwrite(head, 1, padded, out);
    return out;
}

static bool add(void *state, const struct image *rows, struct error *err)
{
    (void)err;
    fwrite(rows->pixels, 1, rows->bytes, state);
    return true;
}

static bool end(void *state, struct error *err)
{
    (void)state;
    (void)err;
    return true;
}

static void destroy(void *state)
{
    (void)state;
}

const struct encoder_class npy_class = {begin, add, end, destroy};
