/* SPDX-License-Identifier: MIT */
/* NPY, version 1.0: the raw values with a header that NumPy reads (numpy.lib.format). */
#include <stdlib.h>
#include <string.h>

#include "encode.h"
#include "protocol/memory.h"

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

bool npy_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                size_t *out_length, struct error *err)
{
    char text[3 * ALIGNMENT], shape[48];
    size_t length, padded;
    uint8_t *bytes;

    (void)params;
    (void)err;
    snprintf(shape, sizeof shape, image->channels > 1 ? "%d, %d, %d" : "%d, %d", image->height,
             image->width, image->channels);
    snprintf(text, sizeof text, "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }",
             type_name(image->format), shape);
    length = strlen(text);
    padded = (HEAD_BYTES + length + 1 + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    bytes = memory_alloc(padded + image->bytes, 1);
    memset(bytes, ' ', padded);
    memcpy(bytes, "\x93NUMPY\x01\x00", 8);
    bytes[8] = (uint8_t)((padded - HEAD_BYTES) & 255);
    bytes[9] = (uint8_t)((padded - HEAD_BYTES) >> 8);
    memcpy(bytes + HEAD_BYTES, text, length);
    bytes[padded - 1] = '\n';
    memcpy(bytes + padded, image->pixels, image->bytes);
    *out_bytes = bytes;
    *out_length = padded + image->bytes;
    return true;
}
