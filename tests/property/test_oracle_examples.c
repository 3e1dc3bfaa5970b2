/* SPDX-License-Identifier: MIT */
/* Depth, normal and id as drawn are what the C evaluator says, of examples with a sky behind them.
 * In C a scene takes as long as it has shapes, so every tenth pixel each way is looked at. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/picture_oracle.h"

enum { EVERY = 10 };

#define EXAMPLE(name) "protocol/examples/" name ".json"

static const char *const examples[] = {
    EXAMPLE("blend"),
    EXAMPLE("elongate"),
    EXAMPLE("flat-shapes"),
    EXAMPLE("gyroid"),
    EXAMPLE("lecture-4-transforms"),
    EXAMPLE("lighthouse"),
    EXAMPLE("mirror"),
    EXAMPLE("own-code"),
    EXAMPLE("primitives"),
    EXAMPLE("robot"),
    EXAMPLE("snowman"),
    EXAMPLE("twist"),
};
enum { COUNT = sizeof examples / sizeof examples[0] };

static struct renderer *renderer;

static void example_agrees_with_the_oracle(void **state)
{
    picture_oracle_assert(renderer, *state, EVERY, false);
}

static void another_example_is_noticed(void **state)
{
    struct oracle *oracle = picture_oracle_create(EXAMPLE("elongate"), EVERY);
    const struct oracle_tally tally = picture_oracle_judge(oracle, renderer, EXAMPLE("twist"));

    (void)state;
    oracle_destroy(oracle);
    assert_false(picture_oracle_agrees(EXAMPLE("twist"), &tally, false));
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* An argument, as "*lighthouse*", chooses scenes. */
int main(int argc, char **argv)
{
    static struct CMUnitTest tests[COUNT + 1];

    tests[COUNT] = (struct CMUnitTest)cmocka_unit_test(another_example_is_noticed);
    for (size_t i = 0; i < COUNT; i++) {
        tests[i] = (struct CMUnitTest){examples[i], example_agrees_with_the_oracle, NULL, NULL,
                                       (void *)examples[i]};
    }
    if (argc > 1) {
        cmocka_set_test_filter(argv[1]);
    }
    return _cmocka_run_group_tests("oracle_examples", tests, COUNT + 1, start, stop);
}
