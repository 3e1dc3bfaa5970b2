/* SPDX-License-Identifier: MIT */
/* Depths of blocks, read back: they lie behind the bytes of the picture, in any bands of rows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <zlib.h>

#include "protocol/memory.h"
#include "renderer/worker/depths.h"

enum { WIDTH = 301, HEIGHT = 203, SIDE = 2, ACROSS = (WIDTH + 1) / 2, DOWN = (HEIGHT + 1) / 2 };

struct told {
    size_t start; /* of the depths */
    float nearest;
    int side;
    uint8_t depths[ACROSS * DOWN];
};

static uint32_t number_at(const uint8_t *at, int bytes)
{
    uint32_t number = 0;

    for (int i = 0; i < bytes; i++) {
        number |= (uint32_t)at[i] << 8 * i;
    }
    return number;
}

static void read_back(const uint8_t *bytes, size_t length, struct told *out)
{
    const uint8_t *end = bytes + length - 10;
    const uint32_t packed = number_at(end + 6, 4), bits = number_at(end, 4);
    uLongf count = sizeof out->depths;

    memcpy(&out->nearest, &bits, sizeof bits);
    out->side = (int)number_at(end + 4, 2);
    out->start = (size_t)(end - bytes) - packed;
    assert_int_equal(uncompress(out->depths, &count, end - packed, packed), Z_OK);
    assert_int_equal(count, sizeof out->depths);
    for (int i = 0; i < ACROSS * DOWN; i++) {
        const int left = i % ACROSS > 0 ? out->depths[i - 1] : 0;
        const int above = i >= ACROSS ? out->depths[i - ACROSS] : 0;
        const int corner = i % ACROSS > 0 && i >= ACROSS ? out->depths[i - ACROSS - 1] : 0;
        out->depths[i] = (uint8_t)(out->depths[i] + left + above - corner);
    }
}

static void add(struct stream_encoder *stream, enum aov aov, void *pixels, int height)
{
    const struct image rows = {WIDTH,
                               height,
                               aov == AOV_COLOR ? 3 : 1,
                               aov == AOV_COLOR ? PIXEL_RGBA8 : PIXEL_FLOAT,
                               pixels,
                               4 * (size_t)WIDTH * (size_t)height};
    struct error err = {0};

    assert_true(stream_encoder_add(stream, aov, &rows, &err));
}

/* In bands of so many rows. Caller frees. */
static uint8_t *encode_in(struct stream_encoder *stream, float *distances, int band,
                          size_t *out_length)
{
    const struct image shapes[AOV_COUNT] = {
        [AOV_COLOR] = {.width = WIDTH, .height = HEIGHT, .channels = 3, .format = PIXEL_RGBA8},
        [AOV_DEPTH] = {.width = WIDTH, .height = HEIGHT, .channels = 1, .format = PIXEL_FLOAT}};
    const struct encode_params params = {.format = CODEC_JPEG, .quality = 60};
    uint8_t *colors = memory_alloc(WIDTH * HEIGHT, 4);
    struct stream_packet packet;
    struct error err = {0};
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, out_length);

    assert_true(stream_encoder_begin(stream, shapes, &params, out, &err));
    for (int y = 0; y < HEIGHT; y += band) {
        const int height = HEIGHT - y < band ? HEIGHT - y : band;
        add(stream, AOV_COLOR, colors + (ptrdiff_t)4 * WIDTH * y, height);
        add(stream, AOV_DEPTH, distances + (ptrdiff_t)WIDTH * y, height);
    }
    assert_true(stream_encoder_end(stream, &packet, &err));
    assert_int_equal(packet.codec, CODEC_JPEG);
    fclose(out);
    free(colors);
    return (uint8_t *)bytes;
}

static uint8_t *encode(float *distances, int band, size_t *out_length)
{
    struct stream_encoder *stream = stream_encoder_open(&depths_stream, NULL);
    uint8_t *bytes = encode_in(stream, distances, band, out_length);

    stream_encoder_close(stream);
    return bytes;
}

/* By their places: nothing in the first rows, then further away to the right. */
static float *make_distances(void)
{
    float *distances = memory_alloc(WIDTH * HEIGHT, sizeof *distances);

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        distances[i] = i < 20 * WIDTH ? INFINITY : 2 + 0.125F * (float)(i % WIDTH);
    }
    return distances;
}

static void blocks_have_the_nearest_of_their_pixels(void **state)
{
    float *distances = make_distances();
    struct told told, bands;
    size_t length;

    (void)state;
    distances[WIDTH * 100 + 201] = -4; /* from inside of something */
    uint8_t *bytes = encode(distances, HEIGHT, &length);
    read_back(bytes, length, &told);
    assert_int_equal(told.side, SIDE);
    assert_float_equal(told.nearest, 2, 0);
    assert_int_equal(bytes[told.start - 2], 0xff);
    assert_int_equal(bytes[told.start - 1], 0xd9);
    for (int i = 0; i < ACROSS * DOWN; i++) {
        const bool thin = i == 50 * ACROSS + 100;
        const double distance = thin ? 4 : 2 + 0.125 * (i % ACROSS) * SIDE;
        const double part = i < 10 * ACROSS ? 0 : 255 * 2 / distance;
        assert_true(fabs(told.depths[i] - part) <= 0.51);
    }
    free(bytes);
    bytes = encode(distances, 7, &length);
    read_back(bytes, length, &bands);
    assert_memory_equal(told.depths, bands.depths, sizeof told.depths);
    free(bytes);
    free(distances);
}

/* What is much nearer than all else takes no steps of it. */
static void a_blade_before_the_eye_is_as_near_as_its_limit(void **state)
{
    float *distances = make_distances();
    struct told told;
    size_t length;

    (void)state;
    distances[WIDTH * 150] = 1e-6F;
    uint8_t *bytes = encode(distances, HEIGHT, &length);
    read_back(bytes, length, &told);
    assert_true(told.nearest < 2);
    assert_int_equal(told.depths[ACROSS * 75], 255);
    assert_true(told.nearest > 1e-4F);
    free(bytes);
    free(distances);
}

/* The same picture once more: nothing has changed, and the depths are there. */
static void depths_stand_behind_differences_too(void **state)
{
    float *distances = make_distances();
    struct told whole, told;
    size_t length;

    (void)state;
    uint8_t *bytes = encode(distances, HEIGHT, &length);
    read_back(bytes, length, &whole);
    free(bytes);
    struct stream_encoder *stream = stream_encoder_open(&depths_delta_stream, NULL);
    for (int i = 0; i < 3; i++) {
        bytes = encode_in(stream, distances, HEIGHT, &length);
        read_back(bytes, length, &told);
        assert_memory_equal(told.depths, whole.depths, sizeof told.depths);
        assert_int_equal(told.start, i == 1 ? 2 : whole.start);
        free(bytes);
        if (i == 1) {
            stream_encoder_ask_key(stream);
        }
    }
    stream_encoder_close(stream);
    free(distances);
}

static void nothing_hit_is_all_zero(void **state)
{
    float *distances = memory_alloc(WIDTH * HEIGHT, sizeof *distances);
    struct told told;
    size_t length;

    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        distances[i] = INFINITY;
    }
    uint8_t *bytes = encode(distances, HEIGHT, &length);
    read_back(bytes, length, &told);
    assert_float_equal(told.nearest, 0, 0);
    for (int i = 0; i < ACROSS * DOWN; i++) {
        assert_int_equal(told.depths[i], 0);
    }
    free(bytes);
    free(distances);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_the_nearest_of_their_pixels),
        cmocka_unit_test(a_blade_before_the_eye_is_as_near_as_its_limit),
        cmocka_unit_test(depths_stand_behind_differences_too),
        cmocka_unit_test(nothing_hit_is_all_zero),
    };

    return cmocka_run_group_tests_name("depths", tests, NULL, NULL);
}
