/* SPDX-License-Identifier: MIT */
/* A loss of power: the life of a store is recorded. What the disk may hold at each moment before a
 * sync and behind an acknowledgement is made of it, and opened: what was told durable is there. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "server/cli/files.h"
#include "server/store/store.h"
#include "tests/support/drivers/disk_driver.h"
#include "tests/support/power.h"
#include "tests/support/preload.h"
#include "tests/support/store_life.h"

static char base[64];
static struct power_record record;

static const char *beneath(const char *name)
{
    static char paths[4][100];
    static unsigned turn;
    char *path = paths[turn++ % 4];

    snprintf(path, sizeof paths[0], "%s/%s", base, name);
    return path;
}

static int record_life(void **state)
{
    int status, told[2];

    (void)state;
    store_life_make_base(base, sizeof base, "power");
    assert_int_equal(pipe(told), 0);
    assert_int_equal(mkdir(beneath("disk"), 0700), 0);
    const pid_t child = fork();
    if (child == 0) {
        ((disk_record_function *)preload_symbol("disk_record"))(
            open(beneath("record"), O_WRONLY | O_CREAT, 0600));
        ((disk_arm_function *)preload_symbol("disk_arm"))(beneath("disk"), DISK_OPEN, 0, 0);
        _exit(store_life(beneath("disk/a/data"), told[1]));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    close(told[0]);
    close(told[1]);
    return power_record_read(&record, beneath("record")) ? 0 : -1;
}

static int forget(void **state)
{
    (void)state;
    power_record_finish(&record);
    directory_remove(base);
    return 0;
}

static void check_moment(size_t event, const struct store_told *durable)
{
    for (int luck = 0; luck < POWER_LUCKS; luck++) {
        assert_int_equal(mkdir(beneath("image"), 0700), 0);
        power_image(&record, event, luck, beneath("disk"), beneath("image"));
        const char *fault = store_life_fault(beneath("image/a/data"), durable);
        if (fault) {
            fail_msg("event %zu of %zu, luck %d: revision %lld was told durable: %s", event,
                     record.count, luck, (long long)durable->revision, fault);
        }
        directory_remove(beneath("image"));
    }
}

static void what_was_told_is_there(void **state)
{
    struct store_told durable = {0};
    int moments = 0, told = 0;

    (void)state;
    for (size_t i = 0; i < record.count; i++) {
        const struct power_event *event = &record.events[i];
        if (event->call == DISK_NOTE) {
            durable.asset = durable.asset || event->at == STORE_LIFE_ASSET;
            durable.revision = event->at == STORE_LIFE_ASSET ? durable.revision : event->at;
            told++;
        }
        if (event->call == DISK_NOTE || event->call == DISK_SYNC) {
            check_moment(event->call == DISK_NOTE ? i + 1 : i, &durable);
            moments++;
        }
    }
    check_moment(record.count, &durable);
    printf("# %d moments, %d states of the disk each, %d acknowledgements\n", moments + 1,
           POWER_LUCKS, told);
    assert_true(told > 5 && moments > 2 * told);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_was_told_is_there)};

    (void)argc;
    preload(argv, "disk_driver");
    return cmocka_run_group_tests(tests, record_life, forget);
}
