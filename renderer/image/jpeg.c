/* SPDX-License-Identifier: MIT */
/* JPEG by libjpeg-turbo: colour from 8-bit pixels, grey from the upper half of 16 bits. */
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "encode.h"
#include "protocol/memory.h"

enum { QUALITY_DEFAULT = 90 };

static uint8_t *gray_bytes(const struct image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    const uint16_t *from = image->pixels;
    uint8_t *to = memory_alloc(count, 1);

    for (size_t i = 0; i < count; i++) {
        to[i] = (uint8_t)(from[i] >> 8);
    }
    return to;
}

bool jpeg_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                 size_t *out_length, struct error *err)
{
    const bool gray = image->format == PIXEL_GRAY16;
    const int quality = params->quality ? params->quality : QUALITY_DEFAULT;
    const int sampling = gray ? TJSAMP_GRAY : params->chroma_halved ? TJSAMP_420 : TJSAMP_444;
    uint8_t *grays = NULL, *bytes = NULL;
    unsigned long length = 0;
    tjhandle jpeg;
    bool ok;

    if (image->format != PIXEL_RGBA8 && !gray) {
        return error_set(err, ERROR_INVALID, "format", "JPEG holds no raw values; npy does");
    }
    if (quality < 1 || quality > 100) {
        return error_set(err, ERROR_LIMIT, "quality", "%d is not in 1..100", quality);
    }
    jpeg = tjInitCompress();
    if (!jpeg) {
        return error_set(err, ERROR_INTERNAL, "jpeg", "%s", tjGetErrorStr2(NULL));
    }
    grays = gray ? gray_bytes(image) : NULL;
    ok = tjCompress2(jpeg, gray ? grays : image->pixels, image->width, 0, image->height,
                     gray ? TJPF_GRAY : TJPF_RGBX, &bytes, &length, sampling, quality, 0) == 0;
    if (ok) {
        /* The library's memory has its own way to be freed; ours is malloc's. */
        *out_bytes = memory_alloc(length, 1);
        memcpy(*out_bytes, bytes, length);
        *out_length = length;
    } else {
        error_set(err, ERROR_INTERNAL, "jpeg", "%s", tjGetErrorStr2(jpeg));
    }
    tjFree(bytes);
    tjDestroy(jpeg);
    free(grays);
    return ok;
}
