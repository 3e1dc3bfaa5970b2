/* SPDX-License-Identifier: MIT */
/* PNG by libpng: whatever it holds becomes 16 bits of red, green and blue, taken as sRGB. */
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "decode.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

enum { CHUNK_BYTES = 8 << 20 }; /* of text and profiles */

struct source {
    const uint8_t *bytes;
    size_t left;
    struct error *err;
};

static void on_error(png_structp png, png_const_charp message)
{
    const struct source *source = png_get_error_ptr(png);

    error_set(source->err, ERROR_INVALID, "", "the PNG file is damaged: %s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_read(png_structp png, png_bytep out, size_t count)
{
    struct source *source = png_get_io_ptr(png);

    if (count > source->left) {
        png_error(png, "it is cut off");
    }
    memcpy(out, source->bytes, count);
    source->bytes += count;
    source->left -= count;
}

static void set_form(png_structp png)
{
    png_set_expand_16(png); /* palettes and few bits too */
    png_set_strip_alpha(png);
    png_set_gray_to_rgb(png);
    png_set_swap(png); /* PNG is big-endian */
    png_set_interlace_handling(png);
}

/* In its own frame: what it changes before a longjmp is not looked at afterwards. */
static bool read_pixels(png_structp png, png_infop info, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_user_limits(png, LIMIT_ASSET_SIDE, LIMIT_ASSET_SIDE);
    png_set_chunk_malloc_max(png, CHUNK_BYTES);
    png_read_info(png, info);
    set_form(png);
    png_read_update_info(png, info);
    png_read_image(png, rows);
    png_read_end(png, NULL);
    return true;
}

static double linear(double s)
{
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

/* The 16-bit values stand in the last half of the floats, so that they are read before they are
 * written over. */
static void to_linear(float *rgb, const uint8_t *values, size_t count)
{
    float *table = memory_alloc(65536, sizeof *table);

    for (int i = 0; i < 65536; i++) {
        table[i] = (float)linear(i / 65535.0);
    }
    for (size_t i = 0; i < count; i++) {
        uint16_t value;
        memcpy(&value, values + 2 * i, 2);
        rgb[i] = table[value];
    }
    free(table);
}

bool png_decode(const uint8_t *bytes, size_t length, const struct decoded *out, struct error *err)
{
    struct source source = {bytes, length, err};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    png_infop info = png_create_info_struct(png);
    const size_t row = (size_t)3 * (size_t)out->width, count = row * (size_t)out->height;
    uint8_t *values = (uint8_t *)out->rgb + 2 * count;
    png_bytepp rows = memory_alloc((size_t)out->height, sizeof *rows);
    bool ok;

    for (int y = 0; y < out->height; y++) {
        rows[y] = values + 2 * row * (size_t)y;
    }
    png_set_read_fn(png, &source, on_read);
    ok = read_pixels(png, info, rows);
    png_destroy_read_struct(&png, &info, NULL);
    free(rows);
    if (ok) {
        to_linear(out->rgb, values, count);
    }
    return ok;
}
