/* SPDX-License-Identifier: MIT */
/* What a disk may hold after a loss of power: made of what drivers/disk_driver.c recorded. What was
 * synced is there. Of what was written since to a file any part may be, in sectors; of what was
 * done since to a directory, the first so many things. */
#ifndef TESTS_SUPPORT_POWER_H
#define TESTS_SUPPORT_POWER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct power_event {
    uint32_t call; /* enum disk_call of drivers/disk_driver.h */
    int64_t at;
    const char *path;
    const uint8_t *bytes;
    size_t length;
    size_t inode; /* of a file: which of those that had this path */
};

struct power_record {
    struct power_event *events;
    size_t count;
    void *text; /* what they point into */
};
bool power_record_read(struct power_record *record, const char *file);
void power_record_finish(struct power_record *record);

/* Of what is not synced. */
enum power_luck { POWER_NOTHING, POWER_ALL, POWER_LAST_TORN, POWER_ANY, POWER_LUCKS = 20 };

/* Writes into the directory `to`, which is empty, what `from` may be when power is lost before the
 * event of that number. */
void power_image(const struct power_record *record, size_t event, int luck, const char *from,
                 const char *to);

#endif
