/* SPDX-License-Identifier: MIT */
/* Pictures as rows of pixels, and the files that they become. Touches no GL; any thread. */
#ifndef RENDERER_IMAGE_H
#define RENDERER_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "protocol/codec.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "protocol/picture.h"

/* Rows from the top, no padding. PIXEL_RGBA8 has four bytes for each pixel also with 3 channels:
 * the fourth means nothing then. */
enum pixel_format { PIXEL_RGBA8, PIXEL_GRAY16, PIXEL_FLOAT, PIXEL_UINT32 };
struct image {
    int width, height;
    int channels;
    enum pixel_format format;
    void *pixels; /* owned */
    size_t bytes;
};
void image_finish(struct image *image);

struct encode_params {
    enum codec format;  /* one that codec_find gives */
    int quality;        /* JPEG 1..100; 0: 90 */
    bool chroma_halved; /* JPEG 4:2:0 */
    bool fast;          /* PNG level 1, filter SUB: for streaming; the pixels are the same */
    bool zipped;        /* a ZIP also of one output */
    bool whole;         /* of a stream: behind a difference the file of the whole picture too */
    size_t limit_bytes; /* of the file; 0: none */
};
/* `*out_bytes` is malloc'ed. */
bool image_encode(const struct image *image, const struct encode_params *params,
                  uint8_t **out_bytes, size_t *out_length, struct error *err);

/* The file of a picture, written as its rows come: one output in its format, several in a ZIP of
 * color.png, depth.png and so on; they wait in temporary files meanwhile. Any thread, one at a
 * time. */
struct picture_file;
/* `shapes`: those of job_image_info. `out` stays the caller's. NULL and `err` where the format
 * cannot hold them. */
struct picture_file *picture_file_create(const struct image shapes[AOV_COUNT],
                                         const struct encode_params *params, FILE *out,
                                         struct error *err);
enum codec picture_file_codec(const struct picture_file *file);
bool picture_file_add(struct picture_file *file, enum aov aov, const struct image *rows,
                      struct error *err);
/* When all rows of all outputs were added. */
bool picture_file_end(struct picture_file *file, struct error *err);
void picture_file_destroy(struct picture_file *file);

#endif
