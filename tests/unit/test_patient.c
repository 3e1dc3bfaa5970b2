/* SPDX-License-Identifier: MIT */
/* Threads that give way wait while something is drawn, and go on at times. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "renderer/patient.h"
#include "server/clock.h"
#include "tests/support/waits.h"

static void work(int ms)
{
    const int64_t end_us = clock_thread_us() + (int64_t)1000 * ms;

    while (clock_thread_us() < end_us) {
    }
}

/* Milliseconds that it waits. */
static double wait_of(void)
{
    const int64_t begun_us = clock_us();

    patient_give_way(PATIENT_ALONE);
    return (double)(clock_us() - begun_us) / 1000;
}

static void it_waits_while_something_is_drawn(void **state)
{
    (void)state;
    patient_draws(PATIENT_ALONE);
    for (int i = 0; i < 3; i++) {
        assert_true(wait_of() >= PATIENT_WAIT_MS);
        work(PATIENT_WORK_MS);
    }
    patient_draws(PATIENT_FREE);
}

static void it_works_for_a_while_after_that(void **state)
{
    int waits = 0;

    (void)state;
    patient_draws(PATIENT_ALONE);
    for (int i = 0; i < 100; i++) {
        waits += wait_of() >= PATIENT_WAIT_MS; /* a busy machine may stop it for as long */
    }
    assert_true(waits < 50);
    patient_draws(PATIENT_FREE);
}

/* Also where it would still work beside what is not urgent. */
static void it_waits_twice_as_long_for_urgent_pictures(void **state)
{
    (void)state;
    patient_draws(PATIENT_ALONE);
    work(PATIENT_WORK_MS); /* what is left from before */
    patient_give_way(PATIENT_ALONE);
    patient_draws(PATIENT_URGENT);
    for (int i = 0; i < 3; i++) {
        assert_true(wait_of() >= 2 * PATIENT_WAIT_MS);
        work(PATIENT_WORK_MS);
    }
    patient_draws(PATIENT_FREE);
}

static void *draw_for_a_moment(void *data)
{
    (void)data;
    patient_draws(PATIENT_FREE);
    return NULL;
}

static void it_goes_on_when_nothing_is_drawn(void **state)
{
    pthread_t other;

    (void)state;
    for (int i = 0; i < 1000; i++) {
        patient_give_way(PATIENT_ALONE); /* waits for nothing, however often */
    }
    patient_draws(PATIENT_ALONE);
    work(2 * PATIENT_WORK_MS);
    assert_int_equal(pthread_create(&other, NULL, draw_for_a_moment, NULL), 0);
    patient_give_way(PATIENT_ALONE);
    pthread_join(other, NULL);
}

static void it_waits_for_no_less_than_it_has_to(void **state)
{
    (void)state;
    patient_draws(PATIENT_ALONE);
    work(PATIENT_WORK_MS);
    const long waits = waits_of_thread();
    patient_give_way(PATIENT_SHARED);
    assert_int_equal(waits_of_thread(), waits);
    patient_draws(PATIENT_FREE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_waits_while_something_is_drawn),
        cmocka_unit_test(it_works_for_a_while_after_that),
        cmocka_unit_test(it_waits_twice_as_long_for_urgent_pictures),
        cmocka_unit_test(it_waits_for_no_less_than_it_has_to),
        cmocka_unit_test(it_goes_on_when_nothing_is_drawn),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
