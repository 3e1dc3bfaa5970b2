/* SPDX-License-Identifier: MIT */
/* The list of all scenes, in memory. Whether a scene exists is answered without the disk. Not
 * thread-safe. */
#ifndef SERVER_CATALOG_H
#define SERVER_CATALOG_H

#include <stddef.h>
#include <stdint.h>

#include "protocol/limits.h"

struct catalog_entry {
    char id[LIMIT_ID_BYTES + 1];
    char *name;
    uint64_t revision;
    size_t nodes;
    int64_t modified_ms; /* since 1970 */
};

/* Sorted by id. */
struct catalog {
    struct catalog_entry **entries;
    size_t count, capacity;
};

void catalog_finish(struct catalog *catalog);
struct catalog_entry *catalog_find(const struct catalog *catalog, const char *id);
/* Adds or updates. */
void catalog_set(struct catalog *catalog, const char *id, const char *name, uint64_t revision,
                 size_t nodes, int64_t modified_ms);
void catalog_remove(struct catalog *catalog, const char *id);

#endif
