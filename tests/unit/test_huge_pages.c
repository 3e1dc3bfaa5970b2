/* SPDX-License-Identifier: MIT */
/* How malloc() of a process is asked for huge pages: by its environment. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "server/cli/huge_pages.h"

#define TUNABLES "GLIBC_TUNABLES"

static void an_empty_environment_gets_the_setting(void **state)
{
    (void)state;
    unsetenv(TUNABLES);
    assert_true(huge_pages_ask());
    assert_string_equal(getenv(TUNABLES), "glibc.malloc.hugetlb=1");
    assert_false(huge_pages_ask()); /* or a program would start itself for ever */
}

static void other_settings_stay(void **state)
{
    (void)state;
    setenv(TUNABLES, "glibc.malloc.check=1", 1);
    assert_true(huge_pages_ask());
    assert_string_equal(getenv(TUNABLES), "glibc.malloc.check=1:glibc.malloc.hugetlb=1");
}

static void a_setting_of_ones_own_is_kept(void **state)
{
    (void)state;
    setenv(TUNABLES, "glibc.malloc.hugetlb=0", 1);
    assert_false(huge_pages_ask());
    assert_string_equal(getenv(TUNABLES), "glibc.malloc.hugetlb=0");
}

static void too_long_settings_are_left_alone(void **state)
{
    char text[5000];

    (void)state;
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    setenv(TUNABLES, text, 1);
    assert_false(huge_pages_ask());
    assert_string_equal(getenv(TUNABLES), text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_environment_gets_the_setting),
        cmocka_unit_test(other_settings_stay),
        cmocka_unit_test(a_setting_of_ones_own_is_kept),
        cmocka_unit_test(too_long_settings_are_left_alone),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
