/* SPDX-License-Identifier: MIT */
/* Formats by name, and the way to their encoders. */
#include <stdlib.h>
#include <string.h>

#include "encode.h"

static const struct format {
    const char *name, *mime;
    bool (*encode)(const struct image *image, const struct encode_params *params,
                   uint8_t **out_bytes, size_t *out_length, struct error *err);
} formats[] = {
    [IMAGE_PNG] = {"png", "image/png", png_encode},
    [IMAGE_JPEG] = {"jpg", "image/jpeg", jpeg_encode},
    [IMAGE_NPY] = {"npy", "application/x-npy", npy_encode},
};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

void image_finish(struct image *image)
{
    free(image->pixels);
    *image = (struct image){0};
}

int image_format_find(const char *name)
{
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (strcmp(formats[i].name, name) == 0) {
            return i;
        }
    }
    return strcmp(name, "jpeg") == 0 ? IMAGE_JPEG : -1;
}

const char *image_format_mime(enum image_format format)
{
    return formats[format].mime;
}

bool image_encode(const struct image *image, const struct encode_params *params,
                  uint8_t **out_bytes, size_t *out_length, struct error *err)
{
    if ((int)params->format < 0 || (int)params->format >= FORMAT_COUNT) {
        return error_set(err, ERROR_INVALID, "format", "unknown");
    }
    return formats[params->format].encode(image, params, out_bytes, out_length, err);
}
