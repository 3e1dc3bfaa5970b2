/* SPDX-License-Identifier: MIT */
/* Pictures do not show how they were cut up: into tiles, into regions, into rows. And their size
 * costs no memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/peak.h"

enum { WIDTH = 112, HEIGHT = 72 };

/* --- tiles --- */

/* All outputs at once, as raw values, and the colour as pixels. */
struct outputs {
    struct drawing raw;
    struct image color;
};

static struct outputs draw_outputs(int tile_side)
{
    struct renderer *renderer = drawing_renderer(tile_side);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct outputs outputs = {.color = drawing_of(resident, &desc, AOV_COLOR)};

    desc.as_floats = true;
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        desc.aovs[aov] = true;
    }
    outputs.raw = drawing_outputs(renderer, resident, &desc);
    resident_destroy(resident);
    renderer_destroy(renderer);
    return outputs;
}

static void outputs_finish(struct outputs *outputs)
{
    drawing_finish(&outputs->raw);
    image_finish(&outputs->color);
}

static void tiles_do_not_show(void **state)
{
    static const int sides[] = {32, 64};
    struct outputs whole = draw_outputs(256);

    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        struct outputs tiled = draw_outputs(sides[i]);
        assert_true(drawing_is_same(&tiled.color, &whole.color));
        for (int aov = 0; aov < AOV_COUNT; aov++) {
            if (!drawing_is_same(&tiled.raw.of[aov], &whole.raw.of[aov])) {
                fail_msg("%s is not the same in tiles of %d", aov_name((enum aov)aov), sides[i]);
            }
        }
        outputs_finish(&tiled);
    }
    outputs_finish(&whole);
}

/* The engine draws the others where there is no GPU. */
static struct image draw_by(enum render_stage stage, int tile_side)
{
    struct renderer *renderer = drawing_renderer(tile_side);
    struct job_desc desc = drawing_desc(WIDTH / 2, HEIGHT / 2);

    renderer_use_stage(renderer, stage);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    renderer_destroy(renderer);
    return image;
}

static void tiles_of_shaders_do_not_show(void **state)
{
    static const enum render_stage stages[] = {RENDER_COMPUTE, RENDER_FRAGMENT};

    (void)state;
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
        struct image whole = draw_by(stages[i], 128), tiled = draw_by(stages[i], 32);

        if (!drawing_is_same(&tiled, &whole)) {
            fail_msg("%s: tiles show", render_stage_names[stages[i]]);
        }
        image_finish(&whole);
        image_finish(&tiled);
    }
}

/* --- regions --- */

static void assert_is_crop(const struct image *part, const struct image *whole,
                           const struct job_region *region)
{
    const size_t pixel = whole->bytes / (size_t)whole->width / (size_t)whole->height;
    const size_t row = pixel * (size_t)region->width;

    assert_int_equal(part->width, region->width);
    assert_int_equal(part->height, region->height);
    for (int y = 0; y < region->height; y++) {
        const uint8_t *expected =
            (const uint8_t *)whole->pixels +
            pixel * ((size_t)(region->y + y) * (size_t)whole->width + (size_t)region->x);
        assert_memory_equal((const uint8_t *)part->pixels + row * (size_t)y, expected, row);
    }
}

/* Four that overlap, none of which begins where a tile does. */
static void regions_do_not_show(void **state)
{
    static const struct job_region regions[] = {
        {0, 0, 61, 43}, {47, 5, 65, 41}, {3, 31, 60, 41}, {40, 27, 72, 45}};
    struct renderer *renderer = drawing_renderer(32);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image whole = drawing_of(resident, &desc, AOV_COLOR);

    (void)state;
    for (size_t i = 0; i < sizeof regions / sizeof regions[0]; i++) {
        desc.region = regions[i];
        struct image part = drawing_of(resident, &desc, AOV_COLOR);
        assert_is_crop(&part, &whole, &regions[i]);
        image_finish(&part);
    }
    image_finish(&whole);
    resident_destroy(resident);
    renderer_destroy(renderer);
}

/* --- large pictures --- */

enum { LARGE_WIDTH = LIMIT_IMAGE_SIDE };
#ifdef __SANITIZE_ADDRESS__
enum { LARGE_HEIGHT = 512, MOST_MIB = 32 };
#else
enum { LARGE_HEIGHT = 1024, MOST_MIB = 64 };
#endif

static const struct job_region corners[] = {{8000, 100, 300, 200},
                                            {8200, 200, 300, 200},
                                            {8100, 225, 300, 100},
                                            {15900, LARGE_HEIGHT - 200, 484, 200}};
enum { CORNERS = sizeof corners / sizeof corners[0] };

/* What of a region lies in these rows of the whole picture, which begin at row `top`. */
static void copy_rows(struct image *part, const struct job_region *region, const struct image *rows,
                      int top)
{
    for (int y = 0; y < rows->height; y++) {
        const int row = top + y - region->y;
        if (row >= 0 && row < region->height) {
            memcpy((uint8_t *)part->pixels + 4L * row * region->width,
                   (const uint8_t *)rows->pixels + 4L * (y * (long)rows->width + region->x),
                   4UL * (size_t)region->width);
        }
    }
}

/* Draws the whole by rows and keeps of it what lies in the corners. Answers the most that was held
 * meanwhile. */
static long draw_by_rows(struct renderer *renderer, struct resident *resident,
                         const struct job_desc *desc, struct image kept[CORNERS])
{
    struct error err = {0};
    struct job *job = job_create(resident, desc, &err);
    long most_mib = 0;
    int top = 0;

    assert_non_null(job);
    for (enum job_state state; (state = job_step(job)) != JOB_DONE;) {
        assert_int_not_equal(state, JOB_FAILED);
        renderer_poll(renderer, state == JOB_WAITING ? 100 : 0);
        if (state == JOB_ROWS) {
            struct image rows = job_take_rows(job, AOV_COLOR);
            for (int i = 0; i < CORNERS; i++) {
                copy_rows(&kept[i], &corners[i], &rows, top);
            }
            const long mib = peak_held_mib();
            most_mib = mib > most_mib ? mib : most_mib;
            top += rows.height;
            image_finish(&rows);
        }
    }
    assert_int_equal(top, desc->height);
    job_destroy(job);
    return most_mib;
}

static void large_pictures_have_no_seams_and_take_little(void **state)
{
    static const char path[] = "tests/golden/nodes/sphere/scene.json";
    struct renderer *renderer = drawing_renderer(0);
    struct resident *resident = drawing_resident(renderer, path);
    struct job_desc desc = drawing_desc(256, 256);
    struct image kept[CORNERS], image = drawing_of(resident, &desc, AOV_COLOR);
    const long before = peak_held_mib();

    (void)state;
    image_finish(&image);
    desc = drawing_desc(LARGE_WIDTH, LARGE_HEIGHT);
    desc.samples = 1;
    desc.aovs[AOV_COLOR] = true;
    for (int i = 0; i < CORNERS; i++) {
        const size_t bytes = 4UL * (size_t)corners[i].width * (size_t)corners[i].height;
        kept[i] = (struct image){.width = corners[i].width,
                                 .height = corners[i].height,
                                 .pixels = calloc(1, bytes),
                                 .bytes = bytes};
    }
    const long more = draw_by_rows(renderer, resident, &desc, kept) - before;
    print_message("# %ld MiB more\n", more);
    assert_in_range(more, 0, MOST_MIB);
    for (int i = 0; i < CORNERS; i++) {
        desc.region = corners[i];
        image = drawing_of(resident, &desc, AOV_COLOR);
        assert_true(drawing_is_same(&image, &kept[i]));
        image_finish(&image);
        image_finish(&kept[i]);
    }
    resident_destroy(resident);
    renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        /* The first, for it looks at the most memory that there ever was. */
        cmocka_unit_test(large_pictures_have_no_seams_and_take_little),
        cmocka_unit_test(tiles_do_not_show),
        cmocka_unit_test(tiles_of_shaders_do_not_show),
        cmocka_unit_test(regions_do_not_show),
    };

    return cmocka_run_group_tests_name("tiles", tests, NULL, NULL);
}
