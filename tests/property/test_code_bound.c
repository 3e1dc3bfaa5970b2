/* SPDX-License-Identifier: MIT */
/* Users' code that is as large as may be, whatever it is made of, takes the driver no longer than
 * the watch over compilers allows. Processor time against that of a scene without code. With
 * BOUND_SEEDS=N in the environment N texts, and one of each kind of statement alone: prints them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/bound_code.h"
#include "tests/support/compile_cost.h"

enum { SEEDS = 5, FIRST_SEED = 1, TRIES = 4 };

struct measured {
    struct renderer *renderer;
    double plain_ms, worst;
};

static struct measured measured;

static int setup(void **state)
{
    (void)state;
    measured.renderer = compile_cost_renderer();
    measured.plain_ms = compile_cost_plain(measured.renderer);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    renderer_destroy(measured.renderer);
    return 0;
}

static int size_of(enum code_use use, const char *text)
{
    static const struct param nothing[] = {{.name = NULL}};
    struct error err = {0};
    struct code *code = code_compile(&(struct code_source){use, text, nothing, false}, &err);

    if (!code) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    const int size = code_size(code);
    code_destroy(code);
    return size;
}

static double measure(enum code_use use, const char *text)
{
    return compile_cost_code(measured.renderer, use, text, 1) / measured.plain_ms;
}

static double ratio_of(enum code_use use, const char *text, const char *name)
{
    const int size = size_of(use, text);
    const char *folder = getenv("BOUND_TEXTS");

    if (folder) { /* so that one that never ends can be read */
        char path[256];
        snprintf(path, sizeof path, "%s/%s.glsl", folder, name);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fputs(text, file);
        fclose(file);
    }
    printf("# %s, size %d of %d, %zu bytes\n", name, size, LIMIT_CODE_SIZE, strlen(text));
    fflush(stdout);
    double ratio = measure(use, text);
    /* The machine may have changed its pace meanwhile. */
    for (int i = 1; i < TRIES && ratio > LIMIT_COMPILE_FACTOR; i++) {
        measured.plain_ms = compile_cost_plain(measured.renderer);
        ratio = measure(use, text);
    }
    printf("# ratio %.2f of %.0f ms, %s\n", ratio, measured.plain_ms, name);
    fflush(stdout);
    measured.worst = ratio > measured.worst ? ratio : measured.worst;
    return ratio;
}

static double ratio_of_seed(uint64_t seed, double share)
{
    struct random random = {.state = seed};
    const enum code_use use = seed % 4 == 3 ? CODE_SHADE : CODE_DISTANCE;
    char name[40];
    char *text = bound_code_make(&random, use, -1, share);

    snprintf(name, sizeof name, "seed %llu", (unsigned long long)seed);
    const double ratio = ratio_of(use, text, name);
    free(text);
    return ratio;
}

static void code_at_the_bound_takes_what_is_allowed(void **state)
{
    const char *seeds = getenv("BOUND_SEEDS");
    const uint64_t count = seeds ? strtoull(seeds, NULL, 10) : SEEDS;
    const char *from = getenv("BOUND_FROM");
    const uint64_t first = from ? strtoull(from, NULL, 10) : FIRST_SEED;

    (void)state;
    for (uint64_t seed = first; seed < first + count; seed++) {
        ratio_of_seed(seed, 1);
    }
    assert_true(measured.worst <= LIMIT_COMPILE_FACTOR);
}

static void every_kind_alone_takes_what_is_allowed(void **state)
{
    /* Those that are nearest to the bound, and in BOUND_SEEDS all. */
    static const char *const near[] = {"whole quotient", "broken loop"};
    const bool all = getenv("BOUND_SEEDS") != NULL;
    const char *only = getenv("BOUND_KIND");

    (void)state;
    for (size_t kind = 0; kind < bound_code_kinds(); kind++) {
        const char *name = bound_code_kind(kind);
        bool wanted = all && (!only || strstr(name, only));
        for (size_t i = 0; !all && i < sizeof near / sizeof near[0]; i++) {
            wanted = wanted || strcmp(near[i], name) == 0;
        }
        if (wanted) {
            struct random random = {.state = 1};
            char *text = bound_code_make(&random, CODE_DISTANCE, (int)kind, 1);
            ratio_of(CODE_DISTANCE, text, name);
            free(text);
        }
    }
    assert_true(measured.worst <= LIMIT_COMPILE_FACTOR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_alone_takes_what_is_allowed),
        cmocka_unit_test(code_at_the_bound_takes_what_is_allowed),
    };

    return cmocka_run_group_tests_name("code at the bound", tests, setup, teardown);
}
