/* SPDX-License-Identifier: MIT */
/* A guide, read back: ids, pixels and depths are those that went in, in any bands, twice in a
 * row. */
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
#include "renderer/field/field.h"
#include "renderer/worker/guide.h"
#include "tests/support/json_text.h"

enum {
    WIDTH = 25,
    HEIGHT = 10,
    PIXELS = WIDTH * HEIGHT,
    NAMES = 8,
    STEP = 4,
    ACROSS = (WIDTH + STEP - 1) / STEP,
    DOWN = (HEIGHT + STEP - 1) / STEP,
    DEPTHS = ACROSS * DOWN,
};

static const char scene_text[] =
    "{'format':'fieldcast/1','root':{'id':'all','type':'union','children':["
    "{'id':'ball','type':'sphere'},{'id':'box','type':'box'},"
    "{'id':'pair','type':'group','children':[{'id':'ring','type':'torus'}]}]}}";

static struct field *make_field(void)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(scene_text, &err);
    struct field *field = field_compile(scene, &err);

    assert_non_null(field);
    scene_destroy(scene);
    return field;
}

struct told {
    char names[NAMES][65];
    int count;
    float nearest, farthest;
    uint8_t pixels[2 * PIXELS];
    uint8_t low[DEPTHS], high[DEPTHS];
    uint16_t depths[DEPTHS];
};

static void read_depths(struct told *out)
{
    for (int i = 0; i < DEPTHS; i++) {
        const int x = i % ACROSS, folded = out->low[i] + 256 * out->high[i];
        const int apart = folded % 2 ? -(folded + 1) / 2 : folded / 2;
        const int left = x > 0 ? out->depths[i - 1] : 0;
        const int above = i >= ACROSS ? out->depths[i - ACROSS] : 0;
        const int corner = x > 0 && i >= ACROSS ? out->depths[i - ACROSS - 1] : 0;

        out->depths[i] = (uint16_t)(left + above - corner + apart);
    }
}

static void read_back(const uint8_t *bytes, size_t length, struct told *out)
{
    const uint8_t *at = bytes + 2;
    uint8_t whole[2 * (PIXELS + DEPTHS)];
    uLongf told = sizeof whole;

    out->count = bytes[0] + 256 * bytes[1];
    assert_true(out->count <= NAMES);
    for (int i = 0; i < out->count; i++) {
        memcpy(out->names[i], at + 1, *at);
        out->names[i][*at] = '\0';
        at += 1 + *at;
    }
    memcpy(&out->nearest, at, 4);
    memcpy(&out->farthest, at + 4, 4);
    at += 8;
    assert_int_equal(uncompress(whole, &told, at, (uLong)(bytes + length - at)), Z_OK);
    assert_int_equal(told, sizeof whole);
    memcpy(out->pixels, whole, sizeof out->pixels);
    memcpy(out->low, whole + sizeof out->pixels, sizeof out->low);
    memcpy(out->high, whole + sizeof out->pixels + sizeof out->low, sizeof out->high);
    read_depths(out);
}

/* By the formula of protocol/README.md. */
static double distance_of(const struct told *told, int i)
{
    const double part = (told->depths[i] - 1) / 65534.0;

    return told->depths[i] > 0 ? told->farthest * pow((double)told->nearest / told->farthest, part)
                               : INFINITY;
}

static const char *name_of(const struct told *told, int pixel)
{
    const int index = told->pixels[2 * pixel] + 256 * told->pixels[2 * pixel + 1];

    assert_true(index <= told->count);
    return index > 0 ? told->names[index - 1] : "";
}

static void add_rows(struct stream_encoder *stream, enum aov aov, const void *pixels, int height)
{
    const size_t bytes = 4 * (size_t)height * WIDTH;
    char part[4 * PIXELS];
    struct error err = {0};
    const struct image rows = {WIDTH, height, 1, aov == AOV_ID ? PIXEL_UINT32 : PIXEL_FLOAT,
                               part,  bytes};

    memcpy(part, pixels, bytes);
    assert_true(stream_encoder_add(stream, aov, &rows, &err));
}

/* In bands of `band` rows. */
static void encode(struct stream_encoder *stream, const uint32_t *numbers, const float *distances,
                   int band, struct told *out)
{
    const size_t size = 4 * (size_t)PIXELS;
    const struct image shapes[AOV_COUNT] = {
        [AOV_ID] = {WIDTH, HEIGHT, 1, PIXEL_UINT32, NULL, size},
        [AOV_DEPTH] = {WIDTH, HEIGHT, 1, PIXEL_FLOAT, NULL, size}};
    struct stream_packet packet;
    struct error err = {0};
    char *bytes = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&bytes, &length);

    assert_true(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, file, &err));
    for (int row = 0; row < HEIGHT; row += band) {
        const int height = row + band < HEIGHT ? band : HEIGHT - row;

        add_rows(stream, AOV_ID, numbers + (ptrdiff_t)row * WIDTH, height);
        add_rows(stream, AOV_DEPTH, distances + (ptrdiff_t)row * WIDTH, height);
    }
    assert_true(stream_encoder_end(stream, &packet, &err));
    fclose(file);
    assert_int_equal(packet.codec, CODEC_GUIDE);
    assert_true(packet.key);
    read_back((uint8_t *)bytes, length, out);
    free(bytes);
}

static uint32_t number_of(const struct field *field, const char *id)
{
    uint32_t number = 0;
    const char *found = NULL;

    while (!found || strcmp(found, id) != 0) {
        assert_true(number < 100);
        found = field_leaf_id(field, ++number);
    }
    return number;
}

static const float nowhere[PIXELS] = {0};

static void round_trip(void **state)
{
    static const char *const ids[] = {"", "ring", "ball", "box", "box", ""};
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    struct told told;

    (void)state;
    field_unref(field);
    for (int round = 0; round < 6; round++) {
        const char *expected[PIXELS];
        uint32_t numbers[PIXELS];

        for (int i = 0; i < PIXELS; i++) {
            expected[i] = ids[(i / 3 + round) % (round == 5 ? 1 : 6)];
            numbers[i] = *expected[i] ? number_of(field, expected[i]) : 0;
        }
        encode(stream, numbers, nowhere, 1 + round, &told);
        assert_int_equal(told.count, round == 5 ? 0 : 3);
        for (int i = 0; i < PIXELS; i++) {
            assert_string_equal(name_of(&told, i), expected[i]);
        }
    }
    stream_encoder_close(stream);
}

/* Of what is no leaf, such as the floor. */
static void unknown_numbers(void **state)
{
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    uint32_t numbers[PIXELS];
    struct told told;

    (void)state;
    for (int i = 0; i < PIXELS; i++) {
        numbers[i] = i % 2 ? 4096 : number_of(field, "box");
    }
    encode(stream, numbers, nowhere, HEIGHT, &told);
    assert_int_equal(told.count, 1);
    for (int i = 0; i < PIXELS; i++) {
        assert_string_equal(name_of(&told, i), i % 2 ? "" : "box");
    }
    stream_encoder_close(stream);
    field_unref(field);
}

/* Everywhere within half a step, and a step is the same part of each distance. */
static void assert_distances(const struct told *told, const float *distances)
{
    const double step = log((double)told->farthest / told->nearest) / 65534;

    for (int i = 0; i < DEPTHS; i++) {
        const float wanted = distances[(i / ACROSS * WIDTH + i % ACROSS) * STEP];
        const double got = distance_of(told, i);

        assert_true(isinf(wanted) == isinf(got));
        assert_true(isinf(wanted) || fabs(log(got / wanted)) <= step / 2 + 1e-6);
    }
}

static void depths_come_back_within_a_step(void **state)
{
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    static const double spans[] = {1.5, 100, 1e5};
    const uint32_t numbers[PIXELS] = {0};
    float distances[PIXELS];
    struct told told;

    (void)state;
    for (int round = 0; round < 9; round++) {
        uint32_t seed = 17 + (uint32_t)round;

        for (int i = 0; i < PIXELS; i++) {
            seed = seed * 1664525 + 1013904223;
            distances[i] = seed >> 29 == 0
                               ? INFINITY
                               : (float)(0.2 * pow(spans[round % 3], (seed >> 8) / 16777216.0));
        }
        encode(stream, numbers, distances, 1 + round, &told);
        assert_true(told.nearest >= 0.2F && told.farthest <= 0.21 * spans[round % 3]);
        assert_distances(&told, distances);
    }
    stream_encoder_close(stream);
    field_unref(field);
}

/* Nothing, one distance alone, and an eye that is within something. */
static void odd_depths(void **state)
{
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    const uint32_t numbers[PIXELS] = {0};
    float distances[PIXELS];
    struct told told;

    (void)state;
    for (int i = 0; i < PIXELS; i++) {
        distances[i] = INFINITY;
    }
    encode(stream, numbers, distances, 3, &told);
    assert_true(told.nearest == 0 && told.farthest == 0);
    assert_int_equal(told.depths[5], 0);
    distances[STEP] = 7;
    encode(stream, numbers, distances, 3, &told);
    assert_true(told.nearest == 7 && told.farthest == 7);
    assert_true(distance_of(&told, 1) == 7 && isinf(distance_of(&told, 0)));
    distances[0] = 0;
    encode(stream, numbers, distances, 3, &told);
    assert_true(told.nearest > 0 && told.nearest < 1e-4 && told.farthest == 7);
    assert_int_equal(told.depths[0], 65535);
    assert_int_equal(told.depths[1], 1);
    stream_encoder_close(stream);
    field_unref(field);
}

static void needs_ids_and_distances(void **state)
{
    const struct image ids = {WIDTH, HEIGHT, 1, PIXEL_UINT32, NULL, 0};
    const struct image distances = {WIDTH, HEIGHT, 1, PIXEL_FLOAT, NULL, 0};
    const struct image shapes[2][AOV_COUNT] = {{[AOV_DEPTH] = distances}, {[AOV_ID] = ids}};
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);

    (void)state;
    for (int i = 0; i < 2; i++) {
        struct error err = {0};

        assert_false(
            stream_encoder_begin(stream, shapes[i], &(struct encode_params){0}, stdout, &err));
        assert_int_equal(err.kind, ERROR_INTERNAL);
    }
    stream_encoder_close(stream);
    field_unref(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),
        cmocka_unit_test(unknown_numbers),
        cmocka_unit_test(depths_come_back_within_a_step),
        cmocka_unit_test(odd_depths),
        cmocka_unit_test(needs_ids_and_distances),
    };

    return cmocka_run_group_tests_name("guide", tests, NULL, NULL);
}
