/* SPDX-License-Identifier: MIT */
/* A connection that works much rests as long; one that works little never does. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/net/workload.h"

enum { START_US = 1000000 };

/* Messages that each take `each_us`, sent without a pause: how much of the time is work. */
static double share_of_work(int64_t each_us, int count)
{
    struct workload workload = {0};
    int64_t now = START_US, worked = 0;

    for (int i = 0; i < count; i++) {
        now += each_us;
        worked += each_us;
        now += workload_charge(&workload, now, each_us);
    }
    return (double)worked / (double)(now - START_US);
}

static void half_at_most(void **state)
{
    (void)state;
    for (int64_t each = 100; each <= WORKLOAD_REST_MAX_US; each *= 3) {
        const int count = (int)(100 * WORKLOAD_REST_MAX_US / each);
        assert_true(share_of_work(each, count) < 0.51);
        assert_true(share_of_work(each, count) > 0.49);
    }
}

/* A hand that drags sends small edits for minutes. */
static void little_work_never_rests(void **state)
{
    struct workload workload = {0};
    int64_t now = START_US;

    (void)state;
    for (int i = 0; i < 10000; i++) {
        now += 16000;
        assert_int_equal(workload_charge(&workload, now, 2000), 0);
    }
}

static void time_pays(void **state)
{
    struct workload workload = {0};

    (void)state;
    assert_int_equal(workload_charge(&workload, START_US, 50000), 50000);
    assert_int_equal(workload_charge(&workload, START_US + 60000, 10000), 0);
    assert_int_equal(workload_charge(&workload, START_US + 70000, 10000), 0);
    assert_int_equal(workload_charge(&workload, START_US + 80000, 10000), 30000);
}

static void a_rest_is_bounded(void **state)
{
    struct workload workload = {0};

    (void)state;
    assert_int_equal(workload_charge(&workload, START_US, 60000000), WORKLOAD_REST_MAX_US);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_at_most),
        cmocka_unit_test(little_work_never_rests),
        cmocka_unit_test(time_pays),
        cmocka_unit_test(a_rest_is_bounded),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
