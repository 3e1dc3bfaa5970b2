/* SPDX-License-Identifier: MIT */
/* PNG by libpng: 8 bits in sRGB, without alpha where all is opaque; 16-bit grey. */
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "encode.h"
#include "protocol/memory.h"

enum { FIRST_BYTES = 65536 };

struct sink {
    uint8_t *bytes;
    size_t length, capacity;
    struct error *err;
};

static void on_write(png_structp png, png_bytep bytes, size_t length)
{
    struct sink *sink = png_get_io_ptr(png);

    if (sink->length + length > sink->capacity) {
        while (sink->length + length > sink->capacity) {
            sink->capacity = sink->capacity ? 2 * sink->capacity : FIRST_BYTES;
        }
        sink->bytes = memory_resize(sink->bytes, sink->capacity, 1);
    }
    memcpy(sink->bytes + sink->length, bytes, length);
    sink->length += length;
}

static void on_flush(png_structp png)
{
    (void)png;
}

static void on_error(png_structp png, png_const_charp message)
{
    struct sink *sink = png_get_error_ptr(png);

    error_set(sink->err, ERROR_INTERNAL, "png", "%s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static bool is_opaque(const struct image *image)
{
    const uint8_t *pixels = image->pixels;

    for (size_t i = 3; i < image->bytes; i += 4) {
        if (pixels[i] != 255) {
            return false;
        }
    }
    return true;
}

static void write_rows(png_structp png, const struct image *image, bool swap, uint8_t *row)
{
    const size_t stride = image->bytes / (size_t)image->height;
    const uint8_t *from = image->pixels;

    for (int y = 0; y < image->height; y++, from += stride) {
        if (swap) { /* PNG is big-endian */
            for (size_t i = 0; i < stride; i += 2) {
                uint16_t value;
                memcpy(&value, from + i, 2);
                row[i] = (uint8_t)(value >> 8);
                row[i + 1] = (uint8_t)value;
            }
            png_write_row(png, row);
        } else {
            png_write_row(png, from);
        }
    }
}

static void write_picture(png_structp png, png_infop info, const struct image *image,
                          const struct encode_params *params, uint8_t *row)
{
    const bool gray = image->format == PIXEL_GRAY16;
    const bool opaque = !gray && is_opaque(image);

    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, gray ? 16 : 8,
                 gray     ? PNG_COLOR_TYPE_GRAY
                 : opaque ? PNG_COLOR_TYPE_RGB
                          : PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (params->fast) {
        png_set_compression_level(png, 1);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    }
    if (!gray) {
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    png_write_info(png, info);
    if (opaque) {
        png_set_filler(png, 0, PNG_FILLER_AFTER);
    }
    write_rows(png, image, gray, row);
    png_write_end(png, info);
}

bool png_encode(const struct image *image, const struct encode_params *params, uint8_t **out_bytes,
                size_t *out_length, struct error *err)
{
    struct sink sink = {.err = err};
    png_structp png;
    png_infop info;
    uint8_t *row;

    if (image->format != PIXEL_RGBA8 && image->format != PIXEL_GRAY16) {
        return error_set(err, ERROR_INVALID, "format", "PNG holds no raw values; npy does");
    }
    row = memory_alloc(image->bytes / (size_t)image->height, 1);
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
    info = png ? png_create_info_struct(png) : NULL;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        free(row);
        free(sink.bytes);
        return false;
    }
    png_set_user_limits(png, LIMIT_IMAGE_SIDE, LIMIT_IMAGE_SIDE);
    png_set_write_fn(png, &sink, on_write, on_flush);
    write_picture(png, info, image, params, row);
    png_destroy_write_struct(&png, &info);
    free(row);
    *out_bytes = sink.bytes;
    *out_length = sink.length;
    return true;
}
