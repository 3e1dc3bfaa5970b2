/* SPDX-License-Identifier: MIT */
/* Pictures of environments, read beside the drawing thread. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/draw/asset.h"
#include "renderer/draw/environment.h"
#include "renderer/draw/pictures.h"

enum { WIDTH = 2048, HEIGHT = WIDTH / 2, MOST_MS = 60000 };

static int64_t thread_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static bool is_used(void *data, const char *id)
{
    (void)data;
    (void)id;
    return true;
}

/* A Radiance file in flat rows. */
static void add_file(struct asset **assets)
{
    const size_t size = 100 + (size_t)4 * WIDTH * HEIGHT;
    uint8_t *bytes = memory_alloc(size, 1);
    const int head = snprintf((char *)bytes, 100,
                              "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", HEIGHT, WIDTH);
    const size_t length = (size_t)head + (size_t)4 * WIDTH * HEIGHT;

    for (size_t i = (size_t)head; i < length; i++) {
        bytes[i] = (uint8_t)(128 + i % 7);
    }
    assert_true(assets_add(assets, "file", bytes, length, is_used, NULL));
    free(bytes);
}

static void drawing_takes_over_what_is_made(void **state)
{
    struct asset *assets = NULL;
    struct pictures *pictures = pictures_create();
    struct environments *environments = environments_create(NULL);
    const struct frame_uniforms block = {.sky_kind = SKY_IMAGE};
    struct picture *reading;
    uint32_t us;

    (void)state;
    add_file(&assets);
    struct picture *picture = pictures_want(pictures, assets);
    pictures_allow(pictures, pictures_next(pictures, &reading), MOST_MS);
    while (!pictures_collect(pictures, 1000)) {
    }
    assert_int_equal(picture_problem(picture)->kind, ERROR_NONE);
    const int64_t before = thread_us();
    struct environment *environment =
        environments_get(environments, &block, "file", picture_maps(picture), &us);
    const int64_t spent = thread_us() - before;
    assert_int_equal(environment->maps[0].width, WIDTH);
    assert_null(picture_maps(picture));
    print_message("# %lld us of the drawing thread, %lld of the other\n", (long long)spent,
                  (long long)pictures_cpu_us(pictures));
    assert_true(spent < pictures_cpu_us(pictures) / 20);
    environment_unref(environments, environment);
    picture_unref(pictures, picture);
    environments_destroy(environments);
    pictures_destroy(pictures);
    assets_finish(&assets);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawing_takes_over_what_is_made),
    };

    return cmocka_run_group_tests_name("pictures", tests, NULL, NULL);
}
