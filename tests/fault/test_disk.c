/* SPDX-License-Identifier: MIT */
/* A disk that fails: each call on the files of a store fails once in each way it can. What was told
 * durable is there when the store is opened again, and nothing else happens than an end that says
 * why. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "server/cli/files.h"
#include "server/store/store.h"
#include "tests/support/drivers/disk_driver.h"
#include "tests/support/preload.h"
#include "tests/support/store_life.h"

static char base[64];
static char directory[100]; /* two levels below */

/* What a life came to. */
struct life {
    int status; /* of its end; -1: by a signal */
    struct store_told told;
    int counts[DISK_CALLS_COUNT];
};

static disk_arm_function *disk_arm;
static disk_count_function *disk_count;
static int *counts; /* shared with the process that lives */

static struct life live(enum disk_call call, int nth, int error)
{
    struct life life = {0};
    int ends[2], status;

    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        if (!freopen("/dev/null", "w", stderr)) {
            _exit(1);
        }
        disk_arm(base, call, nth, error);
        const int result = store_life(directory, ends[1]);
        for (int i = 0; i < DISK_CALLS_COUNT; i++) {
            counts[i] = disk_count((enum disk_call)i);
        }
        _exit(result);
    }
    close(ends[1]);
    store_life_read_told(ends[0], &life.told);
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    life.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    memcpy(life.counts, counts, sizeof life.counts);
    return life;
}

static void remove_directory(void)
{
    char path[200];

    snprintf(path, sizeof path, "%s/a", base);
    directory_remove(path);
}

static void check_life(const struct life *life, enum disk_call call, int nth, int error)
{
    const char *fault = store_life_fault(directory, &life->told);

    if (life->status != 0 && life->status != STORE_LIFE_REFUSED &&
        life->status != STORE_EXIT_STATUS) {
        fail_msg("call %d number %d error %d: status %d", call, nth, error, life->status);
    }
    if (fault) {
        fail_msg("call %d number %d error %d: revision %lld was told durable: %s", call, nth, error,
                 (long long)life->told.revision, fault);
    }
    remove_directory();
}

/* The ways in which a call fails take turns. */
static void each_call_fails_once(void **state)
{
    static const int errors[DISK_CALLS_COUNT][5] = {
        [DISK_OPEN] = {EMFILE, EACCES},
        [DISK_READ] = {EIO, EINTR, DISK_SHORT},
        [DISK_WRITE] = {ENOSPC, DISK_SHORT, EIO, EINTR},
        [DISK_CUT] = {EIO},
        [DISK_SYNC] = {EIO, ENOSPC},
        [DISK_REMOVE] = {EIO},
    };
    const struct life whole = live(DISK_OPEN, 0, 0);
    int lives = 0, ended = 0, refused = 0;

    (void)state;
    assert_int_equal(whole.status, 0);
    assert_true(whole.told.revision > 0 && whole.told.asset);
    check_life(&whole, DISK_OPEN, 0, 0);
    for (int call = 0; call < DISK_CALLS_COUNT; call++) {
        int ways = 0;
        while (errors[call][ways] != 0) {
            ways++;
        }
        assert_true(whole.counts[call] > 0);
        for (int nth = 1; nth <= whole.counts[call]; nth++) {
            const int error = errors[call][nth % ways];
            const struct life life = live((enum disk_call)call, nth, error);
            check_life(&life, (enum disk_call)call, nth, error);
            lives++;
            ended += life.status == STORE_EXIT_STATUS;
            refused += life.status == STORE_LIFE_REFUSED;
        }
    }
    printf("# %d lives with one failure each: %d ended by it, %d not begun\n", lives, ended,
           refused);
    assert_true(ended > 0 && refused > 0 && ended + refused < lives);
}

static int make_base(void **state)
{
    (void)state;
    store_life_make_base(base, sizeof base, "disk");
    snprintf(directory, sizeof directory, "%s/a/data", base);
    return 0;
}

static int remove_base(void **state)
{
    (void)state;
    return rmdir(base);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_call_fails_once)};

    (void)argc;
    preload(argv, "disk_driver");
    disk_arm = (disk_arm_function *)preload_symbol("disk_arm");
    disk_count = (disk_count_function *)preload_symbol("disk_count");
    counts = mmap(NULL, sizeof(int) * DISK_CALLS_COUNT, PROT_READ | PROT_WRITE,
                  MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return cmocka_run_group_tests(tests, make_base, remove_base);
}
