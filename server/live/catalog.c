/* SPDX-License-Identifier: MIT */
#include "catalog.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

/* Where `id` is or would be. */
static size_t position(const struct catalog *catalog, const char *id)
{
    size_t low = 0, high = catalog->count;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;

        if (strcmp(catalog->entries[middle]->id, id) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static void entry_destroy(struct catalog_entry *entry)
{
    free(entry->name);
    free(entry);
}

void catalog_finish(struct catalog *catalog)
{
    for (size_t i = 0; i < catalog->count; i++) {
        entry_destroy(catalog->entries[i]);
    }
    free(catalog->entries);
    memset(catalog, 0, sizeof *catalog);
}

struct catalog_entry *catalog_find(const struct catalog *catalog, const char *id)
{
    const size_t at = position(catalog, id);

    return at < catalog->count && strcmp(catalog->entries[at]->id, id) == 0 ? catalog->entries[at]
                                                                            : NULL;
}

static struct catalog_entry *insert(struct catalog *catalog, const char *id)
{
    const size_t at = position(catalog, id);
    struct catalog_entry *entry = memory_alloc(1, sizeof *entry);

    if (catalog->count == catalog->capacity) {
        catalog->capacity = catalog->capacity ? catalog->capacity * 2 : 64;
        catalog->entries =
            memory_resize(catalog->entries, catalog->capacity, sizeof *catalog->entries);
    }
    memmove(catalog->entries + at + 1, catalog->entries + at,
            (catalog->count - at) * sizeof *catalog->entries);
    catalog->entries[at] = entry;
    catalog->count++;
    snprintf(entry->id, sizeof entry->id, "%s", id);
    return entry;
}

void catalog_set(struct catalog *catalog, const char *id, const char *name, uint64_t revision,
                 size_t nodes, int64_t modified_ms)
{
    struct catalog_entry *entry = catalog_find(catalog, id);

    if (!entry) {
        entry = insert(catalog, id);
    }
    if (!entry->name || strcmp(entry->name, name) != 0) {
        free(entry->name);
        entry->name = memory_text(name);
    }
    entry->revision = revision;
    entry->nodes = nodes;
    entry->modified_ms = modified_ms;
}

void catalog_remove(struct catalog *catalog, const char *id)
{
    struct catalog_entry *entry = catalog_find(catalog, id);

    if (!entry) {
        return;
    }
    const size_t at = position(catalog, id);
    entry_destroy(entry);
    catalog->count--;
    memmove(catalog->entries + at, catalog->entries + at + 1,
            (catalog->count - at) * sizeof *catalog->entries);
}
