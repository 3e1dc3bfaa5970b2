/* SPDX-License-Identifier: MIT */
/* Who is still is told from who is slow; and what /proc says of processes that are at work, asleep
 * or stopped. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "renderer/vigil.h"

/* `count` looks, each `every_ms` after the other, in which so much of the processor was used. */
static struct vigil watched(int count, int every_ms, int used_ms, bool runnable)
{
    struct vigil vigil = {0};
    struct vigil_use use = {1000, runnable};

    for (int i = 0; i <= count; i++) {
        vigil_look(&vigil, 5000 + i * (int64_t)every_ms, &use);
        use.cpu_ms += used_ms;
    }
    return vigil;
}

static void stillness_counts(void **state)
{
    (void)state;
    assert_int_equal(watched(10, 250, 0, false).still_ms, 2500);
    assert_int_equal(watched(10, 250, 10, false).still_ms, 2500);
}

static void who_works_or_waits_for_a_processor_is_not_still(void **state)
{
    (void)state;
    assert_int_equal(watched(1000, 250, 20, false).still_ms, 0);
    assert_int_equal(watched(1000, 250, 0, true).still_ms, 0);
    assert_int_equal(watched(1000, 250, 20, false).spent_ms, 20000);
}

static void a_watcher_that_was_kept_away_counts_little(void **state)
{
    (void)state;
    assert_int_equal(watched(1, 3600000, 0, false).still_ms, VIGIL_GAP_MS);
}

static void a_moment_of_work_or_a_sign_of_life_begins_anew(void **state)
{
    struct vigil vigil = watched(10, 250, 0, false);
    struct vigil_use use = {1100, false};

    (void)state;
    vigil_look(&vigil, vigil.at_ms + 250, &use);
    assert_int_equal(vigil.still_ms, 0);
    assert_int_equal(vigil.spent_ms, 100);
    vigil_restart(&vigil);
    use.cpu_ms = 9000;
    vigil_look(&vigil, 100000, &use);
    assert_int_equal(vigil.still_ms, 0);
    assert_int_equal(vigil.spent_ms, 0);
}

static void looks_in_between_change_nothing(void **state)
{
    (void)state;
    assert_int_equal(watched(1000, VIGIL_LOOK_MS / 10, 0, false).still_ms,
                     1000 * VIGIL_LOOK_MS / 10);
}

/* --- processes --- */

static void work(void)
{
    for (volatile int i = 0;; i++) {
    }
}

static void wait_for_ever(void)
{
    for (;;) {
        pause();
    }
}

static pid_t begin(void (*act)(void))
{
    const pid_t child = fork();

    assert_true(child >= 0);
    if (child == 0) {
        act();
    }
    return child;
}

static void end(pid_t child)
{
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
}

/* Until the process is so. */
static struct vigil_use wait_until(pid_t child, bool runnable)
{
    struct vigil_use use;

    do {
        assert_true(vigil_use_of(child, 0, &use));
    } while (use.runnable != runnable);
    return use;
}

static void processes_are_at_work_asleep_or_stopped(void **state)
{
    const pid_t busy = begin(work), asleep = begin(wait_for_ever);
    struct vigil_use use;

    (void)state;
    wait_until(asleep, false);
    do {
        use = wait_until(busy, true);
    } while (use.cpu_ms < 50);
    kill(busy, SIGSTOP);
    wait_until(busy, false);
    end(busy);
    end(asleep);
    assert_false(vigil_use_of(busy, 0, &use));
}

static void who_asks_does_not_count(void **state)
{
    struct vigil_use use;

    (void)state;
    assert_true(vigil_use_of(getpid(), 0, &use));
    assert_true(use.runnable);
    assert_true(vigil_use_of(getpid(), getpid(), &use));
    assert_false(use.runnable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stillness_counts),
        cmocka_unit_test(who_works_or_waits_for_a_processor_is_not_still),
        cmocka_unit_test(a_watcher_that_was_kept_away_counts_little),
        cmocka_unit_test(a_moment_of_work_or_a_sign_of_life_begins_anew),
        cmocka_unit_test(looks_in_between_change_nothing),
        cmocka_unit_test(processes_are_at_work_asleep_or_stopped),
        cmocka_unit_test(who_asks_does_not_count),
    };

    return cmocka_run_group_tests_name("vigil", tests, NULL, NULL);
}
