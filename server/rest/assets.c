/* SPDX-License-Identifier: MIT */
/* Looks up embedded files. */
#include "assets.h"

#include <string.h>

static const struct asset *find(const struct asset *table, size_t count, const char *path)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(table[i].path, path) == 0)
            return &table[i];
    }
    return NULL;
}

const struct asset *assets_find(const char *path)
{
    return find(assets_table, assets_count, path);
}

const struct asset *examples_find(const char *id)
{
    return find(examples_table, examples_count, id);
}

const struct asset *cards_find(const char *id)
{
    return find(cards_table, cards_count, id);
}

const struct asset *references_find(const char *type)
{
    return find(references_table, references_count, type);
}
