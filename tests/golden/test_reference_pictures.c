/* SPDX-License-Identifier: MIT */
/* The pictures on the start page are those of the examples as they are now: each card is drawn
 * anew, smaller, and compared. JPEG and fewer samples cost some steps, so the bounds are wider than
 * those of golden pictures: 8 of 255 on average, which another exposure exceeds at once (test
 * below). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <turbojpeg.h>

#include "renderer/renderer.h"
#include "server/cli/local_render.h"
#include "server/embedded.h"
#include "tests/support/json_text.h"
#include "tests/support/progress.h"

#define CARD_MEAN 8.0

enum {
    BLOCK = 5, /* the scene is drawn so much smaller than its card */
    PLACE = 2, /* so many of its pixels in a square are compared as one, for mirrors in mirrors show
                  other things in each */
};

static struct renderer *renderer;

static uint8_t *unpack(const struct embedded *card, int *out_width, int *out_height)
{
    tjhandle jpeg = tjInitDecompress();
    int sampling = 0, space = 0;

    assert_int_equal(tjDecompressHeader3(jpeg, card->bytes, card->length, out_width, out_height,
                                         &sampling, &space),
                     0);
    uint8_t *pixels = malloc((size_t)*out_width * (size_t)*out_height * 4);
    assert_int_equal(tjDecompress2(jpeg, card->bytes, card->length, pixels, *out_width, 0,
                                   *out_height, TJPF_RGBA, 0),
                     0);
    tjDestroy(jpeg);
    return pixels;
}

/* Mean of a channel over the square with `side` pixels whose first is (x, y). */
static double mean_of(const uint8_t *pixels, int width, int x, int y, int side, int channel)
{
    double sum = 0;

    for (int i = 0; i < side * side; i++) {
        sum += pixels[4 * ((y + i / side) * width + x + i % side) + channel];
    }
    return sum / (side * side);
}

/* Mean difference of a channel between the places of a picture and of a larger one. */
static double places_difference(const struct image *small, const uint8_t *large)
{
    const int across = small->width / PLACE, down = small->height / PLACE;
    double sum = 0;

    for (int i = 0; i < across * down * 3; i++) {
        const int x = i / 3 % across * PLACE, y = i / 3 / across * PLACE;
        sum +=
            fabs(mean_of(small->pixels, small->width, x, y, PLACE, i % 3) -
                 mean_of(large, small->width * BLOCK, x * BLOCK, y * BLOCK, PLACE * BLOCK, i % 3));
    }
    return sum / (across * down * 3);
}

/* Mean difference of a channel between the card and the scene drawn now. */
static double difference(const struct embedded *example, const struct embedded *card,
                         double exposure)
{
    struct error err = {0};
    struct image image;
    int width, height;
    uint8_t *pixels = unpack(card, &width, &height);
    struct scene *scene = scene_parse((const char *)example->bytes, example->length, &err);
    cJSON *ops = json_text_parse("[{'op':'set','at':'/render/exposure','value':0}]", NULL);

    assert_non_null(scene);
    local_render_give_example_file(renderer, scene);
    struct resident *resident = resident_create(renderer, scene, 1);
    if (exposure != 0) {
        cJSON_SetNumberValue(cJSON_GetObjectItem(ops->child, "value"), exposure);
        assert_true(resident_edit(resident, ops, 2, &err));
    }
    assert_true(width % (BLOCK * PLACE) == 0 && height % (BLOCK * PLACE) == 0);
    const struct job_desc desc = {.width = width / BLOCK,
                                  .height = height / BLOCK,
                                  .level = QUALITY_STILL,
                                  .samples = 2,
                                  .exact = true};
    assert_true(renderer_render(resident, &desc, &image, &err));
    const double sum = places_difference(&image, pixels);
    image_finish(&image);
    resident_destroy(resident);
    cJSON_Delete(ops);
    free(pixels);
    return sum;
}

static void every_example_has_its_card(void **state)
{
    (void)state;
    assert_int_equal(cards_count, examples_count);
    for (size_t i = 0; i < examples_count; i++) {
        const struct embedded *card = cards_find(examples_table[i].path);

        assert_non_null(card);
        const double mean = difference(&examples_table[i], card, 0);
        progress("%s: %.2f", examples_table[i].path, mean);
        if (mean > CARD_MEAN) {
            fail_msg("the card of %s differs by %.2f on average: make pictures draws it anew",
                     examples_table[i].path, mean);
        }
    }
}

static void another_picture_is_noticed(void **state)
{
    (void)state;
    assert_true(difference(&examples_table[0], cards_find(examples_table[0].path), -0.5) >
                CARD_MEAN);
}

static int start(void **state)
{
    struct error err = {0};
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = getenv("FIELDCAST_CACHE")}};

    (void)state;
    renderer = renderer_create(&params, &err);
    if (!renderer) {
        error_print(&err, stderr);
    }
    return renderer ? 0 : -1;
}

static int stop(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_example_has_its_card),
        cmocka_unit_test(another_picture_is_noticed),
    };

    return cmocka_run_group_tests_name("reference_pictures", tests, start, stop);
}
