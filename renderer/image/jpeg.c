/* SPDX-License-Identifier: MIT */
/* JPEG by libjpeg-turbo: colour from 8-bit pixels, grey from the upper half of 16 bits. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include <jpeglib.h>

#include "encode.h"
#include "protocol/memory.h"

enum { QUALITY_DEFAULT = 90 };

struct jpeg_writer {
    struct jpeg_error_mgr errors; /* the first, for the way back from the library's pointer to it */
    struct jpeg_compress_struct jpeg;
    jmp_buf back;
    uint8_t *grays; /* one row; NULL: colours */
};

static void on_error(j_common_ptr jpeg)
{
    longjmp(((struct jpeg_writer *)(void *)jpeg->err)->back, 1);
}

static void on_message(j_common_ptr jpeg)
{
    (void)jpeg;
}

static bool fail(struct jpeg_writer *w, struct error *err)
{
    char text[JMSG_LENGTH_MAX];

    w->errors.format_message((j_common_ptr)&w->jpeg, text);
    return error_set(err, ERROR_INTERNAL, "jpeg", "%s", text);
}

static bool accepts(const struct image *shape, const struct encode_params *params,
                    struct error *err)
{
    if (shape->format != PIXEL_RGBA8 && shape->format != PIXEL_GRAY16) {
        return error_set(err, ERROR_INVALID, "format", "JPEG holds no raw values; npy does");
    }
    if (shape->format == PIXEL_RGBA8 && shape->channels == 4) {
        return error_set(err, ERROR_INVALID, "format",
                         "JPEG holds no transparent background; png does");
    }
    if (params->quality < 0 || params->quality > 100) {
        return error_set(err, ERROR_LIMIT, "quality", "%d is not in 1..100", params->quality);
    }
    return true;
}

static bool start(struct jpeg_writer *w, const struct image *shape,
                  const struct encode_params *params, FILE *out, struct error *err)
{
    if (setjmp(w->back)) {
        return fail(w, err);
    }
    jpeg_create_compress(&w->jpeg);
    jpeg_stdio_dest(&w->jpeg, out);
    w->jpeg.image_width = (JDIMENSION)shape->width;
    w->jpeg.image_height = (JDIMENSION)shape->height;
    w->jpeg.input_components = w->grays ? 1 : 4;
    w->jpeg.in_color_space = w->grays ? JCS_GRAYSCALE : JCS_EXT_RGBX;
    jpeg_set_defaults(&w->jpeg);
    jpeg_set_quality(&w->jpeg, params->quality ? params->quality : QUALITY_DEFAULT, TRUE);
    w->jpeg.dct_method = params->fast ? JDCT_IFAST : JDCT_ISLOW;
    if (!params->chroma_halved) {
        w->jpeg.comp_info[0].h_samp_factor = w->jpeg.comp_info[0].v_samp_factor = 1;
    }
    jpeg_start_compress(&w->jpeg, TRUE);
    return true;
}

static void destroy(void *state)
{
    struct jpeg_writer *w = state;

    jpeg_destroy_compress(&w->jpeg);
    free(w->grays);
    free(w);
}

static void *begin(const struct image *shape, const struct encode_params *params, FILE *out,
                   struct error *err)
{
    struct jpeg_writer *w;

    if (!accepts(shape, params, err)) {
        return NULL;
    }
    w = memory_alloc(1, sizeof *w);
    w->jpeg.err = jpeg_std_error(&w->errors);
    w->errors.error_exit = on_error;
    w->errors.output_message = on_message;
    w->grays = shape->format == PIXEL_GRAY16 ? memory_alloc((size_t)shape->width, 1) : NULL;
    if (!start(w, shape, params, out, err)) {
        destroy(w);
        return NULL;
    }
    return w;
}

static JSAMPROW row_of(const struct jpeg_writer *w, const struct image *rows, int y)
{
    const size_t width = (size_t)rows->width;
    const uint16_t *from = (const uint16_t *)rows->pixels + (size_t)y * width;

    if (!w->grays) {
        return (JSAMPROW)rows->pixels + (size_t)y * width * 4;
    }
    for (size_t x = 0; x < width; x++) {
        w->grays[x] = (uint8_t)(from[x] >> 8);
    }
    return w->grays;
}

static bool add(void *state, const struct image *rows, struct error *err)
{
    struct jpeg_writer *w = state;

    if (setjmp(w->back)) {
        return fail(w, err);
    }
    for (int y = 0; y < rows->height; y++) {
        JSAMPROW row = row_of(w, rows, y);
        jpeg_write_scanlines(&w->jpeg, &row, 1);
    }
    return true;
}

static bool end(void *state, struct error *err)
{
    struct jpeg_writer *w = state;

    if (setjmp(w->back)) {
        return fail(w, err);
    }
    jpeg_finish_compress(&w->jpeg);
    return true;
}

const struct encoder_class jpeg_class = {begin, add, end, destroy};
