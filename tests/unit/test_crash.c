/* SPDX-License-Identifier: MIT */
/* What a process was at when it crashed, from its exit status: also where the thread that crashed
 * is one that the engine started for a picture. */
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "renderer/crash.h"
#include "tests/support/drawing.h"

enum { THREADS = 2, SIDE = 128, WHOLE = 7, AT_ONCE = 8, ROUNDS = 200 };

static atomic_bool helpers_crash;

/* In front of the system's: the engine's threads call it as they begin. */
int sched_setaffinity(pid_t pid, size_t size, const cpu_set_t *set)
{
    (void)pid;
    (void)size;
    (void)set;
    if (atomic_load(&helpers_crash)) {
        __builtin_trap();
    }
    return 0;
}

static void trap(void)
{
    __builtin_trap();
}

static void *trap_with_the_others(void *start)
{
    crash_thread(CRASH_COMPILING);
    pthread_barrier_wait(start);
    __builtin_trap();
}

static void trap_at_once(void)
{
    pthread_barrier_t start;
    pthread_t thread;

    pthread_barrier_init(&start, NULL, AT_ONCE);
    for (int i = 1; i < AT_ONCE; i++) {
        if (pthread_create(&thread, NULL, trap_with_the_others, &start) != 0) {
            _exit(1);
        }
    }
    trap_with_the_others(&start);
}

static void draw(void)
{
    struct error err = {0};
    const struct renderer_params params = {
        .device = {.index = -1}, .stage = RENDER_ENGINE, .threads = THREADS};
    struct renderer *renderer = renderer_create(&params, &err);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    const struct job_desc desc = drawing_desc(SIDE, SIDE);
    struct image image;

    if (!renderer_render(resident, &desc, &image, &err)) {
        _exit(1);
    }
}

/* The exit status of a process that does it as this work; -1: it ends by a signal. */
static int status_of(enum crash_work work, void (*act)(void))
{
    int status = 0;
    const pid_t child = fork();

    if (child == 0) {
        signal(SIGILL, SIG_DFL); /* not cmocka's */
        crash_watch();
        crash_thread(work);
        act();
        _exit(WHOLE);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void a_thread_tells_its_work(void **state)
{
    (void)state;
    for (int work = CRASH_COMPILING; work < CRASH_WORKS; work++) {
        assert_int_equal(crash_of(status_of((enum crash_work)work, trap)), work);
    }
    assert_int_equal(status_of(CRASH_ANYWHERE, trap), -1);
    assert_int_equal(crash_of(WHOLE), CRASH_ANYWHERE);
}

/* Two threads may compile the same code. */
static void threads_that_crash_at_once_tell_it_too(void **state)
{
    (void)state;
    for (int i = 0; i < ROUNDS; i++) {
        assert_int_equal(crash_of(status_of(CRASH_COMPILING, trap_at_once)), CRASH_COMPILING);
    }
}

static void the_engines_threads_tell_that_of_who_draws(void **state)
{
    (void)state;
    assert_int_equal(status_of(CRASH_DRAWING, draw), WHOLE);
    atomic_store(&helpers_crash, true);
    assert_int_equal(crash_of(status_of(CRASH_DRAWING, draw)), CRASH_DRAWING);
    atomic_store(&helpers_crash, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thread_tells_its_work),
        cmocka_unit_test(threads_that_crash_at_once_tell_it_too),
        cmocka_unit_test(the_engines_threads_tell_that_of_who_draws),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
