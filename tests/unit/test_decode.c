/* SPDX-License-Identifier: MIT */
/* PNG and Radiance files into linear light; files of strangers, cut and changed in every way, are
 * refused or read, and never more. */
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/image/decode.h"

static uint32_t seed = 7;

static uint32_t random_below(uint32_t limit)
{
    seed = seed * 1664525 + 1013904223;
    return (uint32_t)((uint64_t)seed * limit >> 32);
}

struct file {
    uint8_t bytes[1 << 16];
    size_t length;
};

static void put(struct file *file, const void *bytes, size_t length)
{
    assert_true(file->length + length <= sizeof file->bytes);
    memcpy(file->bytes + file->length, bytes, length);
    file->length += length;
}

static void put_text(struct file *file, const char *text)
{
    put(file, text, strlen(text));
}

static void put_byte(struct file *file, int byte)
{
    put(file, &(uint8_t){(uint8_t)byte}, 1);
}

/* The decoder gets exactly the bytes, so that a sanitizer sees it read beyond. */
static bool decode(const struct file *file, size_t length, struct decoded *out, struct error *err)
{
    uint8_t *bytes = malloc(length ? length : 1);
    bool ok;

    memcpy(bytes, file->bytes, length);
    *out = (struct decoded){0};
    ok = image_decode(bytes, length, NULL, out, err);
    free(bytes);
    return ok;
}

static void want_refused(const struct file *file, enum error_kind kind, const char *words)
{
    struct decoded decoded;
    struct error err = {0};

    assert_false(decode(file, file->length, &decoded, &err));
    if (err.kind != kind || !strstr(err.message, words)) {
        fail_msg("\"%s\" does not say \"%s\"", err.message, words);
    }
}

/* --- Radiance --- */

static struct file radiance(const char *size)
{
    struct file file = {0};

    put_text(&file, "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n");
    put_text(&file, size);
    return file;
}

/* IEEE 754 binary16, as its words have it. */
static double value_of(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;

    assert_true(half < 0x7c00); /* finite, 0 and above */
    return exponent ? ldexp(1024 + fraction, exponent - 25) : ldexp(fraction, -24);
}

/* The nearest half, of `value` or of what is as good as it: `doubt`. */
static void want_value(const struct decoded *decoded, int i, int c, double value, double doubt)
{
    const double got = value_of(decoded->rgba[4 * i + c]), want = fmin(value, 65504);

    assert_true(fabs(got - want) <= fmax(want * 0x1p-11, 0x1p-25) + doubt);
    assert_int_equal(decoded->rgba[4 * i + 3], 0x3c00);
}

static void want_pixel(const struct decoded *decoded, int x, int y, double r, double g, double b)
{
    const int i = y * decoded->width + x;

    want_value(decoded, i, 0, r, 1e-6);
    want_value(decoded, i, 1, g, 1e-6);
    want_value(decoded, i, 2, b, 1e-6);
}

static void flat_radiance_is_decoded(void **state)
{
    static const uint8_t pixels[] = {128, 64, 0, 129, 1, 1, 1, 2, 255, 0, 8, 120, 9, 9, 9, 0};
    struct file file = radiance("-Y 1 +X 5\n");
    struct decoded decoded;

    (void)state;
    put(&file, pixels, sizeof pixels);
    assert_true(decode(&file, file.length, &decoded, NULL));
    assert_int_equal(decoded.width, 5);
    assert_int_equal(decoded.height, 1);
    for (int x = 0; x < 3; x++) {
        want_pixel(&decoded, x, 0, 1, 0.5, 0);
    }
    want_pixel(&decoded, 3, 0, 255.0 / 65536, 0, 8.0 / 65536);
    want_pixel(&decoded, 4, 0, 0, 0, 0);
    decoded_finish(&decoded);
}

/* Runs longer than 255 are counted in two bytes. */
static void long_flat_run(void **state)
{
    static const uint8_t pixels[] = {128, 128, 128, 129, 1, 1, 1, 0x2b, 1, 1, 1, 1};
    struct file file = radiance("-Y 1 +X 300\n");
    struct decoded decoded;

    (void)state;
    put(&file, pixels, sizeof pixels);
    assert_true(decode(&file, file.length, &decoded, NULL));
    want_pixel(&decoded, 299, 0, 1, 1, 1);
    decoded_finish(&decoded);
}

/* Rows with runs of each component, made of random numbers with many repeated. */
static struct file runs(int width, int height, uint8_t *pixels)
{
    char size[40];

    snprintf(size, sizeof size, "-Y %d +X %d\n", height, width);
    struct file file = radiance(size);

    for (int y = 0; y < height; y++) {
        put(&file, (uint8_t[]){2, 2, (uint8_t)(width >> 8), (uint8_t)width}, 4);
        for (int c = 0; c < 4; c++) {
            for (int x = 0; x < width;) {
                const bool same = random_below(2);
                int n = 1 + (int)random_below(same ? 127 : 128);
                n = n < width - x ? n : width - x;
                put_byte(&file, same ? 128 + n : n);
                int value = (int)random_below(c == 3 ? 140 : 256);
                for (int i = 0; i < n; i++) {
                    value = same ? value : (int)random_below(c == 3 ? 140 : 256);
                    pixels[4 * (y * width + x + i) + c] = (uint8_t)value;
                    if (!same || i == 0) {
                        put_byte(&file, value);
                    }
                }
                x += n;
            }
        }
    }
    return file;
}

static void runs_of_radiance_are_decoded(void **state)
{
    enum { WIDTH = 500, HEIGHT = 8 };
    static uint8_t pixels[4 * WIDTH * HEIGHT];
    struct file file = runs(WIDTH, HEIGHT, pixels);
    struct decoded decoded;

    (void)state;
    assert_true(decode(&file, file.length, &decoded, NULL));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t *p = pixels + 4 * i;
        for (int c = 0; c < 3; c++) {
            const double want = p[3] ? p[c] * pow(2, p[3] - 136) : 0;
            want_value(&decoded, i, c, want, 1e-6 * want);
        }
    }
    decoded_finish(&decoded);
}

static void bad_radiance(void **state)
{
    static const struct {
        const char *head;
        enum error_kind kind;
        const char *words;
    } heads[] = {
        {"", ERROR_INVALID, "neither PNG nor Radiance"},
        {"#?RADIANCE", ERROR_INVALID, "has no end"},
        {"#?RADIANCE\n\n-Y 1 +X 1\n", ERROR_INVALID, "is not FORMAT=32-bit_rle_rgbe"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", ERROR_INVALID, "is not FORMAT"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+X 1 -Y 1\n", ERROR_INVALID, "-Y ROWS +X COLUMNS"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1x\n", ERROR_INVALID, "-Y ROWS"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 8\n", ERROR_INVALID, "8 x 0 pixels"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -4 +X 8\n", ERROR_INVALID, "8 x -4 pixels"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8193\n", ERROR_LIMIT, "above 8192 a side"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 8192\n", ERROR_LIMIT, "67108864 pixels"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999999999999999 +X 1\n", ERROR_LIMIT,
         "above 8192 a side"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 4\n", ERROR_INVALID, "row 1 of 4"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\2\2\1\1", ERROR_INVALID, "damaged"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 4\n\1\1\1\1....", ERROR_INVALID, "damaged"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++) {
        struct file file = {0};

        put_text(&file, heads[i].head);
        want_refused(&file, heads[i].kind, heads[i].words);
    }
}

/* --- PNG --- */

static void on_write(png_structp png, png_bytep bytes, size_t length)
{
    put(png_get_io_ptr(png), bytes, length);
}

static void on_flush(png_structp png)
{
    (void)png;
}

enum { SIDE = 16 };

/* Pixels of `channels` of `depth` bits with random bytes; `palette` of these where it is one. */
static struct file make_png(int type, int depth, bool interlaced, const uint8_t *bytes, size_t row)
{
    struct file file = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_color palette[16];

    assert_int_equal(setjmp(png_jmpbuf(png)), 0);
    png_set_write_fn(png, &file, on_write, on_flush);
    png_set_IHDR(png, info, SIDE, SIDE, depth, type,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (type == PNG_COLOR_TYPE_PALETTE) {
        for (int i = 0; i < 16; i++) {
            palette[i] = (png_color){(png_byte)(i * 17), (png_byte)(255 - i), (png_byte)(i * i)};
        }
        png_set_PLTE(png, info, palette, 16);
    }
    png_write_info(png, info);
    png_bytep rows[SIDE];
    for (int y = 0; y < SIDE; y++) {
        rows[y] = (png_bytep)bytes + row * (size_t)y;
    }
    png_write_image(png, rows);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return file;
}

/* Wider than a panorama, of random numbers. */
static uint8_t *large_png(bool interlaced, size_t *out_length)
{
    enum { WIDE = 5000, LOW = 6 };
    static uint8_t rows[LOW][3 * WIDE];
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, out_length);

    seed = 5;
    for (size_t i = 0; i < sizeof rows; i++) {
        rows[i / (3 * WIDE)][i % (3 * WIDE)] = (uint8_t)random_below(256);
    }
    assert_int_equal(setjmp(png_jmpbuf(png)), 0);
    png_init_io(png, out);
    png_set_IHDR(png, info, WIDE, LOW, 8, PNG_COLOR_TYPE_RGB,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    png_write_image(png, (png_bytep[LOW]){rows[0], rows[1], rows[2], rows[3], rows[4], rows[5]});
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(out), 0);
    return (uint8_t *)bytes;
}

static double linear(double s)
{
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

static void png_is_decoded(void **state)
{
    static const struct {
        int type, depth, channels;
    } kinds[] = {{PNG_COLOR_TYPE_RGB, 8, 3},        {PNG_COLOR_TYPE_RGB, 16, 3},
                 {PNG_COLOR_TYPE_RGB_ALPHA, 8, 4},  {PNG_COLOR_TYPE_GRAY, 8, 1},
                 {PNG_COLOR_TYPE_GRAY_ALPHA, 8, 2}, {PNG_COLOR_TYPE_RGB_ALPHA, 16, 4},
                 {PNG_COLOR_TYPE_GRAY, 16, 1}};

    (void)state;
    for (size_t i = 0; i < 2 * sizeof kinds / sizeof kinds[0]; i++) {
        const int channels = kinds[i / 2].channels, width = kinds[i / 2].depth / 8;
        const size_t pixel = (size_t)(channels * width);
        uint8_t bytes[8 * SIDE * SIDE];
        struct decoded decoded;

        for (size_t k = 0; k < sizeof bytes; k++) {
            bytes[k] = (uint8_t)random_below(256);
        }
        struct file file =
            make_png(kinds[i / 2].type, kinds[i / 2].depth, i % 2, bytes, pixel * SIDE);
        assert_true(decode(&file, file.length, &decoded, NULL));
        for (int k = 0; k < 3 * SIDE * SIDE; k++) {
            const int c = channels < 3 ? 0 : k % 3;
            const uint8_t *at = bytes + pixel * (size_t)(k / 3) + (size_t)(c * width);
            const double value = width == 1 ? at[0] / 255.0 : (at[0] * 256 + at[1]) / 65535.0;
            want_value(&decoded, k / 3, k % 3, linear(value), 1e-6);
        }
        decoded_finish(&decoded);
    }
}

static void png_palette(void **state)
{
    uint8_t bytes[SIDE * SIDE / 2];
    struct decoded decoded;

    (void)state;
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)random_below(256);
    }
    struct file file = make_png(PNG_COLOR_TYPE_PALETTE, 4, false, bytes, SIDE / 2);
    assert_true(decode(&file, file.length, &decoded, NULL));
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int index = bytes[i / 2] >> (i % 2 ? 0 : 4) & 15;
        want_value(&decoded, i, 0, linear(index * 17 / 255.0), 1e-6);
        want_value(&decoded, i, 2, linear(index * index / 255.0), 1e-6);
    }
    decoded_finish(&decoded);
}

static void bad_png(void **state)
{
    uint8_t bytes[3 * SIDE * SIDE] = {0};
    struct file file = make_png(PNG_COLOR_TYPE_RGB, 8, false, bytes, 3 * SIDE);
    struct file cut = file, changed = file, giant = file;

    (void)state;
    cut.length -= 20;
    want_refused(&cut, ERROR_INVALID, "damaged: it is cut off");
    changed.bytes[changed.length - 20] ^= 1;
    want_refused(&changed, ERROR_INVALID, "damaged: ");
    memcpy(giant.bytes + 16, "\177\377\377\377\177\377\377\377", 8);
    want_refused(&giant, ERROR_LIMIT, "2147483647 x 2147483647 pixels are above 8192 a side");
}

/* --- larger than a panorama --- */

/* A picture of `width` by `height`, flat: each pixel has the mantissas that `color` gives it. */
static uint8_t *large_radiance(int width, int height, size_t *out_length,
                               void (*color)(int x, int y, uint8_t rgb[3]))
{
    uint8_t *bytes = malloc(128 + (size_t)4 * (size_t)width * (size_t)height);
    size_t length = (size_t)sprintf(
        (char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", height, width);

    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            color(x, y, bytes + length);
            bytes[length + 3] = 129; /* 128 is 1 */
            length += 4;
        }
    }
    *out_length = length;
    return bytes;
}

static void stripes(int x, int y, uint8_t rgb[3])
{
    rgb[0] = 96;
    rgb[1] = x % 2 ? 128 : 64;
    rgb[2] = y % 2 ? 192 : 64;
}

/* Pixels are averaged two by two, three by three as their area says, and one way alone. */
static void pixels_are_averaged_by_area(void **state)
{
    static const struct {
        int width, height, out_width, out_height;
    } sizes[] = {
        {8192, 4, DECODED_WIDTH, 4}, {6144, 4, DECODED_WIDTH, 4}, {16, 4096, 16, DECODED_HEIGHT}};

    (void)state;
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        const bool thirds = sizes[k].width == 6144;
        size_t length;
        uint8_t *bytes = large_radiance(sizes[k].width, sizes[k].height, &length, stripes);
        struct decoded decoded;

        assert_true(image_decode(bytes, length, NULL, &decoded, NULL));
        assert_int_equal(decoded.width, sizes[k].out_width);
        assert_int_equal(decoded.height, sizes[k].out_height);
        for (int y = 0; y < decoded.height; y += 1 + decoded.height / 8) {
            for (int x = 0; x < decoded.width; x++) {
                const double column = sizes[k].width == 16 ? (x % 2 ? 1 : 0.5)
                                      : thirds             ? (x % 4 < 2 ? 2 : 2.5) / 3
                                                           : 0.75;
                const double row = sizes[k].height == 4 ? (y % 2 ? 1.5 : 0.5) : 1;
                want_pixel(&decoded, x, y, 0.75, column, row);
            }
        }
        decoded_finish(&decoded);
        free(bytes);
    }
}

/* What is stored as seven pictures is the same picture. */
static void interlaced_averaged(void **state)
{
    struct decoded decoded[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        size_t length;
        uint8_t *bytes = large_png(i == 1, &length);

        assert_true(image_decode(bytes, length, NULL, &decoded[i], NULL));
        free(bytes);
    }
    assert_int_equal(decoded[0].width, DECODED_WIDTH);
    for (int i = 0; i < 4 * decoded[0].width * decoded[0].height; i++) {
        assert_true(abs(decoded[0].rgba[i] - decoded[1].rgba[i]) <= 1);
    }
    decoded_finish(&decoded[0]);
    decoded_finish(&decoded[1]);
}

/* --- anything --- */

/* Cut anywhere: refused. Changed in a few bytes: refused, or read as numbers. */
static void mangle(const struct file *file)
{
    struct decoded decoded;
    struct error err;

    for (size_t length = 0; length < file->length; length += 1 + length / 64) {
        err = (struct error){0};
        assert_false(decode(file, length, &decoded, &err));
        assert_true(err.kind != ERROR_NONE && *err.message);
    }
    for (int round = 0; round < 3000; round++) {
        struct file changed = *file;
        for (uint32_t i = 0; i <= random_below(4); i++) {
            changed.bytes[random_below((uint32_t)file->length)] = (uint8_t)random_below(256);
        }
        if (decode(&changed, changed.length, &decoded, NULL)) {
            for (int i = 0; i < 4 * decoded.width * decoded.height; i++) {
                value_of(decoded.rgba[i]);
            }
            decoded_finish(&decoded);
        }
    }
}

static void mangled_files_are_survived(void **state)
{
    static uint8_t pixels[4 * 64 * 4], bytes[4 * SIDE * SIDE];
    struct file file = runs(64, 4, pixels);

    (void)state;
    mangle(&file);
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)random_below(256);
    }
    file = make_png(PNG_COLOR_TYPE_RGB_ALPHA, 8, true, bytes, 4 * SIDE);
    mangle(&file);
    file = make_png(PNG_COLOR_TYPE_PALETTE, 4, false, bytes, SIDE / 2);
    mangle(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_radiance_is_decoded),
        cmocka_unit_test(long_flat_run),
        cmocka_unit_test(runs_of_radiance_are_decoded),
        cmocka_unit_test(bad_radiance),
        cmocka_unit_test(png_is_decoded),
        cmocka_unit_test(png_palette),
        cmocka_unit_test(bad_png),
        cmocka_unit_test(pixels_are_averaged_by_area),
        cmocka_unit_test(interlaced_averaged),
        cmocka_unit_test(mangled_files_are_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
