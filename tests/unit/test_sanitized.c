/* SPDX-License-Identifier: MIT */
/* Programs with AddressSanitizer find what is wrong with memory of ours, although that of drivers
 * is not the sanitizer's (support/sanitized/driver_memory.c). */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

int __lsan_do_recoverable_leak_check(void) __attribute__((weak));

enum { SIZE = 20, LARGE = 1 << 20 };

static char *volatile block;

static void nothing(void)
{
    block = calloc(1, SIZE);
    block = realloc(block, LARGE);
    block[LARGE - 1] = block[0];
    free(block);
    block = NULL;
}

static void write_behind(void)
{
    block = malloc(SIZE);
    memset(block, 0, SIZE + (size_t)(block[0] == 0) + 1);
}

static void write_behind_a_large_one(void)
{
    block = malloc(LARGE);
    block[LARGE] = 1;
}

static void use_after_free(void)
{
    block = malloc(SIZE);
    free(block);
    block[0] = 1;
}

static void use_after_realloc(void)
{
    char *volatile old = malloc(SIZE);

    block = realloc(old, LARGE);
    old[0] = 1;
}

static void free_twice(void)
{
    block = malloc(SIZE);
    free(block);
    free(block);
}

static void lose(void)
{
    block = strdup("what nobody has any more");
    block = NULL;
}

/* What a process answers that does it. */
static int status_of(void (*act)(void))
{
    int status = 0;

    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);

        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        act();
        _exit(__lsan_do_recoverable_leak_check() ? EXIT_FAILURE : EXIT_SUCCESS);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void faults_end_a_process(void **state)
{
    void (*const faults[])(void) = {write_behind,   write_behind_a_large_one,
                                    use_after_free, use_after_realloc,
                                    free_twice,     lose};
    (void)state;

    if (!__lsan_do_recoverable_leak_check) {
        skip();
    }
    assert_int_equal(status_of(nothing), 0);
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        print_message("# fault %zu\n", i);
        assert_int_not_equal(status_of(faults[i]), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faults_end_a_process)};

    return cmocka_run_group_tests_name("sanitized", tests, NULL, NULL);
}
