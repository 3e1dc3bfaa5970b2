/* SPDX-License-Identifier: MIT */
/* Slices are those of the thread and of those that it creates, and change nothing else. Linux
 * before 6.12 tells a slice of 0 and keeps none: there nothing changes at all. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cmocka.h>

#include "renderer/slice.h"

enum { NS_OF_US = 1000, NICE = 3 };

/* As of sched_getattr(2); the header of Linux and that of threads cannot be included together. */
struct attributes {
    uint32_t size, policy;
    uint64_t flags;
    int32_t nice;
    uint32_t priority;
    uint64_t runtime, deadline, period;
};

static struct attributes look(void)
{
    struct attributes attributes = {0};

    assert_int_equal(syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0), 0);
    return attributes;
}

static void *look_there(void *data)
{
    *(struct attributes *)data = look();
    return NULL;
}

static struct attributes look_in_new_thread(void)
{
    struct attributes attributes;
    pthread_t thread;

    assert_int_equal(pthread_create(&thread, NULL, look_there, &attributes), 0);
    pthread_join(thread, NULL);
    return attributes;
}

static void assert_set(void (*set)(void), uint64_t us)
{
    const struct attributes before = look();
    const bool kept = before.runtime > 0;

    set();
    struct attributes after = look();
    assert_int_equal(after.runtime, kept ? us * NS_OF_US : 0);
    assert_int_equal(look_in_new_thread().runtime, after.runtime);
    after.runtime = before.runtime;
    assert_memory_equal(&after, &before, sizeof before);
}

static void slices_alone_are_set(void **state)
{
    (void)state;
    assert_int_equal(setpriority(PRIO_PROCESS, 0, NICE), 0);
    assert_set(slice_short, SLICE_SHORT_US);
    assert_set(slice_long, SLICE_LONG_US);
    assert_set(slice_drawing, SLICE_DRAWING_US);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slices_alone_are_set)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
