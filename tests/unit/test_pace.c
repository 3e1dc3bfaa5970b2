/* SPDX-License-Identifier: MIT */
/* How large tiles become, by how long they take. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "renderer/draw/pace.h"

enum { QUICK_US = 1000, MIDDLING_US = 18000, SLOW_US = 300000 };

/* A row of tiles that took so long each; returns the doublings of the next one. */
static int row_of(struct pace *pace, enum pace_company company, enum quality_level level,
                  int64_t us)
{
    struct pace_row row = pace_begin(pace, company, level);

    for (int i = 0; i < 10; i++) {
        pace_learn(pace, level, &row, us);
    }
    pace_end(pace, level, &row);
    return pace_begin(pace, company, level).doublings;
}

static void a_slow_row_halves_the_side_once(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    assert_int_equal(row_of(pace, PACE_ALONE, QUALITY_FINAL, SLOW_US), PACE_FIRST - 1);
    assert_int_equal(pace_begin(pace, PACE_ALONE, QUALITY_INTERACTIVE).doublings, PACE_FIRST);
    assert_int_equal(row_of(pace, PACE_ALONE, QUALITY_FINAL, QUICK_US), PACE_FIRST);
    pace_unref(pace);
}

/* Tiles that are good for one are too long where others wait. */
static void company_makes_tiles_shorter(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    assert_int_equal(row_of(pace, PACE_SHARED, QUALITY_STILL, MIDDLING_US), PACE_FIRST_SHARED - 1);
    assert_int_equal(row_of(pace, PACE_SHARED_PAUSING, QUALITY_STILL, MIDDLING_US), PACE_FIRST);
    assert_int_equal(row_of(pace, PACE_ALONE, QUALITY_STILL, MIDDLING_US), PACE_FIRST + 1);
    assert_int_equal(pace_begin(pace, PACE_SHARED, QUALITY_STILL).doublings, PACE_FIRST_SHARED - 1);
    pace_unref(pace);
}

/* A row that was begun alone has large tiles, and may have many of them. */
static void company_makes_tiles_narrower_at_once(void **state)
{
    struct pace *pace = pace_create();
    const struct pace_row alone = pace_begin(pace, PACE_ALONE, QUALITY_STILL),
                          shared = pace_begin(pace, PACE_SHARED, QUALITY_STILL);

    (void)state;
    assert_int_equal(pace_width(&alone, PACE_ALONE, 512, 64), 512);
    assert_int_equal(pace_width(&shared, PACE_SHARED, 64, 64), 64);
    for (int side = 64; side <= 512; side *= 2) {
        for (int other = 8; other < side; other *= 2) {
            const int width = pace_width(&alone, PACE_SHARED, side, other);

            assert_true(width >= 8 && width % 8 == 0);
            assert_true(width == 8 || width * side <= other * other);
        }
    }
    pace_unref(pace);
}

static void sides_have_ends(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    for (int i = 0; i < 20; i++) {
        row_of(pace, PACE_ALONE, QUALITY_STILL, QUICK_US);
    }
    assert_int_equal(pace_begin(pace, PACE_ALONE, QUALITY_STILL).doublings, PACE_MAX);
    for (int i = 0; i < 20; i++) {
        row_of(pace, PACE_ALONE, QUALITY_STILL, SLOW_US);
    }
    assert_int_equal(pace_begin(pace, PACE_ALONE, QUALITY_STILL).doublings, 0);
    pace_unref(pace);
}

/* A picture that was begun when more, or less, was known. */
static void what_is_out_of_date_changes_nothing(void **state)
{
    struct pace *pace = pace_create();
    struct pace_row small = pace_begin(pace, PACE_ALONE, QUALITY_DRAFT), large = small;

    (void)state;
    small.doublings = 0;
    pace_end(pace, QUALITY_DRAFT, &small);
    large.doublings = PACE_MAX;
    pace_learn(pace, QUALITY_DRAFT, &large, SLOW_US);
    assert_int_equal(pace_begin(pace, PACE_ALONE, QUALITY_DRAFT).doublings, PACE_FIRST);
    pace_unref(pace);
}

static void a_careful_picture_has_the_smallest(void **state)
{
    struct pace *pace = pace_create();

    (void)state;
    pace_be_careful(pace, QUALITY_STILL);
    assert_int_equal(pace_begin(pace, PACE_ALONE, QUALITY_STILL).doublings, 0);
    assert_int_equal(pace_begin(pace, PACE_SHARED, QUALITY_STILL).doublings, 0);
    assert_int_equal(pace_begin(pace, PACE_SHARED, QUALITY_FINAL).doublings, PACE_FIRST_SHARED);
    pace_unref(pace);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slow_row_halves_the_side_once),
        cmocka_unit_test(company_makes_tiles_shorter),
        cmocka_unit_test(company_makes_tiles_narrower_at_once),
        cmocka_unit_test(sides_have_ends),
        cmocka_unit_test(what_is_out_of_date_changes_nothing),
        cmocka_unit_test(a_careful_picture_has_the_smallest),
    };

    return cmocka_run_group_tests_name("pace", tests, NULL, NULL);
}
