/* SPDX-License-Identifier: MIT */
/* The encoders behind image_encode and picture_file of image.h: rows in, bytes of a file out.
 * They touch no GL and may run in any thread, each in one at a time. */
#ifndef RENDERER_ENCODE_H
#define RENDERER_ENCODE_H

#include "image.h"

/* A file format. `begin` takes the kinds of pixels that the format knows, else ERROR_INVALID; its
 * result is what the others work on, and must go to `destroy` also after a failure. */
struct encoder_class {
    void *(*begin)(const struct image *shape, const struct encode_params *params, FILE *out,
                   struct error *err);
    bool (*add)(void *state, const struct image *rows, struct error *err);
    bool (*end)(void *state, struct error *err);
    void (*destroy)(void *state);
};
extern const struct encoder_class png_class, jpeg_class, npy_class, hdr_class;

/* One picture on its way into `out`, which stays the caller's. */
struct image_encoder {
    const struct encoder_class *class;
    void *state;
    FILE *out;
};
/* `shape`: the whole picture, without pixels. */
bool image_encoder_begin(struct image_encoder *encoder, const struct image *shape,
                         const struct encode_params *params, FILE *out, struct error *err);
bool image_encoder_add(struct image_encoder *encoder, const struct image *rows, struct error *err);
/* When all rows were added. */
bool image_encoder_end(struct image_encoder *encoder, struct error *err);
void image_encoder_finish(struct image_encoder *encoder); /* also of a zeroed one */

struct zip_part {
    char name[32];
    FILE *file; /* read from its beginning */
};
/* A ZIP of files as they are, not compressed once more. */
bool zip_write(const struct zip_part *parts, size_t count, FILE *out, struct error *err);

/* False and `err` where what was written to `out` did not all get there. */
bool encode_flush(FILE *out, struct error *err);

#endif
