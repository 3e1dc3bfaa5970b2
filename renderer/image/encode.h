/* SPDX-License-Identifier: MIT */
/* The encoders behind image_encode of renderer.h: an image in, bytes of a file out. They touch no
 * GL and may run in any thread. */
#ifndef RENDERER_ENCODE_H
#define RENDERER_ENCODE_H

#include "renderer/renderer.h"

/* Each takes the kinds of pixels that its format knows, else ERROR_INVALID. */
bool png_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                size_t *out_length, struct error *err);
bool jpeg_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                 size_t *out_length, struct error *err);
bool npy_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                size_t *out_length, struct error *err);

#endif
