/* SPDX-License-Identifier: MIT */
/* PNG by libpng: whatever it holds becomes 8 or 16 bits of red, green and blue, taken as sRGB. */
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"
#include "shrink.h"

enum { CHUNK_BYTES = 8 << 20 }; /* of text and profiles */

struct source {
    const uint8_t *bytes;
    size_t left;
    struct error *err;
};

/* What a row goes through. */
struct rows {
    struct shrink *out;
    uint8_t *values; /* as libpng leaves them */
    float *rgb;
    float *table; /* linear light of 16 bits */
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

/* Three values for each pixel. Interlaced ones come as the pictures that they are stored as. */
static void set_form(png_structp png)
{
    png_set_expand(png); /* palettes and few bits too */
    png_set_strip_alpha(png);
    png_set_gray_to_rgb(png);
    png_set_swap(png); /* PNG is big-endian */
}

static void to_linear(const struct rows *rows, bool wide, int count)
{
    for (int i = 0; i < 3 * count; i++) {
        uint16_t value = (uint16_t)(rows->values[i] * 257);

        if (wide) {
            memcpy(&value, rows->values + 2 * i, 2);
        }
        rows->rgb[i] = rows->table[value];
    }
}

static void read_plain(png_structp png, png_infop info, const struct rows *rows)
{
    const bool wide = png_get_bit_depth(png, info) == 16;
    const int width = rows->out->from_width;

    for (int y = 0; y < rows->out->from_height; y++) {
        png_read_row(png, rows->values, NULL);
        to_linear(rows, wide, width);
        shrink_add(rows->out, y, 0, 1, width, rows->rgb);
    }
}

static void read_interlaced(png_structp png, png_infop info, const struct rows *rows)
{
    const bool wide = png_get_bit_depth(png, info) == 16;
    const png_uint_32 width = (png_uint_32)rows->out->from_width;
    const png_uint_32 height = (png_uint_32)rows->out->from_height;

    shrink_in_any_order(rows->out);
    for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; pass++) {
        const int columns = (int)PNG_PASS_COLS(width, pass);
        const int lines = columns > 0 ? (int)PNG_PASS_ROWS(height, pass) : 0;

        for (int i = 0; i < lines; i++) {
            png_read_row(png, rows->values, NULL);
            to_linear(rows, wide, columns);
            shrink_add(rows->out, (int)PNG_ROW_FROM_PASS_ROW(i, pass), PNG_PASS_START_COL(pass),
                       1 << PNG_PASS_COL_SHIFT(pass), columns, rows->rgb);
        }
    }
}

static double linear(double s)
{
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

/* What pixels of 8 bits ask for is a part of it. */
static void fill_table(float *table, bool wide)
{
    for (int i = 0; i < 65536; i += wide ? 1 : 257) {
        table[i] = (float)linear(i / 65535.0);
    }
}

/* In its own frame: what it changes before a longjmp is not looked at afterwards. */
static bool read_pixels(png_structp png, png_infop info, const struct rows *rows)
{
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_user_limits(png, LIMIT_ASSET_SIDE, LIMIT_ASSET_SIDE);
    png_set_chunk_malloc_max(png, CHUNK_BYTES);
    png_read_info(png, info);
    set_form(png);
    png_read_update_info(png, info);
    fill_table(rows->table, png_get_bit_depth(png, info) == 16);
    if (png_get_interlace_type(png, info) == PNG_INTERLACE_NONE) {
        read_plain(png, info, rows);
    } else {
        read_interlaced(png, info, rows);
    }
    png_read_end(png, NULL);
    return true;
}

bool png_decode(const uint8_t *bytes, size_t length, struct shrink *out, struct error *err)
{
    struct source source = {bytes, length, err};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    png_infop info = png_create_info_struct(png);
    const size_t count = (size_t)3 * (size_t)out->from_width;
    const struct rows rows = {out, memory_alloc(count, 2), memory_alloc(count, sizeof(float)),
                              memory_alloc(65536, sizeof(float))};
    bool ok;

    png_set_read_fn(png, &source, on_read);
    ok = read_pixels(png, info, &rows);
    png_destroy_read_struct(&png, &info, NULL);
    free(rows.values);
    free(rows.rgb);
    free(rows.table);
    return ok;
}
