/* SPDX-License-Identifier: MIT */
/* Pictures of fewer rays than pixels: near to those of all rays, and no others by their tiles. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum {
    WIDTH = 203,
    HEIGHT = 131,
    FAR = 12, /* of 255 */
};

static const char *const scenes[] = {
    "protocol/examples/first-steps.json",
    "protocol/examples/csg.json",
    "protocol/examples/snowman.json",
    "protocol/examples/mirrors.json",
};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static struct renderer *renderer;

static struct image draw(struct resident *resident, bool sparse, struct job_region region)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.level = QUALITY_INTERACTIVE;
    desc.sparse = sparse;
    desc.region = region;
    return drawing_of(resident, &desc, AOV_COLOR);
}

/* Pixels of which a channel differs by more than `most` of 255. */
static int count_other(const struct image *a, const struct image *b, int most)
{
    const uint8_t *one = a->pixels, *two = b->pixels;
    int count = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool other = false;
        for (int k = 0; k < a->channels; k++) {
            const int at = i * a->channels + k;
            other = other || abs((int)one[at] - (int)two[at]) > most;
        }
        count += other;
    }
    return count;
}

static void is_near_to_all_rays(void **state)
{
    const struct job_region all = {0};

    (void)state;
    for (int i = 0; i < SCENES; i++) {
        struct resident *resident = drawing_resident(renderer, scenes[i]);
        struct image full = draw(resident, false, all), sparse = draw(resident, true, all);

        assert_true(count_other(&full, &sparse, 0) > 0); /* some were interpolated */
        const int far = count_other(&full, &sparse, FAR);
        if (far > WIDTH * HEIGHT / 50) {
            fail_msg("%s: %d pixels differ", scenes[i], far);
        }
        image_finish(&full);
        image_finish(&sparse);
        resident_destroy(resident);
    }
}

/* A part has other tiles, with other margins. */
static void tiles_do_not_show(void **state)
{
    static const struct job_region parts[] = {
        {0, 0, 70, 131}, {33, 17, 101, 66}, {66, 2, 65, 129}, {127, 61, 76, 70}, {3, 3, 1, 1}};
    struct resident *resident = drawing_resident(renderer, scenes[1]);
    struct image whole = draw(resident, true, (struct job_region){0});

    (void)state;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const struct job_region region = parts[i];
        struct image part = draw(resident, true, region);

        for (int y = 0; y < region.height; y++) {
            const size_t pixel = whole.bytes / (WIDTH * HEIGHT),
                         bytes = pixel * (size_t)region.width;
            const size_t from = pixel * (size_t)((region.y + y) * WIDTH + region.x);
            assert_memory_equal((uint8_t *)part.pixels + (size_t)y * bytes,
                                (uint8_t *)whole.pixels + from, bytes);
        }
        image_finish(&part);
    }
    image_finish(&whole);
    resident_destroy(resident);
}

static void values_and_more_samples_have_all_rays(void **state)
{
    struct resident *resident = drawing_resident(renderer, scenes[1]);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    (void)state;
    for (int i = 0; i < 2; i++) {
        const enum aov aov = i == 0 ? AOV_DEPTH : AOV_COLOR;
        desc.level = i == 0 ? QUALITY_INTERACTIVE : QUALITY_STILL;
        desc.samples = i == 0 ? 1 : 2;
        desc.sparse = false;
        struct image full = drawing_of(resident, &desc, aov);
        desc.sparse = true;
        struct image same = drawing_of(resident, &desc, aov);

        assert_true(drawing_is_same(&full, &same));
        image_finish(&full);
        image_finish(&same);
    }
    resident_destroy(resident);
}

/* Light is the same where distances are wanted beside it, and a distance is that of a pixel at most
 * so far away. */
static void distances_beside_light_are_near_to_all_rays(void **state)
{
    enum { AROUND = 4 };
    struct resident *resident = drawing_resident(renderer, scenes[1]);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    int far = 0;

    (void)state;
    desc.level = QUALITY_INTERACTIVE;
    desc.sparse = desc.raw_depth = true;
    struct image alone = drawing_of(resident, &desc, AOV_COLOR);
    struct image full = drawing_of(resident, &desc, AOV_DEPTH);
    desc.aovs[AOV_COLOR] = desc.aovs[AOV_DEPTH] = true;
    struct drawing both = drawing_outputs(renderer, resident, &desc);
    assert_true(drawing_is_same(&alone, &both.of[AOV_COLOR]));
    const float *told = both.of[AOV_DEPTH].pixels, *true_ones = full.pixels;
    assert_memory_not_equal(told, true_ones, full.bytes);
    for (int y = AROUND; y < HEIGHT - AROUND; y++) {
        for (int x = AROUND; x < WIDTH - AROUND; x++) {
            float least = INFINITY, most = 0;
            for (int i = 0; i < (2 * AROUND + 1) * (2 * AROUND + 1); i++) {
                const float there = true_ones[(y + i / (2 * AROUND + 1) - AROUND) * WIDTH + x +
                                              i % (2 * AROUND + 1) - AROUND];
                least = fminf(least, there);
                most = fmaxf(most, there);
            }
            far += told[y * WIDTH + x] < least || told[y * WIDTH + x] > most;
        }
    }
    assert_true(far <= WIDTH * HEIGHT / 500);
    image_finish(&alone);
    image_finish(&full);
    drawing_finish(&both);
    resident_destroy(resident);
}

static void large_fields_have_all_rays(void **state)
{
    const struct job_region all = {0};
    struct resident *resident = drawing_resident(renderer, "protocol/examples/temple.json");
    struct image full = draw(resident, false, all), same = draw(resident, true, all);

    (void)state;
    assert_true(drawing_is_same(&full, &same));
    image_finish(&full);
    image_finish(&same);
    resident_destroy(resident);
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    renderer_use_stage(renderer, RENDER_ENGINE);
    return 0;
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
        cmocka_unit_test(is_near_to_all_rays),
        cmocka_unit_test(tiles_do_not_show),
        cmocka_unit_test(large_fields_have_all_rays),
        cmocka_unit_test(values_and_more_samples_have_all_rays),
        cmocka_unit_test(distances_beside_light_are_near_to_all_rays),
    };

    return cmocka_run_group_tests_name("sparse", tests, start, stop);
}
