/* SPDX-License-Identifier: MIT */
/* The life of a store that is written to, and opened twice in it, and what must be there
 * afterwards. For tests of what goes wrong beneath it (drivers/disk_driver.c). */
#ifndef TESTS_SUPPORT_STORE_LIFE_H
#define TESTS_SUPPORT_STORE_LIFE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { STORE_LIFE_REFUSED = 3, STORE_LIFE_SILENT = 4, STORE_LIFE_ASSET = 1000 };

/* What was told durable. */
struct store_told {
    int64_t revision; /* the newest; 0: none */
    bool asset;
};

/* A directory for a test, in memory where there is such: nobody waits for a disk there. */
void store_life_make_base(char *out, size_t size, const char *name);

/* Makes the directory, writes, closes, opens, writes, closes. What is told durable is noted (a
 * revision, or STORE_LIFE_ASSET) and written to `told_fd` as int64_t. The exit status: 0, or
 * STORE_LIFE_REFUSED where the store was not opened and said why, STORE_LIFE_SILENT where it did
 * not. */
int store_life(const char *directory, int told_fd);

/* What was written there, to its end. */
void store_life_read_told(int fd, struct store_told *out);
/* What is wrong with what the directory holds, where so much was told durable; NULL: nothing. */
const char *store_life_fault(const char *directory, const struct store_told *durable);

#endif
