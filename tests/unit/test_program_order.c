/* SPDX-License-Identifier: MIT */
/* Which program is compiled next; nothing is compiled. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/gl/program_internal.h"

enum { SMALL = 10, BIG = 400, STAGES = 3 };

static struct program_cache cache;

static int reset(void **state)
{
    (void)state;
    cache = (struct program_cache){.lock = PTHREAD_MUTEX_INITIALIZER};
    return 0;
}

static void add(struct program *program, size_t shapes, int64_t added_ms, bool code)
{
    *program = (struct program){.next = cache.first,
                                .shape_count = shapes,
                                .added_ms = added_ms,
                                .user_code = code,
                                .stages = STAGES,
                                .refs = 1};
    cache.first = program;
}

static struct program *take(void)
{
    enum program_stage stage = STAGE_COUNT;
    struct program *program = program_order_take(&cache, &stage);

    if (program) {
        assert_int_equal(stage, program->taken - 1);
    }
    return program;
}

static void finish(struct program *program)
{
    program->done++;
    program->refs--;
}

static void smallest_first(void **state)
{
    struct program big, small, middle;

    (void)state;
    add(&big, BIG, 1000, false);
    add(&small, SMALL, 1100, false);
    add(&middle, 100, 1050, false);
    assert_ptr_equal(take(), &small);
    assert_ptr_equal(take(), &middle);
    assert_ptr_equal(take(), &big);
}

/* One thread is left for what comes later. */
static void not_all_at_one(void **state)
{
    struct program big, late;

    (void)state;
    add(&big, BIG, 1000, false);
    for (int i = 0; i < EGL_COMPILERS - 1; i++) {
        assert_ptr_equal(take(), &big);
    }
    assert_null(take());
    add(&late, SMALL, 9000, false);
    assert_ptr_equal(take(), &late);
    finish(&late);
    assert_ptr_equal(take(), &late);
    finish(&big);
    finish(&late);
    assert_ptr_equal(take(), &late);
    assert_ptr_equal(take(), &big);
    assert_null(take());
}

/* Where another waits, not even two. */
static void others_before_a_second_thread(void **state)
{
    struct program first, second;

    (void)state;
    add(&first, SMALL, 1000, false);
    add(&second, BIG, 1000, false);
    assert_ptr_equal(take(), &first);
    assert_ptr_equal(take(), &second);
    assert_ptr_equal(take(), &first);
}

/* Small ones that come and come do not stop a large one for good. */
static void no_starving(void **state)
{
    struct program big, small[200];
    int turn = 0;

    (void)state;
    add(&big, BIG, 0, false);
    for (; turn < 200 && big.taken == 0; turn++) {
        add(&small[turn], SMALL, 1000 * turn, false);
        struct program *taken = take();
        while (taken != &big && taken->taken < STAGES) {
            finish(taken);
            taken = take();
        }
        finish(taken);
    }
    assert_in_range(turn, 5, 100);
}

static void unwanted_programs_are_not_taken(void **state)
{
    struct program gone;

    (void)state;
    add(&gone, SMALL, 1000, false);
    gone.refs = 0;
    assert_null(take());
}

/* It grows with the square: measured 0.9, 2.4 and 8.3 times a scene without for 1, 2 and 4. */
static void code_takes_time(void **state)
{
    struct program plain = {.shape_count = 1}, one = plain, four = plain;

    (void)state;
    one.code_size = LIMIT_CODE_SIZE;
    four.code_size = 4 * LIMIT_CODE_SIZE;
    const int64_t usual = program_usual_ms(&plain);
    assert_in_range(program_usual_ms(&one), usual * 18 / 10, usual * 22 / 10);
    assert_in_range(program_usual_ms(&four), usual * 9, usual * 12);
}

/* One suspect at a time; what holds no code goes on beside it. */
static void code_is_compiled_one_at_a_time(void **state)
{
    struct program code, more, plain;
    bool busy = true;

    (void)state;
    add(&code, BIG, 1000, true);
    add(&more, SMALL, 9000 + program_usual_ms(&code), true);
    assert_null(take()); /* it is not told yet */
    assert_ptr_equal(program_cache_next(&cache, &busy), &code);
    assert_false(busy);
    code.allowed = true;
    assert_ptr_equal(take(), &code);
    assert_null(program_cache_next(&cache, &busy));
    assert_true(busy);
    add(&plain, SMALL, 2000, false);
    assert_ptr_equal(take(), &plain);
    for (; code.done < STAGES; finish(&code)) {
        code.taken = code.taken > code.done ? code.taken : code.done + 1;
    }
    assert_ptr_equal(program_cache_next(&cache, &busy), &more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(smallest_first, reset),
        cmocka_unit_test_setup(not_all_at_one, reset),
        cmocka_unit_test_setup(others_before_a_second_thread, reset),
        cmocka_unit_test_setup(no_starving, reset),
        cmocka_unit_test_setup(unwanted_programs_are_not_taken, reset),
        cmocka_unit_test_setup(code_is_compiled_one_at_a_time, reset),
        cmocka_unit_test_setup(code_takes_time, reset),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
