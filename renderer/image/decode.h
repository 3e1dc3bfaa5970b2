/* SPDX-License-Identifier: MIT */
/* Decoders of untrusted files: PNG and Radiance HDR. Every byte is checked, and a malformed file is
 * refused. A file is read row by row. A picture larger than an environment map is averaged while it
 * is read, so that it is never in memory as a whole. */
#ifndef RENDERER_DECODE_H
#define RENDERER_DECODE_H

#include "protocol/asset.h"
#include "protocol/limits.h"

enum {
    DECODED_WIDTH = LIMIT_PANORAMA_WIDTH, /* at most; longitudes */
    DECODED_HEIGHT = DECODED_WIDTH / 2,   /* latitudes */
    DECODED_TEXEL_BYTES = 8,
};

struct decoded {
    int width, height;
    uint16_t *rgba; /* halves of linear light, row 0 on top; finite, 0 and above; the fourth is 1;
                       owned */
};

/* Transparency is left out of account. Any thread. `between` is called before each row, and may
 * wait; NULL: nothing is. */
bool image_decode(const uint8_t *bytes, size_t length, void (*between)(void), struct decoded *out,
                  struct error *err);
void decoded_finish(struct decoded *decoded);

/* The formats. hdr_decode gets what is behind the head. */
struct shrink;
bool png_decode(const uint8_t *bytes, size_t length, struct shrink *out, struct error *err);
bool hdr_decode(const uint8_t *bytes, size_t length, struct shrink *out, struct error *err);

#endif
