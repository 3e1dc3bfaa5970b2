/* SPDX-License-Identifier: MIT */
/* How long a program may be compiled: its bound follows the pace of this machine, and only what is
 * still, not what is kept from the processor, counts as a deadlock. Nothing is compiled. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/gl/program_internal.h"

enum { SHAPES = 400, CODE_MS = 100, LEAP_MS = 500 };

static struct program_cache cache;
static struct program program;

/* This thread is the compiler's. */
static int reset(void **state)
{
    (void)state;
    program = (struct program){
        .structure_hash = 7, .shape_count = SHAPES, .user_code = true, .stages = 1, .patience = 1};
    cache = (struct program_cache){.lock = PTHREAD_MUTEX_INITIALIZER, .code_ms = CODE_MS};
    cache.compilers[0] =
        (struct compiler){.thread = pthread_self(), .cache = &cache, .program = &program};
    program_limit_begin(&cache.compilers[0]);
    return 0;
}

static int64_t now_ms(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

static bool look(struct program_stuck *out)
{
    cache.looked_ms = 0;
    return program_cache_stuck(&cache, out);
}

/* Of the program, in milliseconds. */
static int bound(void)
{
    struct program_stuck stuck = {0};

    program.spent_ms = INT32_MAX / 2;
    assert_true(look(&stuck));
    assert_false(stuck.still);
    assert_int_equal(stuck.structure_hash, program.structure_hash);
    program.spent_ms = stuck.limit_ms / 2;
    assert_false(look(&stuck));
    program.spent_ms = stuck.limit_ms + 1;
    assert_true(look(&stuck));
    assert_in_range(stuck.measured_ms, stuck.limit_ms + 1, stuck.limit_ms + 1000);
    return stuck.limit_ms;
}

static void pace_of_the_machine(void **state)
{
    const int usual = LIMIT_COMPILE_FACTOR * (int)program_usual_ms(&program);
    (void)state;

    assert_true(usual > CODE_MS);
    assert_int_equal(bound(), usual);
    program_cache_set_pace(&cache, 0.2);
    assert_int_equal(bound(), usual);
    program_cache_set_pace(&cache, 3);
    assert_int_equal(bound(), 3 * usual);
    program_cache_set_pace(&cache, 1000);
    assert_int_equal(bound(), 8 * usual);
    for (int i = 0; i < PROGRAM_PACES; i++) {
        program_cache_set_pace(&cache, 2);
    }
    assert_int_equal(bound(), 2 * usual);
}

static void least_and_patience(void **state)
{
    (void)state;
    program.shape_count = 0;
    assert_true(LIMIT_COMPILE_FACTOR * program_usual_ms(&program) < CODE_MS * 20);
    cache.code_ms = CODE_MS * 20;
    assert_int_equal(bound(), CODE_MS * 20);
    program.patience = 5;
    assert_int_equal(bound(), CODE_MS * 100);
    program.user_code = false;
    program.patience = 1;
    assert_int_equal(bound(), LIMIT_COMPILE_MS);
}

/* By programs without code of users alone. */
static void pace_is_measured(void **state)
{
    (void)state;
    program.spent_ms = 3 * program_usual_ms(&program);
    program_limit_end(&cache, &program);
    assert_true(program_cache_pace(&cache) == 1);
    program.user_code = false;
    program_limit_end(&cache, &program);
    assert_in_range(100 * program_cache_pace(&cache), 299, 320);
}

/* As if it had been still for as long as is allowed. */
static void be_still(void)
{
    cache.compilers[0].vigil = (struct vigil){
        .begun = true, .at_ms = now_ms() - LEAP_MS, .still_ms = LIMIT_COMPILE_STILL_MS};
}

static void *spin(void *data)
{
    while (!atomic_load((atomic_bool *)data)) {
    }
    return NULL;
}

static void still_is_no_slowness(void **state)
{
    struct program_stuck stuck = {0};
    atomic_bool stop = false;
    pthread_t other;
    (void)state;

    be_still();
    assert_true(look(&stuck));
    assert_true(stuck.still);
    assert_int_equal(pthread_create(&other, NULL, spin, &stop), 0);
    be_still();
    assert_false(look(&stuck)); /* a thread that waits for a processor may be the one that counts */
    atomic_store(&stop, true);
    pthread_join(other, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(pace_of_the_machine, reset),
        cmocka_unit_test_setup(least_and_patience, reset),
        cmocka_unit_test_setup(pace_is_measured, reset),
        cmocka_unit_test_setup(still_is_no_slowness, reset),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
