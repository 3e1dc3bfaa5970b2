/* SPDX-License-Identifier: MIT */
/* How tiles shrink and grow. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "renderer/draw/pace.h"

static void a_slow_tile_halves_the_side_once(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    for (int i = 0; i < 10; i++) {
        pace_shrink(pace, QUALITY_FINAL, PACE_FIRST); /* tiles of one row */
    }
    assert_int_equal(pace->doublings[QUALITY_FINAL], PACE_FIRST - 1);
    assert_int_equal(pace->doublings[QUALITY_INTERACTIVE], PACE_FIRST);
    pace_grow(pace, QUALITY_FINAL, PACE_FIRST - 1);
    assert_int_equal(pace->doublings[QUALITY_FINAL], PACE_FIRST);
    pace_unref(pace);
}

static void sides_have_ends(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    for (int i = 0; i < 20; i++) {
        pace_grow(pace, QUALITY_STILL, pace->doublings[QUALITY_STILL]);
    }
    assert_int_equal(pace->doublings[QUALITY_STILL], PACE_MOST);
    for (int i = 0; i < 20; i++) {
        pace_shrink(pace, QUALITY_STILL, pace->doublings[QUALITY_STILL]);
    }
    assert_int_equal(pace->doublings[QUALITY_STILL], 0);
    pace_unref(pace);
}

/* A picture that was begun when more, or less, was known. */
static void what_is_out_of_date_changes_nothing(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    pace_grow(pace, QUALITY_DRAFT, 0);
    assert_int_equal(pace->doublings[QUALITY_DRAFT], PACE_FIRST);
    pace_shrink(pace, QUALITY_DRAFT, PACE_MOST);
    assert_int_equal(pace->doublings[QUALITY_DRAFT], PACE_FIRST);
    pace_unref(pace);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slow_tile_halves_the_side_once),
        cmocka_unit_test(sides_have_ends),
        cmocka_unit_test(what_is_out_of_date_changes_nothing),
    };
    return cmocka_run_group_tests_name("pace", tests, NULL, NULL);
}
