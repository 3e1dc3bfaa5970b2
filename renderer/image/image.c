/* SPDX-License-Identifier: MIT */
/* The way of rows into files. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "encode.h"

static const struct encoder_class *const classes[] = {
    [CODEC_PNG] = &png_class,
    [CODEC_JPEG] = &jpeg_class,
    [CODEC_NPY] = &npy_class,
    [CODEC_HDR] = &hdr_class,
};

void image_finish(struct image *image)
{
    free(image->pixels);
    *image = (struct image){0};
}

bool encode_flush(FILE *out, struct error *err)
{
    return (fflush(out) == 0 && !ferror(out)) ||
           error_set(err, ERROR_UNAVAILABLE, "", "the picture cannot be written: %s",
                     strerror(errno));
}

bool image_encoder_begin(struct image_encoder *encoder, const struct image *shape,
                         const struct encode_params *params, FILE *out, struct error *err)
{
    if ((size_t)params->format >= sizeof classes / sizeof *classes || !classes[params->format]) {
        return error_set(err, ERROR_INVALID, "format", "unknown");
    }
    encoder->class = classes[params->format];
    encoder->out = out;
    encoder->state = encoder->class->begin(shape, params, out, err);
    return encoder->state;
}

bool image_encoder_add(struct image_encoder *encoder, const struct image *rows, struct error *err)
{
    return encoder->class->add(encoder->state, rows, err);
}

bool image_encoder_end(struct image_encoder *encoder, struct error *err)
{
    return encoder->class->end(encoder->state, err) && encode_flush(encoder->out, err);
}

void image_encoder_finish(struct image_encoder *encoder)
{
    if (encoder->state) {
        encoder->class->destroy(encoder->state);
    }
    *encoder = (struct image_encoder){0};
}

bool image_encode(const struct image *image, const struct encode_params *params,
                  uint8_t **out_bytes, size_t *out_length, struct error *err)
{
    struct image_encoder encoder = {0};
    char *bytes = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&bytes, &length);
    bool ok;

    if (!out) {
        abort();
    }
    ok = image_encoder_begin(&encoder, image, params, out, err) &&
         image_encoder_add(&encoder, image, err) && image_encoder_end(&encoder, err);
    image_encoder_finish(&encoder);
    fclose(out);
    if (!ok) {
        free(bytes);
        return false;
    }
    *out_bytes = (uint8_t *)bytes;
    *out_length = length;
    return true;
}
