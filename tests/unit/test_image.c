/* SPDX-License-Identifier: MIT */
/* Encoders: what comes out reads back as what went in. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <turbojpeg.h>

#include "protocol/memory.h"
#include "renderer/image/decode.h"
#include "renderer/image/half.h"
#include "renderer/renderer.h"
#include "tests/support/picture.h"

enum { WIDTH = 37, HEIGHT = 21 };

static struct image make_image(enum pixel_format format, int channels, size_t pixel_bytes)
{
    struct image image = {.width = WIDTH, .height = HEIGHT, .channels = channels, .format = format};

    image.bytes = (size_t)WIDTH * HEIGHT * pixel_bytes;
    image.pixels = memory_alloc(image.bytes, 1);
    return image;
}

/* A smooth picture; with 255 it has no alpha channel. */
static struct image make_colors(uint8_t alpha)
{
    struct image image = make_image(PIXEL_RGBA8, alpha == 255 ? 3 : 4, 4);
    uint8_t *p = image.pixels;

    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++, p += 4) {
            p[0] = (uint8_t)(x * 6);
            p[1] = (uint8_t)(y * 11);
            p[2] = (uint8_t)(x + y);
            p[3] = alpha;
        }
    }
    return image;
}

static uint8_t *encode(const struct image *image, const struct encode_params *params,
                       size_t *out_length)
{
    struct error err = {0};
    uint8_t *bytes = NULL;

    if (!image_encode(image, params, &bytes, out_length, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return bytes;
}

static void check_png(uint8_t alpha, bool fast, int color_type)
{
    struct image image = make_colors(alpha);
    struct picture picture;
    size_t length;
    uint8_t *bytes =
        encode(&image, &(struct encode_params){.format = CODEC_PNG, .fast = fast}, &length);

    assert_int_equal(bytes[25], color_type); /* in IHDR */
    assert_true(picture_read_memory(&picture, bytes, length));
    assert_int_equal(picture.width, WIDTH);
    assert_int_equal(picture.height, HEIGHT);
    assert_memory_equal(picture.pixels, image.pixels, image.bytes);
    picture_finish(&picture);
    free(bytes);
    image_finish(&image);
}

static void png_is_read_back(void **state)
{
    (void)state;
    check_png(255, false, 2);
    check_png(255, true, 2);
    check_png(77, false, 6);
}

static void png_gray(void **state)
{
    struct image image = make_image(PIXEL_GRAY16, 1, 2);
    uint16_t *from = image.pixels;
    struct picture picture;
    size_t length;
    uint8_t *bytes;

    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        from[i] = (uint16_t)(i * 83);
    }
    bytes = encode(&image, &(struct encode_params){.format = CODEC_PNG}, &length);
    assert_int_equal(bytes[24], 16);
    assert_int_equal(bytes[25], 0);
    assert_true(picture_read_memory(&picture, bytes, length));
    free(bytes);
    picture_finish(&picture);
    image_finish(&image);
}

static void jpeg_is_read_back(void **state)
{
    struct image image = make_colors(255);
    uint8_t *pixels = memory_alloc(image.bytes, 1);
    tjhandle jpeg = tjInitDecompress();
    size_t length, small_length;
    uint8_t *bytes, *small;
    int width, height, sampling, space;

    (void)state;
    bytes = encode(&image, &(struct encode_params){.format = CODEC_JPEG, .quality = 95}, &length);
    small = encode(
        &image, &(struct encode_params){.format = CODEC_JPEG, .quality = 40, .chroma_halved = true},
        &small_length);
    assert_true(small_length < length);
    assert_int_equal(tjDecompressHeader3(jpeg, bytes, length, &width, &height, &sampling, &space),
                     0);
    assert_int_equal(width, WIDTH);
    assert_int_equal(height, HEIGHT);
    assert_int_equal(sampling, TJSAMP_444);
    assert_int_equal(tjDecompress2(jpeg, bytes, length, pixels, WIDTH, 0, HEIGHT, TJPF_RGBA, 0), 0);
    for (size_t i = 0; i < image.bytes; i++) {
        assert_true(abs(pixels[i] - ((uint8_t *)image.pixels)[i]) < 12);
    }
    tjDestroy(jpeg);
    free(bytes);
    free(small);
    free(pixels);
    image_finish(&image);
}

static void check_npy(enum pixel_format format, int channels, const char *header)
{
    struct image image = make_image(format, channels, (size_t)channels * 4);
    size_t length, head;
    uint8_t *bytes;

    memset(image.pixels, 0x3c, image.bytes);
    bytes = encode(&image, &(struct encode_params){.format = CODEC_NPY}, &length);
    assert_memory_equal(bytes, "\x93NUMPY\x01\x00", 8);
    head = 10 + bytes[8] + 256u * bytes[9];
    assert_int_equal(head % 64, 0);
    assert_int_equal(bytes[head - 1], '\n');
    assert_memory_equal(bytes + 10, header, strlen(header));
    assert_int_equal(length, head + image.bytes);
    assert_memory_equal(bytes + head, image.pixels, image.bytes);
    free(bytes);
    image_finish(&image);
}

static void npy_is_read_back(void **state)
{
    (void)state;
    check_npy(PIXEL_FLOAT, 4, "{'descr': '<f4', 'fortran_order': False, 'shape': (21, 37, 4), }");
    check_npy(PIXEL_FLOAT, 1, "{'descr': '<f4', 'fortran_order': False, 'shape': (21, 37), }");
    check_npy(PIXEL_UINT32, 1, "{'descr': '<u4', 'fortran_order': False, 'shape': (21, 37), }");
}

/* --- Radiance --- */

/* Light of all strengths; some of it in runs; and what is none. */
static struct image make_light(void)
{
    struct image image = make_image(PIXEL_FLOAT, 4, 16);
    float *p = image.pixels;
    uint32_t seed = 3;

    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        seed = seed * 1664525 + 1013904223;
        p[i] = i % 200 < 60 ? 0.7f : ldexpf((float)(seed >> 8), (int)(seed >> 3) % 17 - 30);
    }
    p[0] = NAN;
    p[1] = -3;
    p[2] = 1;
    memcpy(p + 4, (float[]){0, 0, 0}, 12);
    memcpy(p + 8, (float[]){255.7f / 256, 0.001f, 0}, 12);
    return image;
}

static void check_hdr(const struct image *image)
{
    const float *from = image->pixels;
    struct decoded decoded;
    size_t length;
    uint8_t *bytes = encode(image, &(struct encode_params){.format = CODEC_HDR}, &length);

    assert_true(image_decode(bytes, length, NULL, &decoded, NULL));
    assert_int_equal(decoded.width, image->width);
    assert_int_equal(decoded.height, image->height);
    for (int i = 0; i < image->width * image->height; i++) {
        const float most = fmaxf(fmaxf(from[4 * i], from[4 * i + 1]), from[4 * i + 2]);
        for (int k = 0; k < 3; k++) {
            const double want = from[4 * i + k] > 0 ? from[4 * i + k] : 0;
            const double got = half_value(decoded.rgba[4 * i + k]);
            assert_true(fabs(got - want) <= most / 250 + 1e-7);
        }
    }
    decoded_finish(&decoded);
    free(bytes);
}

static void hdr_is_read_back(void **state)
{
    struct image image = make_light();

    (void)state;
    check_hdr(&image);
    image.width = 5; /* no runs */
    check_hdr(&image);
    image_finish(&image);
}

/* The outputs of a picture, in the file that picture_file makes of them by so many rows at once. */
static uint8_t *write_file(const struct image images[AOV_COUNT], const struct encode_params *params,
                           int rows, size_t *out_length, struct error *err)
{
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, out_length);
    struct image shapes[AOV_COUNT];
    struct picture_file *file;
    bool ok;

    memcpy(shapes, images, sizeof shapes);
    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i].pixels = NULL;
    }
    file = picture_file_create(shapes, params, out, err);
    ok = file;
    for (int y = 0; ok && y < HEIGHT; y += rows) {
        for (int i = 0; ok && i < AOV_COUNT; i++) {
            struct image part = images[i];
            const size_t stride = part.bytes / HEIGHT;

            part.height = rows < HEIGHT - y ? rows : HEIGHT - y;
            part.pixels = (uint8_t *)part.pixels + (size_t)y * stride;
            part.bytes = stride * (size_t)part.height;
            ok = part.width == 0 || picture_file_add(file, (enum aov)i, &part, err);
        }
    }
    ok = ok && picture_file_end(file, err);
    picture_file_destroy(file);
    fclose(out);
    if (!ok) {
        free(bytes);
        return NULL;
    }
    return (uint8_t *)bytes;
}

static void check_rows(const struct image *image, struct encode_params params)
{
    struct image images[AOV_COUNT] = {[AOV_COLOR] = *image};
    size_t length, whole_length;
    uint8_t *whole = encode(image, &params, &whole_length);

    for (int rows = 1; rows < HEIGHT; rows += 4) {
        uint8_t *bytes = write_file(images, &params, rows, &length, NULL);

        assert_non_null(bytes);
        assert_int_equal(length, whole_length);
        assert_memory_equal(bytes, whole, length);
        free(bytes);
    }
    free(whole);
}

/* Where a picture is cut does not show in its file. */
static void cuts_between_rows_do_not_show(void **state)
{
    struct image colors = make_colors(255), clear = make_colors(9);
    struct image floats = make_image(PIXEL_FLOAT, 3, 12), light = make_light();

    (void)state;
    memset(floats.pixels, 0x41, floats.bytes);
    check_rows(&colors, (struct encode_params){.format = CODEC_PNG});
    check_rows(&clear, (struct encode_params){.format = CODEC_PNG, .fast = true});
    check_rows(&colors, (struct encode_params){.format = CODEC_JPEG, .chroma_halved = true});
    check_rows(&floats, (struct encode_params){.format = CODEC_NPY});
    check_rows(&light, (struct encode_params){.format = CODEC_HDR});
    image_finish(&colors);
    image_finish(&clear);
    image_finish(&floats);
    image_finish(&light);
}

/* The member's bytes stand in the ZIP as they are, behind its name. */
static void check_member(const uint8_t *zip, size_t length, const char *name, const uint8_t *bytes,
                         size_t count)
{
    const uint8_t *at = memmem(zip, length, name, strlen(name));

    assert_non_null(at);
    assert_non_null(memmem(at, length - (size_t)(at - zip), bytes, count));
}

static void zip_holds_all_images(void **state)
{
    struct image images[AOV_COUNT] = {
        [AOV_COLOR] = make_colors(255), [AOV_NORMAL] = make_colors(255)};
    const struct encode_params params = {.format = CODEC_PNG};
    size_t length, again_length, part_length;
    uint8_t *zip, *again, *part;

    (void)state;
    memset(images[AOV_NORMAL].pixels, 7, images[AOV_NORMAL].bytes);
    zip = write_file(images, &params, 5, &length, NULL);
    again = write_file(images, &params, 8, &again_length, NULL);
    assert_memory_equal(zip, "PK\3\4", 4);
    assert_int_equal(length, again_length);
    assert_memory_equal(zip, again, length);
    for (int i = 0; i < AOV_COUNT; i++) {
        if (images[i].width > 0) {
            part = encode(&images[i], &params, &part_length);
            check_member(zip, length, i == AOV_COLOR ? "color.png" : "normal.png", part,
                         part_length);
            free(part);
            image_finish(&images[i]);
        }
    }
    free(zip);
    free(again);
}

static void length_limit(void **state)
{
    struct image images[AOV_COUNT] = {[AOV_COLOR] = make_image(PIXEL_FLOAT, 4, 16)};
    struct image colors[AOV_COUNT] = {[AOV_COLOR] = make_colors(255)};
    struct encode_params params = {.format = CODEC_NPY, .limit_bytes = WIDTH * HEIGHT * 16};
    struct error err = {0};
    size_t length;
    uint8_t *bytes;

    (void)state;
    params.limit_bytes--;
    assert_null(write_file(images, &params, HEIGHT, &length, &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.message, "12432 bytes of values are above the maximum 12431");
    params = (struct encode_params){.format = CODEC_PNG};
    bytes = write_file(colors, &params, 4, &length, &err);
    free(bytes);
    params.limit_bytes = length;
    bytes = write_file(colors, &params, 4, &length, &err);
    assert_non_null(bytes);
    free(bytes);
    params.limit_bytes = length - 1;
    assert_null(write_file(colors, &params, 4, &length, &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    image_finish(&images[AOV_COLOR]);
    image_finish(&colors[AOV_COLOR]);
}

static void impossible_formats_are_refused(void **state)
{
    struct image floats = make_image(PIXEL_FLOAT, 4, 16);
    struct image colors = make_colors(255), clear = make_colors(9);
    struct error err = {0};
    uint8_t *bytes;
    size_t length;

    (void)state;
    assert_false(
        image_encode(&floats, &(struct encode_params){.format = CODEC_PNG}, &bytes, &length, &err));
    assert_int_equal(err.kind, ERROR_INVALID);
    assert_false(
        image_encode(&colors, &(struct encode_params){.format = CODEC_HDR}, &bytes, &length, &err));
    assert_string_equal(err.place, "format");
    assert_false(image_encode(&floats, &(struct encode_params){.format = CODEC_JPEG}, &bytes,
                              &length, &err));
    assert_false(image_encode(&colors,
                              &(struct encode_params){.format = CODEC_JPEG, .quality = 101}, &bytes,
                              &length, &err));
    assert_string_equal(err.place, "quality");
    assert_false(
        image_encode(&clear, &(struct encode_params){.format = CODEC_JPEG}, &bytes, &length, &err));
    assert_string_equal(err.place, "format");
    image_finish(&clear);
    image_finish(&floats);
    image_finish(&colors);
}

static void names_of_formats_are_found(void **state)
{
    (void)state;
    assert_int_equal(codec_find("png"), CODEC_PNG);
    assert_int_equal(codec_find("jpg"), CODEC_JPEG);
    assert_int_equal(codec_find("jpeg"), CODEC_JPEG);
    assert_int_equal(codec_find("npy"), CODEC_NPY);
    assert_int_equal(codec_find("hdr"), CODEC_HDR);
    assert_int_equal(codec_find("gif"), 0);
    assert_int_equal(codec_find("zip"), 0); /* nobody asks for it */
    for (size_t i = 0; codec_choice(i); i++) {
        const enum codec codec = codec_find(codec_choice(i));
        struct image image =
            codec_is_raw(codec) ? make_image(PIXEL_FLOAT, 4, 16) : make_colors(255);
        size_t length;
        uint8_t *bytes = encode(&image, &(struct encode_params){.format = codec}, &length);
        assert_non_null(strstr(CODEC_CHOICES, codec_choice(i)));
        assert_true(length > 0);
        free(bytes);
        image_finish(&image);
    }
    assert_string_equal(codec_mime(CODEC_JPEG), "image/jpeg");
    for (int i = 0; i < AOV_COUNT; i++) {
        assert_int_equal(aov_find(aov_name((enum aov)i)), i);
    }
    assert_int_equal(aov_find("none"), -1);
}

static void check_outputs(const char *text, const char *again)
{
    bool outputs[AOV_COUNT];
    char printed[AOVS_TEXT_BYTES];

    assert_true(aovs_read(text, outputs, "aov", NULL));
    aovs_print(outputs, printed);
    assert_string_equal(printed, again);
}

static void check_no_outputs(const char *text, const char *message)
{
    bool outputs[AOV_COUNT];
    struct error err = {0};

    assert_false(aovs_read(text, outputs, "aov", &err));
    assert_string_equal(err.message, message);
}

static void outputs_are_read_from_text(void **state)
{
    static const char all[] =
        "color,depth,normal,position,id,steps,albedo,specular,optical,shadow,occlusion";

    (void)state;
    check_outputs("color", "color");
    check_outputs("normal,id,depth", "depth,normal,id");
    check_outputs(all, all);
    check_no_outputs("depth,depth", "depth is named twice");
    check_no_outputs("", "\"\" is none of "
                         "color,depth,normal,position,id,steps,albedo,specular,optical,shadow,"
                         "occlusion");
    check_no_outputs("color,dep", "\"dep\" is none of "
                                  "color,depth,normal,position,id,steps,albedo,specular,optical,"
                                  "shadow,occlusion");
    for (int i = 0; aov_picture_names[i]; i++) {
        assert_true(aov_row((enum aov)aov_find(aov_picture_names[i]))->picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_is_read_back),
        cmocka_unit_test(png_gray),
        cmocka_unit_test(jpeg_is_read_back),
        cmocka_unit_test(npy_is_read_back),
        cmocka_unit_test(hdr_is_read_back),
        cmocka_unit_test(cuts_between_rows_do_not_show),
        cmocka_unit_test(zip_holds_all_images),
        cmocka_unit_test(length_limit),
        cmocka_unit_test(impossible_formats_are_refused),
        cmocka_unit_test(names_of_formats_are_found),
        cmocka_unit_test(outputs_are_read_from_text),
    };

    return cmocka_run_group_tests_name("image", tests, NULL, NULL);
}
