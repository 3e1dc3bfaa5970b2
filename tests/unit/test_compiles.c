/* SPDX-License-Identifier: MIT */
/* What earlier compilations say of the next one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/live/compiles.h"

static void nothing_is_known_at_first(void **state)
{
    const struct compiles compiles = {0};

    (void)state;
    assert_int_equal(compiles_expected(&compiles, 0), -1);
    assert_int_equal(compiles_expected(&compiles, 1000000000), -1);
}

static void the_median_of_that_size_counts(void **state)
{
    struct compiles compiles = {0};

    (void)state;
    compiles_record(&compiles, 100, 5000);
    compiles_record(&compiles, 127, 900);
    compiles_record(&compiles, 64, 1000);
    compiles_record(&compiles, 128, 7777);
    assert_int_equal(compiles_expected(&compiles, 90), 1000);
    assert_int_equal(compiles_expected(&compiles, 200), 7777);
    assert_int_equal(compiles_expected(&compiles, 63), -1);
}

static void old_ones_are_forgotten(void **state)
{
    struct compiles compiles = {0};

    (void)state;
    for (int i = 0; i < 100; i++) {
        compiles_record(&compiles, 8, 60000);
    }
    for (int i = 0; i < COMPILES_KEPT; i++) {
        compiles_record(&compiles, 8, 300 + i);
    }
    assert_int_equal(compiles_expected(&compiles, 8), 300 + COMPILES_KEPT / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_known_at_first),
        cmocka_unit_test(the_median_of_that_size_counts),
        cmocka_unit_test(old_ones_are_forgotten),
    };

    return cmocka_run_group_tests_name("compiles", tests, NULL, NULL);
}
