/* SPDX-License-Identifier: MIT */
/* PNG by libpng: 8 bits in sRGB, with alpha where the background is left out; 16-bit grey. */
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>

#include "encode.h"
#include "protocol/memory.h"

struct png_writer {
    png_structp png;
    png_infop info;
    struct error error; /* what libpng says */
};

static void on_error(png_structp png, png_const_charp message)
{
    struct png_writer *w = png_get_error_ptr(png);

    error_set(&w->error, ERROR_INTERNAL, "png", "%s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static bool fail(const struct png_writer *w, struct error *err)
{
    if (err) {
        *err = w->error;
    }
    return false;
}

static bool write_head(struct png_writer *w, const struct image *shape,
                       const struct encode_params *params, FILE *out, struct error *err)
{
    const bool gray = shape->format == PIXEL_GRAY16, alpha = shape->channels == 4;

    if (setjmp(png_jmpbuf(w->png))) {
        return fail(w, err);
    }
    png_set_user_limits(w->png, LIMIT_IMAGE_SIDE, LIMIT_IMAGE_SIDE);
    png_init_io(w->png, out);
    png_set_IHDR(w->png, w->info, (png_uint_32)shape->width, (png_uint_32)shape->height,
                 gray ? 16 : 8,
                 gray    ? PNG_COLOR_TYPE_GRAY
                 : alpha ? PNG_COLOR_TYPE_RGB_ALPHA
                         : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (params->fast) {
        png_set_compression_level(w->png, 1);
        png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    }
    if (!gray) {
        png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    png_write_info(w->png, w->info);
    if (gray) {
        png_set_swap(w->png); /* PNG is big-endian */
    } else if (!alpha) {
        png_set_filler(w->png, 0, PNG_FILLER_AFTER);
    }
    return true;
}

static void destroy(void *state)
{
    struct png_writer *w = state;

    png_destroy_write_struct(&w->png, &w->info);
    free(w);
}

static void *begin(const struct image *shape, const struct encode_params *params, FILE *out,
                   struct error *err)
{
    struct png_writer *w;

    if (shape->format != PIXEL_RGBA8 && shape->format != PIXEL_GRAY16) {
        error_set(err, ERROR_INVALID, "format", "PNG holds no raw values; npy does");
        return NULL;
    }
    w = memory_alloc(1, sizeof *w);
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    w->info = w->png ? png_create_info_struct(w->png) : NULL;
    if (!w->info || !write_head(w, shape, params, out, err)) {
        destroy(w);
        return NULL;
    }
    return w;
}

static bool add(void *state, const struct image *rows, struct error *err)
{
    struct png_writer *w = state;
    const size_t stride = rows->bytes / (size_t)rows->height;

    if (setjmp(png_jmpbuf(w->png))) {
        return fail(w, err);
    }
    for (int y = 0; y < rows->height; y++) {
        png_write_row(w->png, (const uint8_t *)rows->pixels + (size_t)y * stride);
    }
    return true;
}

static bool end(void *state, struct error *err)
{
    struct png_writer *w = state;

    if (setjmp(png_jmpbuf(w->png))) {
        return fail(w, err);
    }
    png_write_end(w->png, w->info);
    return true;
}

const struct encoder_class png_class = {begin, add, end, destroy};
