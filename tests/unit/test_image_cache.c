/* SPDX-License-Identifier: MIT */
/* The bound of pictures that are kept. Lengths are told and not allocated. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "server/live/image_cache.h"
#include "server/net/shared_buffer.h"

enum { QUARTER = LIMIT_IMAGE_CACHE_BYTES / 4, SMALL = 1000 };

static struct image_cache cache;

static int set_up(void **state)
{
    (void)state;
    cache = (struct image_cache){.limit = LIMIT_IMAGE_CACHE_BYTES};
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    image_cache_finish(&cache);
    return 0;
}

static void add(const char *key, size_t length)
{
    struct shared_buffer *picture = shared_buffer_create("", 1);

    picture->length = length;
    image_cache_add(&cache, key, CODEC_PNG, 1, picture);
    shared_buffer_unref(picture);
}

/* The keys of all, the one that was used last in front. */
static void assert_kept(const char *expected)
{
    char all[64] = "";

    for (const struct cached_image *image = cache.first; image; image = image->after) {
        strncat(all, image->key, sizeof all - strlen(all) - 1);
    }
    assert_string_equal(all, expected);
}

static void who_was_used_least_recently_leaves(void **state)
{
    (void)state;
    add("a", QUARTER - SMALL);
    add("b", QUARTER - SMALL);
    add("c", QUARTER - SMALL);
    add("d", QUARTER - SMALL);
    assert_kept("dcba");
    assert_non_null(image_cache_find(&cache, "a"));
    assert_null(image_cache_find(&cache, "e"));
    assert_kept("adcb");
    add("e", QUARTER - SMALL);
    assert_kept("eadc");
    add("f", SMALL);
    assert_kept("feadc");
    assert_true(cache.bytes <= cache.limit);
}

/* A picture with its key takes a quarter, none takes more, and none is there twice. */
static void one_takes_no_more_than_a_quarter(void **state)
{
    (void)state;
    add("a", QUARTER);
    assert_kept("");
    assert_int_equal(cache.bytes, 0);
    add("a", QUARTER - 1);
    assert_kept("a");
    const size_t bytes = cache.bytes;
    add("b", SMALL);
    add("a", QUARTER - 1);
    assert_kept("ab");
    image_cache_find(&cache, "b");
    add("c", QUARTER - 1);
    add("d", QUARTER - 1);
    add("e", QUARTER - 1);
    assert_kept("edcb");
    assert_true(cache.bytes < 4 * bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(who_was_used_least_recently_leaves, set_up, tear_down),
        cmocka_unit_test_setup_teardown(one_takes_no_more_than_a_quarter, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("image_cache", tests, NULL, NULL);
}
