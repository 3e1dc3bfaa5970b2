/* SPDX-License-Identifier: MIT */
/* A guide, read back: ids and pixels are those that went in, in any bands, twice in a row. */
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
#include "renderer/guide.h"
#include "tests/support/json_text.h"

enum { WIDTH = 24, HEIGHT = 10, PIXELS = WIDTH * HEIGHT, NAMES = 8 };

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
    uint8_t pixels[2 * PIXELS];
};

static void read_back(const uint8_t *bytes, size_t length, struct told *out)
{
    const uint8_t *at = bytes + 2;
    uLongf pixels = sizeof out->pixels;

    out->count = bytes[0] + 256 * bytes[1];
    assert_true(out->count <= NAMES);
    for (int i = 0; i < out->count; i++) {
        memcpy(out->names[i], at + 1, *at);
        out->names[i][*at] = '\0';
        at += 1 + *at;
    }
    assert_int_equal(uncompress(out->pixels, &pixels, at, (uLong)(bytes + length - at)), Z_OK);
    assert_int_equal(pixels, sizeof out->pixels);
}

static const char *name_of(const struct told *told, int pixel)
{
    const int index = told->pixels[2 * pixel] + 256 * told->pixels[2 * pixel + 1];

    assert_true(index <= told->count);
    return index > 0 ? told->names[index - 1] : "";
}

/* In bands of `band` rows. */
static void encode(struct stream_encoder *stream, const uint32_t *numbers, int band,
                   struct told *out)
{
    const struct image whole = {WIDTH, HEIGHT, 1, PIXEL_UINT32, NULL, 4 * (size_t)PIXELS};
    const struct image shapes[AOV_COUNT] = {[AOV_ID] = whole};
    struct stream_packet packet;
    struct error err = {0};
    char *bytes = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&bytes, &length);

    assert_true(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, file, &err));
    for (int row = 0; row < HEIGHT; row += band) {
        const int height = row + band < HEIGHT ? band : HEIGHT - row;
        uint32_t part[PIXELS];

        memcpy(part, numbers + (ptrdiff_t)row * WIDTH, 4 * (size_t)height * WIDTH);
        const struct image rows = {WIDTH,        height, 1,
                                   PIXEL_UINT32, part,   4 * (size_t)height * WIDTH};
        assert_true(stream_encoder_add(stream, AOV_ID, &rows, &err));
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

static void test_round_trip(void **state)
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
        encode(stream, numbers, 1 + round, &told);
        assert_int_equal(told.count, round == 5 ? 0 : 3);
        for (int i = 0; i < PIXELS; i++) {
            assert_string_equal(name_of(&told, i), expected[i]);
        }
    }
    stream_encoder_close(stream);
}

/* Of what is no leaf, such as the floor. */
static void test_unknown_numbers(void **state)
{
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    uint32_t numbers[PIXELS];
    struct told told;

    (void)state;
    for (int i = 0; i < PIXELS; i++) {
        numbers[i] = i % 2 ? 4096 : number_of(field, "box");
    }
    encode(stream, numbers, HEIGHT, &told);
    assert_int_equal(told.count, 1);
    for (int i = 0; i < PIXELS; i++) {
        assert_string_equal(name_of(&told, i), i % 2 ? "" : "box");
    }
    stream_encoder_close(stream);
    field_unref(field);
}

static void test_needs_ids(void **state)
{
    const struct image shapes[AOV_COUNT] = {[AOV_DEPTH] = {WIDTH, HEIGHT, 1, PIXEL_FLOAT, NULL, 0}};
    struct field *field = make_field();
    struct stream_encoder *stream = stream_encoder_open(&guide_stream, field);
    struct error err = {0};

    (void)state;
    assert_false(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, stdout, &err));
    assert_int_equal(err.kind, ERROR_INTERNAL);
    stream_encoder_close(stream);
    field_unref(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_unknown_numbers),
        cmocka_unit_test(test_needs_ids),
    };
    return cmocka_run_group_tests_name("guide", tests, NULL, NULL);
}
