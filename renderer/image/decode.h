/* SPDX-License-Identifier: MIT */
/* Pictures out of files that strangers made: PNG and Radiance HDR. Every byte is checked, and a
 * file that is not as it should be is refused. */
#ifndef RENDERER_DECODE_H
#define RENDERER_DECODE_H

#include "protocol/asset.h"

struct decoded {
    int width, height;
    float *rgb; /* linear, three each, row 0 on top; finite, 0 and above; owned */
};

/* Transparency is left out of account. */
bool image_decode(const uint8_t *bytes, size_t length, struct decoded *out, struct error *err);
void decoded_finish(struct decoded *decoded);

/* The formats: fill `out`, whose pixels are allocated. hdr_decode gets what is behind the head. */
bool png_decode(const uint8_t *bytes, size_t length, const struct decoded *out, struct error *err);
bool hdr_decode(const uint8_t *bytes, size_t length, const struct decoded *out, struct error *err);

#endif
